#include "views/particle_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "model/scene_facts.hpp"
#include "shape/records.hpp"
#include "views/bounds.hpp"
#include "views/color_map.hpp"
#include "views/flow_outlines.hpp"

namespace rill {
namespace {

using particle_view::kColors;
using particle_view::SceneRecord;

static_assert(particle_view::kViewFluids == kMaxFluids);

constexpr uint32_t kLightTexels = 512;  // a side at most

constexpr Double3 kToLight = {-0.36, 1.0, 0.52};  // from the front, left and above: the usual camera sees lit sides

/// Directions of the light map: across, across and to the light.
struct LightFrame {
  Double3 u, v, to;
};

LightFrame lightFrame(const Double3& toLight) {
  const double size = std::sqrt(toLight.x * toLight.x + toLight.y * toLight.y + toLight.z * toLight.z);
  const Double3 to = {toLight.x / size, toLight.y / size, toLight.z / size};
  const double across = std::hypot(to[0], to[2]);
  LightFrame frame{across > 1e-6 ? Double3{to[2] / across, 0, -to[0] / across} : Double3{1, 0, 0}, {}, to};
  frame.v[0] = to[1] * frame.u[2] - to[2] * frame.u[1];
  frame.v[1] = to[2] * frame.u[0] - to[0] * frame.u[2];
  frame.v[2] = to[0] * frame.u[1] - to[1] * frame.u[0];
  return frame;
}

/// What the light map covers: the fluid and the solids with room to move, inside the domain where there is one.
Bounds litBounds(const Scene& scene, const ParticleSet& particles) {
  Bounds bounds = fluidBounds(scene, particles);
  addSolids(bounds, scene);
  if (bounds.empty()) {
    if (!scene.domain) {
      bounds.add({}, 1);
      return bounds;
    }
    bounds.add(scene.domain->min);
    bounds.add(scene.domain->max);
    return bounds;
  }
  const double size = std::max({bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1], bounds.max[2] - bounds.min[2]});
  for (int a = 0; a < 3; ++a) {
    bounds.min[a] -= 3 * size;
    bounds.max[a] += 3 * size;
    if (scene.domain) {
      bounds.min[a] = std::max(bounds.min[a], std::min(scene.domain->min[a], bounds.max[a]));
      bounds.max[a] = std::min(bounds.max[a], std::max(scene.domain->max[a], bounds.min[a]));
    }
  }
  return bounds;
}

void fillLight(SceneRecord& record, const Bounds& bounds, const Double3& origin, double spacing, const Double3& toLight) {
  const LightFrame frame = lightFrame(toLight);
  Double3 low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    Double3 at;
    for (int a = 0; a < 3; ++a) at[a] = ((corner >> a) & 1 ? bounds.max[a] : bounds.min[a]) - origin[a];
    const Double3 axes[3] = {frame.u, frame.v, frame.to};
    for (int k = 0; k < 3; ++k) {
      const double along = axes[k][0] * at[0] + axes[k][1] * at[1] + axes[k][2] * at[2];
      low[k] = std::min(low[k], along);
      high[k] = std::max(high[k], along);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], 1e-6});
  const double texel = std::max(extent / (kLightTexels - 4), 0.5 * spacing);
  const auto vec = [](const Double3& v, double w) {
    return Float4{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(w)};
  };
  record.light_u = vec(frame.u, low[0] - texel);
  record.light_v = vec(frame.v, low[1] - texel);
  record.light_to = vec(frame.to, high[2] + 0.5 * spacing);
  record.light_texel = {static_cast<float>(texel), static_cast<float>(high[2] - low[2] + spacing), 0, 0};
  record.counts.y = static_cast<uint32_t>((high[0] - low[0]) / texel) + 4;
  record.counts.z = static_cast<uint32_t>((high[1] - low[1]) / texel) + 4;
}

void fillSolids(ParticleScene& out, const Scene& scene) {
  for (const Solid& solid : scene.solids) {
    const std::vector<KeyframeRecord> keyframes = keyframeRecords(solid.motion);
    out.solids.push_back({.base = baseRecord(solid, out.origin),
                          .shape = recordOf(solid.shape),
                          .radius = static_cast<float>(boundingRadius(solid.shape) + shellOf(solid.shape, scene.fluid.spacing)),
                          .firstKey = static_cast<uint32_t>(out.keyframes.size()),
                          .keyCount = static_cast<uint32_t>(keyframes.size()),
                          .driven = solid.driven > 0 || solid.body});
    out.keyframes.insert(out.keyframes.end(), keyframes.begin(), keyframes.end());
  }
}

/// The speed of a fall from the fluid's top to the bottom of the tank, or of the start if that is more.
double fallSpeed(const Scene& scene, const ParticleSet& particles) {
  const Bounds fluid = fluidBounds(scene, particles);
  double square = 0;
  for (const Float3& v : particles.velocities) {
    const double s = double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z;
    if (std::isfinite(s)) square = std::max(square, s);
  }
  if (fluid.empty()) return std::sqrt(square);
  std::vector<Double3> gravities{scene.gravity};
  for (const GravityChange& change : scene.gravity_changes) gravities.push_back(change.value);
  for (const auto& gravity : gravities) {
    // 2 g H, with both in one product: along every axis, from the fluid's far side to the end of the fall.
    double fall = 0;
    for (size_t a = 0; a < 3; ++a) {
      const double from = gravity[a] < 0 ? fluid.max[a] : fluid.min[a];
      const double end = gravity[a] < 0 ? fluid.min[a] : fluid.max[a];
      double to = end;
      if (scene.domain && a == 1) to = gravity[a] < 0 ? std::min(scene.domain->min[a], end) : std::max(scene.domain->max[a], end);
      fall += gravity[a] * (to - from);
    }
    square = std::max(square, 2 * fall);
  }
  return std::sqrt(square);
}

}  // namespace

double roundNicely(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double base = std::pow(10.0, std::floor(std::log10(value)));
  double best = base;
  for (const double factor : {1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    if (std::abs(factor * base - value) < std::abs(best - value)) best = factor * base;
  }
  return best;
}

ParticleScene particleScene(const Scene& scene, const ParticleSet& particles, const std::optional<Double3>& toSun) {
  ParticleScene out;
  out.origin = particles.origin;
  SceneRecord& record = out.scene;
  if (scene.domain) {
    const Domain& domain = *scene.domain;
    const auto low = [&](int a) { return static_cast<float>(domain.min[a] - out.origin[a]); };
    const auto high = [&](int a) { return static_cast<float>(domain.max[a] - out.origin[a]); };
    const double floor = std::max(domain.max[0] - domain.min[0], domain.max[2] - domain.min[2]);
    record.domain_min = {low(0), low(1), low(2), 1};
    record.domain_max = {high(0), high(1), high(2), static_cast<float>(roundNicely(floor / 16))};
    record.counts.w = ~uint32_t{domain.open} & 0x3Fu;
  }
  fillLight(record, litBounds(scene, particles), out.origin, scene.fluid.spacing, toSun.value_or(kToLight));
  fillSolids(out, scene);
  out.lines = flowOutlines(scene, out.origin, out.keyframes);
  record.counts.x = static_cast<uint32_t>(out.solids.size());
  for (uint32_t k = 0; k < kColors; ++k) {
    const double t = k / (kColors - 1.0);
    const Float3 speed = mapColor(ParticleColor::Speed, t), compression = mapColor(ParticleColor::Compression, t);
    record.colors[k] = {speed.x, speed.y, speed.z, 1};
    record.colors[kColors + k] = {compression.x, compression.y, compression.z, 1};
  }
  for (size_t k = 0; k < std::min(scene.fluids.size(), kMaxFluids); ++k) {
    const auto& given = scene.fluids[k].color;
    const Float3 color = given ? Float3{float(given->x), float(given->y), float(given->z)} : fluidColor(k);
    record.fluids[k] = {color.x, color.y, color.z, 1};
  }
  if (maySleep(scene)) record.asleep = {0.18F, 0.18F, 0.18F, 1};
  out.speed_max = roundNicely(fallSpeed(scene, particles));
  out.compression_max = scene.solver.tolerance > 0 ? roundNicely(std::clamp(10 * scene.solver.tolerance, 0.001, 0.2)) : 0.01;
  return out;
}

}  // namespace rill
