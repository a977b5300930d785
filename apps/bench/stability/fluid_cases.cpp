// Several fluids in one scene.
#include <algorithm>
#include <cmath>
#include <random>
#include <variant>

#include "bench/stability/stress_case.hpp"

namespace rill::bench {

void addRandomFluids(Scene& scene, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto power = [&](double low, double high) { return std::pow(10.0, low + (high - low) * double(random() >> 11) * 0x1p-53); };
  const size_t count = 2 + random() % (kMaxFluids - 1);
  for (size_t k = 0; k < count; ++k) {
    FluidMaterial& fluid = scene.fluids.emplace_back();
    fluid.name = std::to_string(k);
    fluid.density = power(0, 3);
    fluid.viscosity = random() % 2 == 0 ? power(-3, 3) : 0;
  }
  const Fill whole = scene.fill.front();
  const auto& box = std::get<BoxShape>(whole.shape);
  const double d = scene.fluid.spacing, layers = std::max(std::round((box.max.x - box.min.x) / d), 1.0);
  const auto slabs = static_cast<size_t>(std::min(double(count), layers));
  scene.fill.clear();
  for (size_t k = 0; k < slabs; ++k) {
    const auto edge = [&](size_t n) { return box.min.x + d * std::round(layers * double(n) / double(slabs)); };
    BoxShape slab = box;
    slab.min.x = edge(k), slab.max.x = edge(k + 1);
    Fill& fill = scene.fill.emplace_back(whole);
    fill.shape = slab;
    fill.fluid = scene.fluids[k].name;
  }
  for (Emitter& emitter : scene.emitters) emitter.fluid = scene.fluids[random() % count].name;
  if (random() % 2 == 0)
    for (size_t k = 0; k < std::min(count, kMaxDiffusing); ++k) scene.fluids[k].diffusion = random() % 2 == 0 ? power(-9, 2) : 0;
}

}  // namespace rill::bench
