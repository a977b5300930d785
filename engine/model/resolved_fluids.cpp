#include <algorithm>

#include "rill/scene.hpp"

namespace rill {
namespace {

// Between fluids that have less tension against air than between them a film of air would form. Each gets what the pair that it is in asks
// for the most, in equal parts, whatever their order.
void raiseTensions(const Scene& scene, std::vector<ResolvedFluid>& fluids) {
  const std::vector<ResolvedFluid> given = fluids;
  for (const FluidInterface& pair : scene.interfaces) {
    const size_t a = fluidIndex(scene, pair.between.first), b = fluidIndex(scene, pair.between.second);
    if (a >= fluids.size() || b >= fluids.size()) continue;  // checkScene() refuses it
    const double missing = std::max(pair.tension - given[a].surfaceTension - given[b].surfaceTension, 0.0);
    for (const size_t k : {a, b}) fluids[k].surfaceTension = std::max(fluids[k].surfaceTension, given[k].surfaceTension + missing / 2);
  }
}

}  // namespace

std::vector<ResolvedFluid> resolvedFluids(const Scene& scene) {
  const ResolvedFluid common{.density = scene.fluid.density,
                             .viscosity = scene.fluid.viscosity,
                             .yieldStress = scene.fluid.yield_stress,
                             .flowIndex = scene.fluid.flow_index,
                             .surfaceTension = scene.fluid.surface_tension};
  if (scene.fluids.empty()) return {common};
  std::vector<ResolvedFluid> fluids;
  for (const FluidMaterial& material : scene.fluids)
    fluids.push_back({.name = material.name,
                      .density = material.density.value_or(common.density),
                      .viscosity = material.viscosity.value_or(common.viscosity),
                      .yieldStress = material.yield_stress.value_or(common.yieldStress),
                      .flowIndex = material.flow_index.value_or(common.flowIndex),
                      .surfaceTension = material.surface_tension.value_or(common.surfaceTension),
                      .color = material.color,
                      .diffusion = material.diffusion});
  raiseTensions(scene, fluids);
  return fluids;
}

size_t fluidIndex(const Scene& scene, const std::string& name) {
  if (name.empty()) return 0;
  const auto found = std::ranges::find(scene.fluids, name, &FluidMaterial::name);
  return found == scene.fluids.end() ? kMaxFluids : static_cast<size_t>(found - scene.fluids.begin());
}

std::vector<size_t> diffusingFluids(const Scene& scene) {
  std::vector<size_t> all;
  for (size_t k = 0; scene.fluids.size() > 1 && k < scene.fluids.size() && all.size() < kMaxDiffusing; ++k)
    if (scene.fluids[k].diffusion > 0) all.push_back(k);
  return all;
}

}  // namespace rill
