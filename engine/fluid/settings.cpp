#include "fluid/settings.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/words.hpp"
#include "fill/mouth.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/flows.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "fluid/sleep.hpp"
#include "fluid/stability_limits.hpp"
#include "fluid/steps.hpp"
#include "fluid/tension.hpp"
#include "fluid/viscosity.hpp"
#include "model/scene_facts.hpp"
#include "shape/pose.hpp"
#include "shared/diffusion_steps.h"
#include "shared/surface_tension.h"
#include "sph/artificial_pressure.hpp"
#include "sph/diffusion.hpp"
#include "sph/half_space.hpp"
#include "sph/kernel.hpp"
#include "sph/liquid_scale.hpp"

namespace rill {
namespace {

// The time in which the lattice of a fill at h = 2.3 d becomes a liquid, over sqrt(spacing / g). See docs/notes/rest-state.md.
constexpr double kMeltingTime = 20;
constexpr double kContactFall = 0.005;  // spacings that bodies fall in a step, at most: contacts give way by a multiple of it
constexpr double kSeparationRate = 10;  // 1/s: spacings a second by which bodies that overlap come apart, without gravity
// Spacings: beyond it, positions have lost their meaning: float holds 24 bits.
constexpr double kFarSpacings = 1.0e6;
// Entries for what begins and fills the segments of a particle: in a corner, or with far neighbors. But for those that its neighbors leave.
constexpr uint32_t kSegmentRoom = 16;

constexpr SideMask kEverySide = 0b111111;

// As many stages as the longest block asks for where the fluid is somewhat denser than its rest lattice.
void setDiffusion(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  constexpr uint32_t kMaxStages = 16;
  constexpr double kCrowded = 1.5, kMaxDiffusionRate = 1e20;  // 1/s
  constexpr float FluidParams::*kRates[] = {&FluidParams::diffusionRate0, &FluidParams::diffusionRate1, &FluidParams::diffusionRate2,
                                            &FluidParams::diffusionRate3};
  const std::vector<size_t> diffusing = diffusingFluids(scene);
  double fastest = 0;
  for (size_t k = 0; k < diffusing.size(); ++k) {
    const double diffusivity = scene.fluids[diffusing[k]].diffusion;
    setup.params.*kRates[k] = f(std::min(diffusionRate(diffusivity, kernel), kMaxDiffusionRate));
    fastest = std::max(fastest, diffusivity);
  }
  if (fastest == 0) return;
  setup.params.maxDiffusionRate = f(std::min(diffusionRate(fastest, kernel), kMaxDiffusionRate));
  const double length = kCrowded * setup.params.maxDiffusionRate * diffusionRow(kernel) * setup.substepsPerBlock * setup.longestStep;
  setup.params.diffusionStages = shared::diffusionStages(length, kMaxStages);
}

void setArtificialPressure(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  FluidParams& p = setup.params;
  if (scene.fluid.tensile <= 0) return;
  const ArtificialPressure pressure(kernel, scene.fluid.tensile, scene.fluid.tensile_radius, scene.fluid.tensile_power);
  if (pressure.rate > 0) {
    p.tensileRate = f(pressure.rate);
    p.tensileLimit = f(pressure.most);
    p.tensilePower = f(pressure.power);
    p.tensileInverse = f(pressure.inverse);
    p.tensileLeast = f(pressure.least);
  } else {
    setup.whyNoArtificialPressure = "tensile_radius reaches neighbors at rest";
    setup.warnings.push_back("fluid.tensile does nothing: it leaves pairs from 0.95 spacings on alone, and tensile_radius is " +
                             roundedNumber(scene.fluid.tensile_radius * scene.fluid.smoothing_ratio) + " spacings");
  }
}

void setGravity(const Scene& scene, FluidSetup& setup) {
  const auto add = [&](const Double3& g, double from) { setup.gravity.insert(setup.gravity.end(), {f(g.x), f(g.y), f(g.z), f(from)}); };
  add(scene.gravity, 0);
  for (const GravityChange& change : scene.gravity_changes) add(change.value, change.at);
  setup.params.gravityChanges = static_cast<uint32_t>(setup.gravity.size() / 4);
}

/// Spacings from a particle to those that the samples around it act on; 0 without surface tension.
double reachOfTension(const Scene& scene) { return largestTension(scene) > 0 ? double{kTensionReach} : 0; }

/// Whether a solid can hold the fluid up; bodies fall with it.
bool holdsFluid(const Scene& scene) { return scene.solids.size() > bodyCount(scene); }

void addPressureProbes(const Scene& scene, const SmoothingKernel& kernel, const Double3& origin, FluidSetup& setup) {
  const auto place = [&](double x, double from) { return static_cast<float>(std::clamp(x - from, -double{kNoWall}, double{kNoWall})); };
  const auto covers = [](const Solid& solid, const Double3& x) { return surfaceAt(solid.shape, solidPose(solid, 0), x).distance < 0; };
  for (const Probe& probe : scene.probes) {
    if (!probe.pressure) continue;
    const Double3& x = *probe.pressure;
    const bool covered = std::ranges::any_of(scene.solids, [&](const Solid& solid) { return covers(solid, x); });
    setup.pressureProbes.push_back(
        {.x = place(x.x, origin.x), .y = place(x.y, origin.y), .z = place(x.z, origin.z), .covered = covered ? 1u : 0u});
  }
  setup.params.pressureDensity = static_cast<float>(densestFluid(scene) * kernel.gradientOfUnit());
  setup.params.pressureProbes = static_cast<uint32_t>(setup.pressureProbes.size());
}

}  // namespace

double meltingTime(const Scene& scene) {
  const double gravity = strongestGravity(scene);
  const bool held = hasWalls(scene) || holdsFluid(scene);  // in free fall there is no pressure
  return held && gravity > 0 ? kMeltingTime * std::sqrt(scene.fluid.spacing / gravity) : 0;
}

bool hasWalls(const Scene& scene) { return scene.domain && scene.domain->open != kEverySide; }

bool probesLoads(const Scene& scene) {
  return std::ranges::any_of(scene.probes, [](const Probe& probe) { return !probe.load.empty(); });
}

bool measuresLoads(const Scene& scene) { return probesLoads(scene) || bodyCount(scene) > 0; }

bool removes(const Scene& scene) { return hasEmitters(scene) || !scene.drains.empty() || hasRemovingSides(scene); }

size_t pressureProbeCount(const Scene& scene) {
  return static_cast<size_t>(std::ranges::count_if(scene.probes, [](const Probe& probe) { return probe.pressure.has_value(); }));
}

double listReach(const Scene& scene) { return std::max(scene.fluid.smoothing_ratio, reachOfTension(scene)) + kListSkin; }

bool listsHaveSegments(const Scene& scene) { return hasWalls(scene) || reachOfTension(scene) > 0; }

uint32_t listCapacity(double reachInSpacings, bool segments) {
  constexpr double kMaxReach = 5;  // spacings: more than any scene has that is allowed
  const double reach = std::fmin(std::fmax(reachInSpacings, 0), kMaxReach);
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(reach, 3);
  const uint32_t entries = (static_cast<uint32_t>(std::ceil(1.2 * ball)) + 3u) / 4u * 4u + (segments ? kSegmentRoom : 0);
  assert(entries < kUnlisted && entries / 4 <= kMaxSegmentGroups);
  return entries;
}

namespace {

void setKernel(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  FluidParams& p = setup.params;
  const double d = scene.fluid.spacing, h = scene.fluid.smoothing_ratio * d;
  setup.kernel = scene.solver.kernel == KernelChoice::Wendland ? 0u : 1u;
  p.spacing = f(d);
  p.support = f(h);
  p.inverseSupport = f(1 / h);
  p.valueScale = f(kernel.valueScale());
  p.liquidExcess = f(liquidScale(kernel) - 1);
  if (const double time = meltingTime(scene); time > 0) p.inverseMeltingTime = f(1 / time);
  p.gradientScale = f(setup.kernel == 0 ? kernel.gradientScale() : kernel.gradientScale() / h);
  p.inverseRestGradient = f(1 / kernel.restGradientSum());
}

void setLists(const Scene& scene, FluidSetup& setup) {
  FluidParams& p = setup.params;
  const double d = scene.fluid.spacing, h = scene.fluid.smoothing_ratio * d;
  p.reach = f(std::max(h, reachOfTension(scene) * d) + kListSkin * d);
  p.nearReach = reachOfTension(scene) > 0 ? f(h + kListSkin * d) : p.reach;
  p.travelLimit = f((reachOfTension(scene) > 0 ? kTravelWithTension : kTravel) * d);
  setup.substepsPerBlock = substepsPerBlock(scene.solver);
  p.listCapacity = scene.solver.neighbors == NeighborChoice::List ? listCapacity(listReach(scene), listsHaveSegments(scene)) : 0u;
}

Expected<void> addObstacles(const Scene& scene, const SmoothingKernel& kernel, const Double3& origin, FluidSetup& setup) {
  FluidParams& p = setup.params;
  if (!scene.solids.empty() || !emittersOf(scene).empty()) addHalfSpaceTable(kernel, setup);
  if (auto added = addSolids(scene, kernel, origin, setup); !added)
    return Error{added.error().kind, (scene.file.empty() ? "" : scene.file.string() + ": ") + added.error().message};
  p.solidCount = static_cast<uint32_t>(setup.solids.size());
  p.bodyCount = static_cast<uint32_t>(setup.bodies.size());
  if (const double gravity = strongestGravity(scene); p.bodyCount > 0 && gravity > 0)
    boundStep(std::sqrt(kContactFall * scene.fluid.spacing / gravity), "gravity " + roundedNumber(gravity) + " m/s^2, for bodies", setup);
  p.contactPoints = static_cast<uint32_t>(setup.contactPoints.size());
  p.bodySpeed = f(fastestBody(scene));
  return {};
}

void setGrid(const Double3& room, FluidSetup& setup) {
  FluidParams& p = setup.params;
  setup.grid = chooseGridSize(p.reach, extentWithGap(room, setup), p.capacity);
  p.gridSizeX = setup.grid.size[0];
  p.gridSizeY = setup.grid.size[1];
  p.gridSizeZ = setup.grid.size[2];
  p.inverseCell = f(1 / setup.grid.cell);
}

}  // namespace

Expected<FluidSetup> makeFluidSetup(const Scene& scene, const StartFigures& start) {
  if (auto possible = checkScene(scene); !possible) return possible.error();
  const Double3 &origin = start.origin, &extent = start.extent;
  const double d = scene.fluid.spacing, h = scene.fluid.smoothing_ratio * d;
  if (!(d > 0))
    return Error{ErrorKind::BadInput, "fluid.spacing: expected a number above 0 (m) here or in ParticleSet::spacing, found none"};
  FluidSetup setup;
  FluidParams& p = setup.params;
  const SmoothingKernel kernel(scene.solver.kernel, h, d);
  setKernel(scene, kernel, setup);

  p.capacity = start.capacity;
  p.outflowLevel = kNoWall;
  setup.limits = stabilityLimits(scene, kernel);
  setRegularization(scene, kernel, setup);
  setRelaxation(setup);
  setLists(scene, setup);
  setCfl(scene, setup);
  p.iterations = scene.solver.iterations;
  // Iterations do not stop at an error at which the fluid is unstable.
  p.tolerance = f(p.iterations > 1 ? std::min(scene.solver.tolerance, kStableError) : scene.solver.tolerance);
  p.maxSubsteps = scene.solver.max_substeps;
  p.maxStep = f(scene.solver.time_step.value_or(1.0 / 60));
  p.particleMass = f(densestFluid(scene) * d * d * d);
  p.farLimit = f(kFarSpacings * d);
  p.nearLimit = f(std::max(solidReach(kernel), reachOfTension(scene) > 0 ? (double{kTensionRadius} + 1) * d : 0) + (kTravel + 0.2) * d);
  p.solidSpeed = f(fastestSolid(scene));
  p.loadLever = f(loadLever(scene, h));
  p.vorticity = f(scene.fluid.vorticity);
  p.drag = f(scene.fluid.drag);
  setArtificialPressure(scene, kernel, setup);
  p.fullNeighbors = static_cast<uint32_t>(0.8 * 4.0 / 3.0 * std::numbers::pi * std::pow(h / d, 3));

  setWalls(scene, origin, p);
  setup.walls = hasWalls(scene);
  setup.held = setup.walls || holdsFluid(scene);
  // Where both walls of an axis can be within a support of the centers between them.
  for (int a = 0; a < 3 && scene.domain; ++a) setup.thin |= scene.domain->max[a] - scene.domain->min[a] < 2 * h;
  if (auto added = addObstacles(scene, kernel, origin, setup); !added) return added.error();
  addPressureProbes(scene, kernel, origin, setup);
  if (auto added = addFlows(scene, origin, setup); !added) return added.error();
  setup.removes = removes(scene);
  p.separationSpeed = f(std::sqrt(strongestGravity(scene) * d) + kSeparationRate * d);
  addFluids(scene, setup);
  addTension(scene, setup);
  addShearViscosity(scene, setup);
  warnOfKeysWithoutEffect(scene, setup);
  setViscosity(scene, kernel, setup);
  setNoSlip(scene, kernel, setup);
  setNoiseDamping(scene, kernel, setup);
  setGravity(scene, setup);
  setSpeeds(scene, start, p);
  Double3 room;
  for (int a = 0; a < 3; ++a) room[a] = scene.domain ? scene.domain->max[a] - scene.domain->min[a] : 2 * extent[a];
  addSleep(scene, widest(room), setup);
  setGains(scene, setup);
  setColumn(scene, start, setup);
  setLongestStep(scene, setup);
  setViscositySteps(scene, kernel, setup);
  setDiffusion(scene, kernel, setup);
  setInitialPressure(scene, kernel, room, setup);

  if (auto able = checkSteps(scene, room, setup); !able) return able.error();
  setGrid(room, setup);
  addRegions(room, setup);
  return setup;
}

}  // namespace rill
