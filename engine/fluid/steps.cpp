#include "fluid/steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/words.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/flows.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "fluid/stability_limits.hpp"
#include "model/scene_facts.hpp"

namespace rill {
namespace {

// The gain where density is too low, over that where it is too high: what builds up slower than it goes pumps less energy.
constexpr double kWarmRelease = 1.5;
constexpr double kMinCfl = 0.01;  // spacings a substep
// Where walls may be one spacing thick: a substep moves a center by twice that at most, and a solid by it, together not past the wall's
// middle.
constexpr double kThinWallCfl = 0.3;
constexpr uint32_t kLongestBlock = 6;  // substeps
// For the device, where a limit is infinite.
constexpr double kLargest = 1e30;

// The end of a warning about a setting beyond its bound.
std::string usedInstead(double found, double used) { return roundedNumber(found) + "; " + roundedNumber(used) + " is used"; }

// Of all that there is room for, m.
double cubeEdge(const Scene& scene, const StartFigures& start) {
  return std::cbrt(static_cast<double>(start.capacity)) * scene.fluid.spacing;
}

// In a shorter step the rounding of positions, which are floats, is more speed than a correction may always add.
double shortestStep(const Double3& room, const FluidParams& p) {
  constexpr double kHalfUlp = 0x1p-24;
  return p.minSpeedGain > 0 ? kHalfUlp * widest(room) / p.minSpeedGain : 0;
}

}  // namespace

double widest(const Double3& room) { return std::max({room[0], room[1], room[2]}); }

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

uint32_t substepsPerBlock(const SolverSettings& solver) {
  if (solver.time_step || solver.cfl > kTravel) return kLongestBlock;
  const double lives = std::ceil(kTravel / std::max(solver.cfl, kMinCfl)) + 1;
  return lives < kLongestBlock ? static_cast<uint32_t>(lives) : kLongestBlock;
}

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
  setup.params.warmRelease = f(kWarmRelease);
  setup.params.momentum = setup.warm && scene.solver.iterations == 1 ? kMomentum : 0.0F;
  setup.params.warmGainInMotion = setup.limits.warmGainInMotion;
  setup.params.maxWarmGainAtRest = f(setup.limits.maxWarmGainAtRest);
  setup.params.layerWarmGainAtRest = f(std::min(setup.limits.layerWarmGainAtRest, kLargest));
}

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

void setInitialPressure(const Scene& scene, const SmoothingKernel& kernel, const Double3& room, FluidSetup& setup) {
  if (!setup.held) return;
  const InitialPressure pressure = initialPressure(scene, kernel, setup.limits, setup.head, widest(room));
  setup.params.initialPressureIterations = pressure.iterations;
  setup.params.initialPressureMomentum = f(pressure.momentum);
  setup.params.initialPressureStep = f(pressure.step);
  setup.params.initialPressureErrorLimit = f(pressure.errorLimit);
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

}  // namespace rill
