#include "fluid/settings.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/words.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/flows.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "fluid/sleep.hpp"
#include "fluid/stability_limits.hpp"
#include "fluid/tension.hpp"
#include "shape/pose.hpp"
#include "shared/diffusion_steps.h"
#include "shared/shear_viscosity.h"
#include "shared/surface_tension.h"
#include "shared/viscosity_steps.h"
#include "sph/artificial_pressure.hpp"
#include "sph/diffusion.hpp"
#include "sph/half_space.hpp"
#include "sph/kernel.hpp"
#include "sph/liquid_scale.hpp"
#include "sph/shear_viscosity.hpp"
#include "sph/viscosity.hpp"

namespace rill {
namespace {

// Of a fluid at rest, over density x spacing x sqrt(g spacing).
constexpr double kArtificialViscosity = 1;
// The time in which the lattice of a fill at h = 2.3 d becomes a liquid, over sqrt(spacing / g). See docs/notes/rest-state.md.
constexpr double kMeltingTime = 20;
// The gain where density is too low, over that where it is too high: what builds up slower than it goes pumps less energy.
constexpr double kWarmRelease = 1.5;
// Spacings that the fastest particle may move before the list is rebuilt.
constexpr double kTravel = 1.2;
constexpr double kMinCfl = 0.01;  // spacings a substep
// Where walls may be one spacing thick: a substep moves a center by twice that at most, and a solid by it, together not past the wall's
// middle.
constexpr double kThinWallCfl = 0.3;
constexpr double kContactFall = 0.005;  // spacings that bodies fall in a step, at most: contacts give way by a multiple of it
constexpr double kSeparationRate = 10;  // 1/s: spacings a second by which bodies that overlap come apart, without gravity
constexpr uint32_t kLongestBlock = 6;   // substeps
// Spacings: beyond it, positions have lost their meaning: float holds 24 bits.
constexpr double kFarSpacings = 1.0e6;
// Entries for what begins and fills the segments of a particle in a corner, but for those that its neighbors leave.
constexpr uint32_t kSegmentRoom = 16;
constexpr SideMask kEverySide = 0b111111;
// For the device, where a limit is infinite.
constexpr double kLargest = 1e30;

/// As many as a list lives for where the step is the longest that the CFL condition allows, and one more: it is shorter as a rule. Where
/// something else bounds the step, a list may live for long.
uint32_t substepsPerBlock(const SolverSettings& solver) {
  if (solver.time_step || solver.cfl > kTravel) return kLongestBlock;
  const double lives = std::ceil(kTravel / std::max(solver.cfl, kMinCfl)) + 1;
  return lives < kLongestBlock ? static_cast<uint32_t>(lives) : kLongestBlock;
}

// XSPH coefficient a second that a dynamic viscosity (Pa s) asks for.
double xsphRate(double viscosity, const Scene& scene, const SmoothingKernel& kernel) {
  return 2 * viscosity / (densestFluid(scene) * kernel.secondMoment());
}

void setViscosity(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  constexpr double kMaxViscosityRate = 1e20;  // 1/s; in a step far more than the solve takes, and its squares are floats
  setup.params.viscosityRate = f(std::min(viscosityRate(largestViscosity(scene), densestFluid(scene), kernel), kMaxViscosityRate));
}

// As many steps as the longest substep asks for where the fluid is somewhat denser than its rest lattice.
void setViscositySteps(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  constexpr uint32_t kMaxSteps = 64;
  constexpr double kCrowded = 1.5;
  if (largestViscosity(scene) <= 0) return;
  const double rate = setup.params.viscosityRate * fastestViscosity(scene);
  const double room = setup.shearViscosity ? kCrowded * double{kShearMargin} : kCrowded;
  const double bound = 1 + room * (latticeBound(rate * setup.longestStep, kernel) - 1);
  setup.params.viscositySteps = shared::viscositySteps(bound, kMaxSteps).count;
  // Somewhat less than what the steps reach, so that rounding does not ask for one more.
  if (!setup.shearViscosity) return;
  setup.params.shearBound = f(0.99 * reachedBound(setup.params.viscositySteps));
  setup.params.shearMoment = f(pairMoment(kernel, 4));
}

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

void setNoiseDamping(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  setup.artificialViscosity = artificialViscosity(scene);
  setup.params.noiseDampingRate = f(xsphRate(setup.artificialViscosity, scene, kernel));
  if (setup.artificialViscosity > 0) return;
  setup.whyNoNoiseDamping = strongestGravity(scene) == 0                         ? "no gravity"
                            : scene.solver.artificial_viscosity.value_or(1) == 0 ? "artificial viscosity is 0"
                                                                                 : "the viscosity is larger";
}

// Nothing of it exists where it has no effect.
void setNoSlip(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  const bool walls = hasWalls(scene) && !scene.domain->slip;
  setup.noSlipWalls = walls && largestViscosity(scene) > 0;
  for (const Solid& solid : scene.solids) {
    setup.noSlipSolids |= sticks(scene, solid);
    setup.noSlipBodies |= sticks(scene, solid) && solid.body;
  }
  if (setup.noSlipSolids) addNoSlipTable(kernel, setup);
  if (largestViscosity(scene) > 0) return;
  const auto found = std::ranges::find(scene.solids, false, &Solid::slip);
  if (!walls && found == scene.solids.end()) return;
  const std::string key = walls ? "domain" : elementPath("solids", static_cast<size_t>(found - scene.solids.begin()));
  const std::string what = scene.fluids.empty() ? "fluid.viscosity is 0" : "the viscosity of every fluid is 0";
  setup.warnings.push_back(key + ".slip: false has no effect: " + what + ", expected more (Pa s)");
}

// The end of a warning about a setting beyond its bound.
std::string usedInstead(double found, double used) { return roundedNumber(found) + "; " + roundedNumber(used) + " is used"; }

double widest(const Double3& room) { return std::max({room[0], room[1], room[2]}); }

void setRegularization(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  const auto [wanted, taken] = boundedRegularization(scene);
  setup.params.regularization = f(taken * kernel.restGradientSum());
  if (taken < wanted)
    setup.warnings.push_back("solver.regularization: expected at most " + roundedNumber(taken) +
                             ", beyond which this kernel gains energy, found " + usedInstead(wanted, taken));
}

void setRelaxation(FluidSetup& setup) {
  const StabilityLimits& limits = setup.limits;
  setup.params.relaxationInMotion = limits.relaxationInMotion;
  setup.params.relaxationAtRest = limits.relaxationAtRest;
  if (limits.relaxationWanted > limits.relaxationLimit)
    setup.warnings.push_back("solver.relaxation: expected at most " + roundedNumber(limits.relaxationLimit) +
                             ", beyond which this kernel does not converge, found " +
                             usedInstead(limits.relaxationWanted, limits.relaxationLimit));
}

void setCfl(const Scene& scene, FluidSetup& setup) {
  const bool thin = std::ranges::any_of(scene.solids, [](const Solid& s) { return std::holds_alternative<MeshShape>(s.shape); });
  const double wanted = scene.solver.cfl, taken = std::clamp(wanted, kMinCfl, thin ? kThinWallCfl : kLargest);
  setup.params.cfl = f(taken);
  setup.params.solidSpeedInCfl = thin ? 1 : 0;
  if (taken > wanted)
    setup.warnings.push_back("solver.cfl: expected at least " + roundedNumber(taken) + ", found " + usedInstead(wanted, taken));
  if (taken < wanted)
    setup.warnings.push_back("solver.cfl: expected at most " + roundedNumber(taken) + " beside meshes, whose walls may be thin, found " +
                             usedInstead(wanted, taken));
}

void setGains(const Scene& scene, FluidSetup& setup) {
  const auto [wanted, taken] = boundedWarmGain(scene);
  if (scene.solver.warm_start && taken < wanted)
    setup.warnings.push_back("solver.warm_start: expected at most " + roundedNumber(taken) +
                             ", beyond which this kernel and regularization gain energy, found " + usedInstead(wanted, taken));
  setup.warm = startsWarm(scene);
  setup.params.warmGainInMotion = setup.limits.warmGainInMotion;
  setup.params.maxWarmGainAtRest = f(setup.limits.maxWarmGainAtRest);
  setup.params.layerWarmGainAtRest = f(std::min(setup.limits.layerWarmGainAtRest, kLargest));
}

// Of all that there is room for, m.
double cubeEdge(const Scene& scene, const StartFigures& start) {
  return std::cbrt(static_cast<double>(start.capacity)) * scene.fluid.spacing;
}

// The head of the start, and what the device needs to follow it: see docs/notes/column-height.md. What nothing can hold may be drops far
// apart: no column is higher than one drop of all of it.
void setColumn(const Scene& scene, const StartFigures& start, FluidSetup& setup) {
  FluidParams& p = setup.params;
  float* gravity[3] = {&p.columnGravityX, &p.columnGravityY, &p.columnGravityZ};
  float* limit[3] = {&p.columnLimitX, &p.columnLimitY, &p.columnLimitZ};
  const double drop = 1.5 * cubeEdge(scene, start);
  Double3 height;
  for (int a = 0; a < 3; ++a) {
    height[a] = setup.held ? start.extent[a] : std::min(start.extent[a], drop);
    *gravity[a] = setup.held ? f(strongestGravity(scene, a)) : 0.0f;
    const double room = scene.domain ? scene.domain->max[a] - scene.domain->min[a] : std::max(start.extent[a], drop);
    *limit[a] = f(std::max(room, scene.fluid.spacing));
  }
  setup.head = columnHead(scene, height);
  p.layerHead = f(setup.limits.layerHead);
  p.motionShare = f(setup.limits.motionShare);
  p.stableStep = f(setup.limits.stableStep);
  p.toleratedStep = f(std::min(setup.limits.toleratedStep, kLargest));
}

void setSpeeds(const Scene& scene, const StartFigures& start, FluidParams& p) {
  // Without a domain nothing else bounds what the fluid becomes when more is added.
  Double3 extent;
  for (int a = 0; a < 3; ++a) extent[a] = scene.domain ? start.extent[a] : std::max(start.extent[a], cubeEdge(scene, start));
  const SpeedLimits limits = speedLimits(scene, extent, std::max(start.fastest, fastestEmitter(scene)),
                                         std::max({double{p.solidSpeed}, fastestDriven(scene), fastestBody(scene)}));
  p.warmLimit = f(limits.warm);
  p.minSpeedGain = f(limits.minGain);
  p.maxSpeedGain = f(limits.maxGain);
  p.speedLimit = f(limits.speed);
}

// No step is longer than the longest stable one, whatever is asked for.
void setLongestStep(const Scene& scene, FluidSetup& setup) {
  const StabilityLimits& limits = setup.limits;
  const uint32_t iterations = setup.params.iterations;
  const double stable = limits.longestStep(setup.head);
  if (scene.solver.time_step && *scene.solver.time_step > stable)
    setup.warnings.push_back("solver.time_step " + roundedNumber(*scene.solver.time_step) + " s is more than " +
                             std::to_string(iterations) + (iterations == 1 ? " iteration" : " iterations") +
                             " can hold this fluid's weight in: steps are at most " + roundedNumber(stable) + " s");
  setup.longestStep = std::min<double>(setup.params.maxStep, stable);
  if (limits.softness > 1) warnOfDropping("solver.regularization " + roundedNumber(boundedRegularization(scene).taken), stable, setup);
  setup.firstStep = std::min(setup.longestStep, limits.firstStep(setup.head));
}

// Where nothing holds the fluid up there is no initial pressure.
void setInitialPressure(const Scene& scene, const SmoothingKernel& kernel, const Double3& room, FluidSetup& setup) {
  if (!setup.held) return;
  const InitialPressure pressure = initialPressure(scene, kernel, setup.limits, setup.head, widest(room));
  setup.params.initialPressureIterations = pressure.iterations;
  setup.params.initialPressureMomentum = f(pressure.momentum);
  setup.params.initialPressureStep = f(pressure.step);
  setup.params.initialPressureErrorLimit = f(pressure.errorLimit);
}

// In a shorter step the rounding of positions, which are floats, is more speed than a correction may always add.
double shortestStep(const Double3& room, const FluidParams& p) {
  constexpr double kHalfUlp = 0x1p-24;
  return p.minSpeedGain > 0 ? kHalfUlp * widest(room) / p.minSpeedGain : 0;
}

Expected<void> checkSteps(const Scene& scene, const Double3& room, const FluidSetup& setup) {
  const FluidParams& p = setup.params;
  const double least = shortestStep(room, p);
  if (setup.longestStep >= least) return {};
  const std::string inRoom = "in " + roundedNumber(widest(room)) + " m of room ";
  std::string key = "solver: " + inRoom + "this fluid, with its relaxation and regularization, takes steps of at most ";
  if (setup.longestStep >= p.maxStep && !setup.stepBoundBy.empty())
    key = setup.stepBoundBy + ": " + inRoom + "it allows steps of at most ";
  else if (setup.longestStep >= p.maxStep && scene.solver.time_step)
    key = "solver.time_step: steps of ";
  return Error{ErrorKind::BadInput, (scene.file.empty() ? "" : scene.file.string() + ": ") + key + roundedNumber(setup.longestStep) +
                                        " s, in which the rounding of positions alone is " +
                                        roundedNumber(least * p.minSpeedGain / setup.longestStep) + " m/s; expected steps of " +
                                        roundedNumber(least) + " s or more"};
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

double artificialViscosity(const Scene& scene) {
  const double d = scene.fluid.spacing;
  const double wanted =
      scene.solver.artificial_viscosity.value_or(kArtificialViscosity) * densestFluid(scene) * d * std::sqrt(strongestGravity(scene) * d);
  return std::max(0.0, wanted - smallestKinematicViscosity(scene) * densestFluid(scene));
}

double meltingTime(const Scene& scene) {
  const double gravity = strongestGravity(scene);
  const bool held = hasWalls(scene) || holdsFluid(scene);  // in free fall there is no pressure
  return held && gravity > 0 ? kMeltingTime * std::sqrt(scene.fluid.spacing / gravity) : 0;
}

bool sticks(const Scene& scene, const Solid& solid) { return !solid.slip && largestViscosity(scene) > 0; }

bool hasWalls(const Scene& scene) { return scene.domain && scene.domain->open != kEverySide; }

bool measuresLoads(const Scene& scene) {
  return std::ranges::any_of(scene.probes, [](const Probe& probe) { return !probe.load.empty(); }) || bodyCount(scene) > 0;
}

bool removes(const Scene& scene) { return hasEmitters(scene) || !scene.drains.empty() || hasRemovingSides(scene); }

size_t pressureProbeCount(const Scene& scene) {
  return static_cast<size_t>(std::ranges::count_if(scene.probes, [](const Probe& probe) { return probe.pressure.has_value(); }));
}

bool startsWarm(const Scene& scene) { return boundedWarmGain(scene).wanted > 0; }

void warnOfDropping(const std::string& why, double longest, FluidSetup& setup) {
  const double all = longest * setup.params.maxSubsteps;
  if (all >= 1.0 / 60) return;
  setup.warnings.push_back(why + " needs substeps of at most " + roundedNumber(longest) +
                           " s: " + std::to_string(setup.params.maxSubsteps) + " of them are " + roundedNumber(all) +
                           " s, less than a frame of 1/60 s; time will be dropped");
}

void boundStep(double longest, const std::string& why, FluidSetup& setup) {
  if (f(longest) >= setup.params.maxStep) return;
  setup.params.maxStep = f(longest);
  setup.stepBoundBy = why;
}

double listReach(const Scene& scene) { return std::max(scene.fluid.smoothing_ratio, reachOfTension(scene)) + kListSkin; }

uint32_t listCapacity(double reachInSpacings, bool walls) {
  constexpr double kMaxReach = 5;  // spacings: more than any scene has that is allowed
  const double reach = std::fmin(std::fmax(reachInSpacings, 0), kMaxReach);
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(reach, 3);
  const uint32_t entries = (static_cast<uint32_t>(std::ceil(1.2 * ball)) + 3u) / 4u * 4u + (walls ? kSegmentRoom : 0);
  assert(entries < kUnlisted && entries / 4 <= kMaxSegmentGroups);
  return entries;
}

Expected<FluidSetup> makeFluidSetup(const Scene& scene, const StartFigures& start) {
  if (auto possible = checkScene(scene); !possible) return possible.error();
  const Double3 &origin = start.origin, &extent = start.extent;
  const double d = scene.fluid.spacing, h = scene.fluid.smoothing_ratio * d;
  if (!(d > 0))
    return Error{ErrorKind::BadInput, "fluid.spacing: expected a number above 0 (m) here or in ParticleSet::spacing, found none"};
  FluidSetup setup;
  FluidParams& p = setup.params;
  const SmoothingKernel kernel(scene.solver.kernel, h, d);
  setup.kernel = scene.solver.kernel == KernelChoice::Wendland ? 0u : 1u;

  p.capacity = start.capacity;
  p.outflowLevel = kNoWall;
  p.spacing = f(d);
  p.support = f(h);
  p.inverseSupport = f(1 / h);
  p.valueScale = f(kernel.valueScale());
  p.liquidExcess = f(liquidScale(kernel) - 1);
  if (const double time = meltingTime(scene); time > 0) p.inverseMeltingTime = f(1 / time);
  p.gradientScale = f(setup.kernel == 0 ? kernel.gradientScale() : kernel.gradientScale() / h);
  p.inverseRestGradient = f(1 / kernel.restGradientSum());
  setup.limits = stabilityLimits(scene, kernel);
  setRegularization(scene, kernel, setup);
  setRelaxation(setup);
  p.warmRelease = f(kWarmRelease);
  p.reach = f(std::max(h, reachOfTension(scene) * d) + kListSkin * d);
  p.travelLimit = f(kTravel * d);
  setup.substepsPerBlock = substepsPerBlock(scene.solver);
  p.listCapacity = scene.solver.neighbors == NeighborChoice::List ? listCapacity(listReach(scene), hasWalls(scene)) : 0u;
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
  if (!scene.solids.empty()) addHalfSpaceTable(kernel, setup);
  if (auto added = addSolids(scene, kernel, origin, setup); !added)
    return Error{added.error().kind, (scene.file.empty() ? "" : scene.file.string() + ": ") + added.error().message};
  p.solidCount = static_cast<uint32_t>(setup.solids.size());
  p.bodyCount = static_cast<uint32_t>(setup.bodies.size());
  if (const double gravity = strongestGravity(scene); p.bodyCount > 0 && gravity > 0)
    boundStep(std::sqrt(kContactFall * d / gravity), "gravity " + roundedNumber(gravity) + " m/s^2, for bodies", setup);
  p.contactPoints = static_cast<uint32_t>(setup.contactPoints.size());
  p.bodySpeed = f(fastestBody(scene));
  addPressureProbes(scene, kernel, origin, setup);
  if (auto added = addFlows(scene, origin, setup); !added) return added.error();
  setup.removes = removes(scene);
  p.separationSpeed = f(std::sqrt(strongestGravity(scene) * d) + kSeparationRate * d);
  addFluids(scene, setup);
  addTension(scene, setup);
  addShearViscosity(scene, setup);
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
  setup.grid = chooseGridSize(p.reach, extentWithGap(room, setup), start.capacity);
  p.gridSizeX = setup.grid.size[0];
  p.gridSizeY = setup.grid.size[1];
  p.gridSizeZ = setup.grid.size[2];
  p.inverseCell = f(1 / setup.grid.cell);
  addRegions(room, setup);
  return setup;
}

}  // namespace rill
