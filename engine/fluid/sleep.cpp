#include "fluid/sleep.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "fill/mouth.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "model/scene_facts.hpp"

namespace rill {
namespace {

constexpr uint32_t kLeastRegions = 8;  // along the longest axis: nothing sleeps within three of one awake
constexpr double kRelease = 0.1;       // s after a body's release in which it need not have moved yet

/// Seconds in which something moves.
struct Interval {
  double from = 0, until = 0;
};

bool moves(const Keyframe& from, const Keyframe& to) { return from.translate != to.translate || from.rotate != to.rotate; }

/// In any order; they may overlap.
std::vector<Interval> causes(const Scene& scene) {
  constexpr double kForever = std::numeric_limits<float>::max();
  std::vector<Interval> all;
  for (const Solid& solid : scene.solids) {
    for (size_t k = 1; k < solid.motion.size(); ++k)
      if (moves(solid.motion[k - 1], solid.motion[k])) all.push_back({solid.motion[k - 1].at, solid.motion[k].at});
    if (solid.body && solid.body->from > 0) all.push_back({solid.body->from, solid.body->from + kRelease});
  }
  for (const Emitter& emitter : emittersOf(scene)) all.push_back({emitter.from, emitter.until.value_or(kForever)});
  for (const Drain& drain : scene.drains) all.push_back({drain.from, drain.until.value_or(kForever)});
  return all;
}

/// m, in each dimension.
double regionEdge(const FluidSetup& setup) { return double{setup.params.reach} * kRegionCellsY; }

std::string whyNoRegions(const Double3& room, const FluidSetup& setup) {
  if (setup.params.sleeps == 0) return setup.whyNoSleep;
  if (!setup.warm) return "without a warm start the forces on fluid at rest are not known";
  if (setup.params.tensionRate > 0) return "a surface with tension moves as a whole";
  if (std::max({room[0], room[1], room[2]}) < kLeastRegions * regionEdge(setup)) return "the room is too small to be divided";
  return {};
}

/// Sorted, those that touch as one.
std::vector<Interval> merged(std::vector<Interval> all) {
  std::ranges::sort(all, {}, &Interval::from);
  std::vector<Interval> result;
  for (const Interval& next : all) {
    if (!result.empty() && next.from <= result.back().until)
      result.back().until = std::max(result.back().until, next.until);
    else
      result.push_back(next);
  }
  return result;
}

}  // namespace

void addSleep(const Scene& scene, double room, FluidSetup& setup) {
  if (!scene.solver.sleep) return;
  if (!(strongestGravity(scene) > 0)) {
    setup.whyNoSleep = "no gravity";
    setup.warnings.push_back("solver.sleep: has no effect without gravity");
    return;
  }
  if (setup.fluids > 1) {
    setup.whyNoSleep = "several fluids: one that rises slowly would be taken for at rest";
    setup.warnings.push_back("solver.sleep: has no effect in a scene with several fluids");
    return;
  }
  setup.params.sleeps = 1;
  setup.params.sleepLength = f(std::max(room, scene.fluid.spacing));
  setup.params.kinematicViscosity = f(largestKinematicViscosity(scene));
  const std::vector<Interval> wakes = merged(causes(scene));
  for (const Interval& wake : wakes) setup.gravity.insert(setup.gravity.end(), {f(wake.from), f(wake.until), 0.0f, 0.0f});
  setup.params.wakes = static_cast<uint32_t>(wakes.size());
}

Double3 extentWithGap(const Double3& room, const FluidSetup& setup) {
  if (!whyNoRegions(room, setup).empty()) return room;
  const double gap = 2 * regionEdge(setup);  // holds a whole region, wherever the room begins
  return {room[0] + gap, room[1] + gap, room[2] + gap};
}

void addRegions(const Double3& room, FluidSetup& setup) {
  FluidParams& p = setup.params;
  setup.whyNoRegions = whyNoRegions(room, setup);
  if (!setup.whyNoRegions.empty()) return;
  const uint32_t x = std::max(p.gridSizeX / kRegionCellsX, 1u), y = std::max(p.gridSizeY / kRegionCellsY, 1u),
                 z = std::max(p.gridSizeZ / kRegionCellsZ, 1u);
  p.regionsX = x, p.regionsY = y, p.regionsZ = z;
}

}  // namespace rill
