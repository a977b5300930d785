#include "fill/flow_warnings.hpp"

#include <algorithm>
#include <limits>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "fill/blocked_mouths.hpp"
#include "fill/mouth.hpp"
#include "fill/overlapping_mouths.hpp"
#include "fill/walls.hpp"

namespace rill {
namespace {

using Warnings = std::vector<std::string>;

std::string seconds(double t) { return roundedNumber(t) + " s"; }

bool isIn(const Drain& drain, const Double3& p) {
  return std::visit(Overloaded{[&](const SphereShape& sphere) { return length(minus(p, sphere.center)) <= sphere.radius; },
                               [&](const BoxShape& box) {
                                 for (int a = 0; a < 3; ++a)
                                   if (p[a] < box.min[a] || p[a] > box.max[a]) return false;
                                 return true;
                               }},
                    drain.shape);
}

BoxShape boundsOf(const Drain& drain) {
  if (const auto* box = std::get_if<BoxShape>(&drain.shape)) return *box;
  const auto& sphere = std::get<SphereShape>(drain.shape);
  const Double3 reach{sphere.radius, sphere.radius, sphere.radius};
  return {minus(sphere.center, reach), along(sphere.center, 1, reach)};
}

/// Whether a drain is open for as long as an emitter is.
bool drainsAll(const Drain& drain, const Emitter& emitter) {
  return drain.from <= emitter.from && (!drain.until || (emitter.until && *emitter.until <= *drain.until));
}

void addMouths(const Scene& scene, double spacing, Warnings& warnings) {
  const std::vector<Emitter> emitters = emittersOf(scene);
  for (size_t i = 0; i < emitters.size(); ++i) {
    const Emitter& emitter = emitters[i];
    if (emitter.from >= scene.duration && scene.fluid.capacity == 0)
      warnings.push_back(emitterKey(scene, i) + ".from: found " + seconds(emitter.from) +
                         ", expected a time before the scene's duration of " + seconds(scene.duration) +
                         ", or fluid.capacity: room is kept for a layer of it alone");
    if (emitter.motion.size() > 1) continue;
    const std::vector<Double3> samples = samplesOf(mouthAt(emitter, 0), spacing);
    for (size_t k = 0; k < scene.drains.size(); ++k)
      if (drainsAll(scene.drains[k], emitter) && std::ranges::all_of(samples, [&](const Double3& p) { return isIn(scene.drains[k], p); }))
        warnings.push_back(emitterKey(scene, i) + ": its mouth is inside " + elementPath("drains", k) +
                           ", which removes its fluid at once");
  }
}

/// The least extent of what closed walls leave of a drain, m; below 0 if it is outside them.
double thicknessOf(const Drain& drain, const Scene& scene) {
  const BoxShape box = boundsOf(drain);
  double thickness = std::numeric_limits<double>::max();
  for (int a = 0; a < 3; ++a) {
    double low = box.min[a], high = box.max[a];
    if (scene.domain && isClosed(*scene.domain, 2 * a)) low = std::max(low, scene.domain->min[a]);
    if (scene.domain && isClosed(*scene.domain, 2 * a + 1)) high = std::min(high, scene.domain->max[a]);
    thickness = std::min(thickness, high - low);
  }
  return thickness;
}

void addDrains(const Scene& scene, double spacing, Warnings& warnings) {
  const double step = 2 * scene.solver.cfl * spacing;  // the farthest that a substep moves a particle
  for (size_t k = 0; k < scene.drains.size(); ++k) {
    const double thickness = thicknessOf(scene.drains[k], scene);
    if (thickness <= 0)
      warnings.push_back(elementPath("drains", k) + ": it is outside the domain's walls; nothing gets there");
    else if (thickness < step)
      warnings.push_back(elementPath("drains", k) + ": it is " + roundedNumber(thickness) +
                         " m thick within the walls; expected at least " + roundedNumber(step) +
                         " m, as far as a substep may move a particle (solver.cfl): some pass it");
  }
}

void addLevels(const Scene& scene, double spacing, Warnings& warnings) {
  if (!scene.domain) return;
  const auto add = [&](const auto& flow, const std::string& key) {
    if (flow && flow->level < spacing)
      warnings.push_back(key + ".level: found " + roundedNumber(flow->level) + " m, expected at least fluid.spacing, " +
                         roundedNumber(spacing) + " m, the height of a layer");
  };
  add(scene.domain->inflow, "domain.inflow");
  add(scene.domain->outflow, "domain.outflow");
}

/// A domain that fluid cannot leave, and that emitters overfill. What solids take of it does not count.
void addOverflow(const Scene& scene, uint64_t filled, double spacing, Warnings& warnings) {
  constexpr double kRounding = 1e-6;
  const std::vector<Emitter> emitters = emittersOf(scene);
  if (emitters.empty() || !scene.domain || scene.domain->open != 0 || scene.domain->outflow) return;
  const Double3 size = minus(scene.domain->max, scene.domain->min);
  const double room = (1 + kRounding) * size.x * size.y * size.z, particle = spacing * spacing * spacing;
  if (scene.fluid.capacity > 0 && static_cast<double>(scene.fluid.capacity) * particle <= room) return;
  const auto volumeAt = [&](double t) {
    double volume = static_cast<double>(filled) * particle;
    for (const Emitter& emitter : emitters)
      volume += flowOf(emitter) * std::max(std::min(emitter.until.value_or(t), t) - emitter.from, 0.0);
    return volume;
  };
  if (!(volumeAt(scene.duration) > room)) return;
  double before = 0, after = scene.duration;
  for (int k = 0; k < 60; ++k) (volumeAt((before + after) / 2) > room ? after : before) = (before + after) / 2;
  if (std::ranges::any_of(scene.drains, [&](const Drain& drain) { return drain.from < after && thicknessOf(drain, scene) > 0; })) return;
  warnings.push_back("emitters: they have filled the closed domain after " + seconds(after) + ", and ask for " +
                     roundedNumber(volumeAt(scene.duration) / room) +
                     " times its volume until duration; expected a drain, an outflow, an open side or a smaller fluid.capacity");
}

}  // namespace

Warnings flowWarnings(const Scene& scene, uint64_t filled) {
  const double spacing = scene.fluid.spacing;
  Warnings warnings = blockedMouths(scene, spacing);
  addMouths(scene, spacing, warnings);
  for (std::string& warning : overlappingMouths(scene, spacing)) warnings.push_back(std::move(warning));
  addDrains(scene, spacing, warnings);
  addLevels(scene, spacing, warnings);
  addOverflow(scene, filled, spacing, warnings);
  return warnings;
}

}  // namespace rill
