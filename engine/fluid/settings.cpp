#include "fluid/settings.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/words.hpp"
#include "shape/records.hpp"
#include "sph/artificial_pressure.hpp"
#include "sph/jacobi_limit.hpp"
#include "sph/kernel.hpp"
#include "sph/solid_density.hpp"
#include "sph/start_pressure.hpp"
#include "sph/wall.hpp"

namespace rill {
namespace {

// Defaults of the solver's "auto" settings.
constexpr double kRelaxation = 0.7;      // at most; more brings nothing even where it converges
constexpr double kOfJacobiLimit = 0.92;  // and so much of the linear limit, which is that of a lattice: disorder is stiffer
// And in a fluid at rest: a correction is a speed in the next substep, which the shortest wave of a lattice bears up to 2/3; the pressure
// of a column in long steps takes a part of that (at 2/3 30 layers boil, at 0.62 they do not).
constexpr double kCalmOfJacobiLimit = 0.6;
constexpr double kRegularization = 0.02;  // of the rest lattice's sum |grad C|^2: bounds the correction of isolated pairs
constexpr double kWarmGain = 0.02;
// Poly6 with spiky does work in loops, its gradient not being the density's: the more, the less the correction of close pairs shrinks with
// them, and the longer a pressure lasts. At 1 and 0.02 a wave breaks faster than that feeds it; at 5, and at 0.5, energy grew by a sixth.
constexpr double kMaxRegularizationPoly6Spiky = 1, kMaxWarmGainPoly6Spiky = 0.02;
// In a fluid at rest, over the square of the column's layers, and at most: its longest wave gains kappa / 2 a substep.
constexpr double kCalmWarmGain = 1.2, kMaxCalmWarmGain = 0.005;
// With this kappa pressure still followed a dam's flow; without one the start's would stay for ever.
constexpr double kLeastFollowing = 0.001;
constexpr double kCalmSubsteps = 10;  // a layer: the mean error that the step follows there; the column's first wave takes about seven
constexpr double kRough = 0.5;        // the fastest particle's speed over that of falling through all the fluid's height: no longer at rest
constexpr double kArtificialViscosity = 0.03;  // of a fluid at rest, over density x spacing x sqrt(g spacing)
// The gain where density is too low, over that where it is too high: what builds up slower than it goes pumps less energy.
constexpr double kWarmRelease = 1.5;
// Mean compression by its own weight that an iteration can bear: 0.007 held, 0.013 exploded (dam10k without warm start). And the less, the
// higher the warm start's gain: at 0.05 0.0032 held, 0.0036 gained a quarter of energy; at 0.02 0.0036 gained 2.5 %.
constexpr double kStableError = 0.0055, kStableGain = 40;
// Mean compression of a column, over that of one which rests on its corrections alone (see stepOfError).
constexpr double kErrorOfHead = 0.38;
constexpr double kTravel = 1.2;         // spacings that the fastest particle may move before the list is rebuilt
constexpr double kLeastCfl = 0.01;      // spacings a substep
constexpr uint32_t kLongestBlock = 6;   // substeps
constexpr double kWarmLimit = 1;        // w is -p dt^2 / rho for a pressure p: twice that of water as high as the room
constexpr double kPushLow = 0.06;       // of the usual speed (setSpeeds): a correction may always add as much to a speed
constexpr double kPushHigh = 0.5;       // and never more
constexpr double kSpeedLimit = 8;       // of the usual speed: jets at walls reach two or three times that
constexpr double kFarSpacings = 1.0e6;  // beyond it, positions have lost their meaning: float holds 24 bits

float f(double value) { return static_cast<float>(value); }

double length(const double v[3]) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// As many as a list lives for where the step is the longest that the CFL condition allows, and one more: it is shorter as a rule. Where
/// something else bounds the step, a list may live for long.
uint32_t substepsPerBlock(const SolverSettings& solver) {
  if (solver.time_step || solver.cfl > kTravel) return kLongestBlock;
  const double lives = std::ceil(kTravel / std::max(solver.cfl, kLeastCfl)) + 1;
  return lives < kLongestBlock ? static_cast<uint32_t>(lives) : kLongestBlock;
}

/// Bounds the speed of every point of the solids that keyframes move.
double fastestSolid(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids) {
    const double radius = boundingRadius(solid.shape);
    for (size_t k = 1; k < solid.motion.size(); ++k) {
      const Pose pose = solidPose(solid, solid.motion[k - 1].at);
      fastest = std::max(fastest, length(pose.velocity.data()) + radius * length(pose.angularVelocity.data()));
    }
  }
  return fastest;
}

double fastestDriven(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids) fastest = std::max(fastest, solid.driven);
  return fastest;
}

/// Each entry with its successor behind it, so that a shader fetches the two it interpolates between at once.
void appendTable(std::vector<float>& tables, const std::vector<float>& table, uint32_t& offset) {
  offset = static_cast<uint32_t>(tables.size() / 4);
  for (size_t k = 0; k < table.size(); k += 2) {
    const size_t next = std::min(k + 2, table.size() - 2);
    tables.insert(tables.end(), {table[k], table[k + 1], table[next], table[next + 1]});
  }
}

void addSolids(const Scene& scene, const SmoothingKernel& kernel, const double origin[3], FluidSetup& setup) {
  for (const Solid& solid : scene.solids) {
    SolidRecord record{};
    record.pose = recordOf(solidPose(solid, 0.0), origin);
    record.shape = recordOf(solid.shape);
    record.base = baseRecord(solid, origin);
    record.friction = f(solid.friction);
    record.restitution = f(solid.restitution);
    std::vector<KeyframeRecord> keyframes = keyframeRecords(solid);
    if (solid.driven > 0) {
      record.driven = 1;
      keyframes.assign(2, KeyframeRecord{.rotationW = 1});
      const PoseRecord& p = record.pose;
      setup.driven.push_back({static_cast<uint32_t>(setup.solids.size()), solid.driven, {p.centerX, p.centerY, p.centerZ}});
      record.base.centerX = record.base.centerY = record.base.centerZ = 0;
    }
    record.firstKey = static_cast<uint32_t>(setup.keyframes.size() / kKeyframeNumbers);
    record.keyCount = static_cast<uint32_t>(keyframes.size());
    setup.movingSolids |= record.keyCount > 0;
    for (const KeyframeRecord& key : keyframes) {
      const auto numbers = std::bit_cast<std::array<float, kKeyframeNumbers>>(key);
      setup.keyframes.insert(setup.keyframes.end(), numbers.begin(), numbers.end());
    }
    if (const auto* sphere = std::get_if<SphereShape>(&solid.shape)) {
      const SphereTable table = makeSphereTable(kernel, sphere->radius);
      appendTable(setup.tables, table.table, record.tableOffset);
      record.tableNodes = table.nodes;
      record.tableFirst = f(table.first);
    }
    setup.solids.push_back(record);
  }
}

void setWalls(const Scene& scene, const double origin[3], FluidParams& p) {
  float* low[3] = {&p.lowX, &p.lowY, &p.lowZ};
  float* high[3] = {&p.highX, &p.highY, &p.highZ};
  float* boundLow[3] = {&p.boundLowX, &p.boundLowY, &p.boundLowZ};
  float* boundHigh[3] = {&p.boundHighX, &p.boundHighY, &p.boundHighZ};
  double margin = 0.5 * scene.fluid.spacing;
  for (int a = 0; a < 3; ++a) {
    *low[a] = *boundLow[a] = -kNoWall;
    *high[a] = *boundHigh[a] = kNoWall;
    if (!scene.domain) continue;
    *boundLow[a] = f(scene.domain->min[a] - origin[a]);
    *boundHigh[a] = f(scene.domain->max[a] - origin[a]);
    if (!(scene.domain->open & (1u << (2 * a)))) *low[a] = *boundLow[a];
    if (!(scene.domain->open & (2u << (2 * a)))) *high[a] = *boundHigh[a];
    if (*low[a] > -kNoWall && *high[a] < kNoWall) margin = std::min(margin, 0.5 * (scene.domain->max[a] - scene.domain->min[a]));
  }
  p.margin = f(margin);
}

// XSPH coefficient a second that a dynamic viscosity (Pa s) asks for.
double xsphRate(double viscosity, const Scene& scene, const SmoothingKernel& kernel) {
  return 2 * viscosity / (scene.fluid.density * kernel.secondMoment());
}

// `why` asks for substeps of at most `longest` seconds.
void warnOfDropping(const std::string& why, double longest, FluidSetup& setup) {
  const double all = longest * setup.params.maxSubsteps;
  if (all >= 1.0 / 60) return;
  setup.warnings.push_back(why + " needs substeps of at most " + roundedNumber(longest) +
                           " s: " + std::to_string(setup.params.maxSubsteps) + " of them are " + roundedNumber(all) +
                           " s, less than a frame of 1/60 s; time will be dropped");
}

// XSPH with coefficient c acts like a kinematic viscosity c sigma^2 / (2 dt): so many sweeps, and a step short enough, that none has c
// above 1.
void setViscosity(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  FluidParams& p = setup.params;
  if (scene.fluid.viscosity <= 0) return;
  constexpr uint32_t kMaxSweeps = 8;
  const double rate = xsphRate(scene.fluid.viscosity, scene, kernel);
  const double usual = std::min<double>(p.maxStep, 0.1 * std::sqrt(scene.fluid.spacing / 9.81));
  setup.viscositySweeps = static_cast<uint32_t>(std::clamp(std::ceil(rate * usual), 1.0, double{kMaxSweeps}));
  p.viscosityRate = f(rate);
  const double most = setup.viscositySweeps / rate;
  p.maxStep = std::min(p.maxStep, f(most));
  warnOfDropping("viscosity " + roundedNumber(scene.fluid.viscosity) + " Pa s", most, setup);
}

double strongestGravity(const Scene& scene) {
  double most = length(scene.gravity);
  for (const GravityChange& change : scene.gravity_changes) most = std::max(most, length(change.value));
  return most;
}

void setCalming(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  setup.artificialViscosity = artificialViscosity(scene);
  setup.params.noiseDampingRate = f(xsphRate(setup.artificialViscosity, scene, kernel));
  if (setup.artificialViscosity > 0) return;
  setup.whyNoNoiseDamping = strongestGravity(scene) == 0                         ? "no gravity"
                            : scene.solver.artificial_viscosity.value_or(1) == 0 ? "artificial viscosity is 0"
                                                                                 : "fluid.viscosity is larger";
}

double widest(const double room[3]) { return std::max({room[0], room[1], room[2]}); }

// Gravity times the height of a column of all the fluid there is, m^2/s^2.
double headOf(const Scene& scene, const double extent[3]) {
  double head = 0;
  for (int a = 0; a < 3; ++a) {
    double most = std::abs(scene.gravity[a]);
    for (const GravityChange& change : scene.gravity_changes) most = std::max(most, std::abs(change.value[a]));
    head += most * std::max(extent[a], scene.fluid.spacing);
  }
  return head;
}

// Of such a column.
double layersOf(const Scene& scene, double head) { return head / (std::max(strongestGravity(scene), 1e-20) * scene.fluid.spacing); }

// The regularization that is taken, as a fraction of the rest lattice's D.
double regularization(const Scene& scene) {
  const double wanted = scene.solver.regularization.value_or(kRegularization);
  return scene.solver.kernel == KernelChoice::Poly6Spiky ? std::min(wanted, kMaxRegularizationPoly6Spiky) : wanted;
}

// What it takes from a correction at rest, over what the default takes: epsilon stands beside D in what divides it.
double softness(const Scene& scene) { return (1 + std::max(regularization(scene), kRegularization)) / (1 + kRegularization); }

// The step in which the mean compression of such a column is `error`, over dt^2 g H / d^2. Corrections hold a column up where
// 2 omega / D grad C = g dt^2, so that it is D d^2 / (4 omega) at rest; in the dam breaks of assets/scenes it is less, 0.06 at h = 2 d.
double stepOfError(double error, double head, double relaxation, const SmoothingKernel& kernel) {
  const double d = kernel.spacing();
  // With a short support the gradients grow as soon as particles come nearer.
  double gradients = kernel.restGradientSum();
  for (const double nearer : {1.1, 1.2, 1.3})
    gradients = std::max(gradients, SmoothingKernel(kernel.choice(), nearer * kernel.h(), d).restGradientSum());
  const double errorOfHead = kErrorOfHead * gradients * d * d / (4 * relaxation);
  return d * std::sqrt(error / (errorOfHead * head));
}

void setRelaxation(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  const double most = maxJacobiRelaxation(kernel), limit = kOfJacobiLimit * most,
               wanted = scene.solver.relaxation.value_or(std::min(kRelaxation, limit));
  setup.params.relaxationInMotion = f(std::min(wanted, limit));
  setup.params.relaxationAtRest =
      scene.solver.relaxation ? setup.params.relaxationInMotion : f(std::min(wanted, kCalmOfJacobiLimit * most));
  if (wanted > limit)
    setup.warnings.push_back("solver.relaxation " + roundedNumber(wanted) + " does not converge with this kernel: " + roundedNumber(limit) +
                             " is taken");
}

double wantedWarmGain(const Scene& scene) { return scene.solver.warm_start.value_or(scene.solver.iterations == 1 ? kWarmGain : 0.0); }

// kappa, as much of it as the waves can bear: a wave is fed where its correction is the smaller.
double warmGain(const Scene& scene, FluidSetup& setup) {
  const double wanted = wantedWarmGain(scene);
  const double most = scene.solver.kernel == KernelChoice::Poly6Spiky ? kMaxWarmGainPoly6Spiky : wanted;
  const double gain = std::min(wanted, most) / softness(scene);
  if (scene.solver.warm_start && gain < wanted)
    setup.warnings.push_back("solver.warm_start " + roundedNumber(wanted) +
                             " gains energy with this kernel and regularization: " + roundedNumber(gain) + " is taken");
  return gain;
}

// See docs/notes/noise-damping.md.
void setGains(const Scene& scene, double head, FluidSetup& setup) {
  FluidParams& p = setup.params;
  const double layers = layersOf(scene, head), gain = warmGain(scene, setup);
  p.warmGainInMotion = f(gain);
  setup.warm = startsWarm(scene);
  p.warmGainAtRest = f(scene.solver.warm_start ? gain : std::min(std::min(gain, kMaxCalmWarmGain), kCalmWarmGain / (layers * layers)));
  p.motionSpeed = f(kRough * std::sqrt(2 * head));
  p.errorRateShareAtRest = f(1 / std::max(1.0, kCalmSubsteps * layers));
}

// Speeds that flow can have: what falling through all the room gives, what it started with, what solids push it with.
void setSpeeds(const Scene& scene, const StartFigures& start, FluidParams& p) {
  double room[3];
  const bool closed = scene.domain && scene.domain->open == 0;
  for (int a = 0; a < 3; ++a) room[a] = std::max(start.extent[a], scene.domain ? scene.domain->max[a] - scene.domain->min[a] : 0);
  const double usual =
      std::sqrt(2 * headOf(scene, room) + start.fastest * start.fastest) + std::max<double>(p.solidSpeed, fastestDriven(scene));
  constexpr double kNone = 1e18;  // m/s: where nothing bounds the way that something falls
  p.warmLimit = f(kWarmLimit * usual * usual);
  p.minSpeedGain = f(kPushLow * usual);
  p.maxSpeedGain = f(closed ? kPushHigh * usual : kNone);
  p.speedLimit = f(closed ? kSpeedLimit * usual : kNone);
}

// A column that its weight compresses by too much in a step of so many iterations folds, and springs back with more energy than it had.
// `head` above 0; `gain`: the warm start's.
double bearableStep(const Scene& scene, const SmoothingKernel& kernel, double head, uint32_t iterations, double gain,
                    const FluidParams& p) {
  const double soft = softness(scene), error = kStableError * iterations / (1 + kStableGain * soft * gain);
  return stepOfError(error, head, p.relaxationInMotion / soft, kernel);
}

// No step is longer than the fluid can bear, whatever is asked for.
void setLongestStep(const Scene& scene, const SmoothingKernel& kernel, double head, FluidSetup& setup) {
  FluidParams& p = setup.params;
  if (head <= 0) return;
  const double stable = bearableStep(scene, kernel, head, p.iterations, p.warmGainInMotion, p);
  if (scene.solver.time_step && *scene.solver.time_step > stable)
    setup.warnings.push_back("solver.time_step " + roundedNumber(*scene.solver.time_step) + " s is more than " +
                             std::to_string(p.iterations) + (p.iterations == 1 ? " iteration" : " iterations") +
                             " can hold this fluid's weight in: steps are at most " + roundedNumber(stable) + " s");
  p.maxStep = std::min(p.maxStep, f(stable));
  if (softness(scene) > 1) warnOfDropping("solver.regularization " + roundedNumber(regularization(scene)), stable, setup);
}

// The start's pressure is found for the longest step in which the defaults bear the fluid: in shorter ones the rounding of positions hides
// it, in longer ones the column folds. Where no pressure is carried from substep to substep, or nothing holds the fluid up, there is none.
void setStartPressure(const Scene& scene, const SmoothingKernel& kernel, double head, const double room[3], FluidSetup& setup) {
  FluidParams& p = setup.params;
  if (head <= 0 || !setup.near || p.warmGainInMotion < f(kLeastFollowing)) return;
  const StartPressure start =
      startPressure(kernel, p.relaxationAtRest, regularization(scene), layersOf(scene, head), kMaxInitialPressureIterations);
  p.initialPressureIterations = start.iterations;
  p.initialPressureMomentum = f(start.momentum);
  p.initialPressureStep = f(bearableStep(scene, kernel, head, 1, kWarmGain / softness(scene), p));
  // A compression e of a column as high as all the fluid would be released within a step, at e times its height over that step: at most a
  // twentieth of what falling through a spacing gives.
  const double g = strongestGravity(scene);
  const double bearable = 0.05 * std::sqrt(g * scene.fluid.spacing) * p.initialPressureStep * g / head;
  p.initialPressureErrorLimit =
      f(std::max({bearable, 2.0e-6, 0x1p-24 * widest(room) / scene.fluid.spacing}));  // not below what rounding leaves of any start
}

// In a shorter step the rounding of positions, which are floats, is more speed than a correction may always add.
double shortestStep(const double room[3], const FluidParams& p) {
  constexpr double kHalfUlp = 0x1p-24;
  return p.minSpeedGain > 0 ? kHalfUlp * widest(room) / p.minSpeedGain : 0;
}

Expected<void> checkSteps(const Scene& scene, const double room[3], const FluidSetup& setup) {
  const FluidParams& p = setup.params;
  const double least = shortestStep(room, p);
  if (p.maxStep >= least) return {};
  const bool asked = scene.solver.time_step.value_or(least) < least;
  const bool viscous = setup.viscositySweeps > 0 && p.viscosityRate * least > setup.viscositySweeps;
  const std::string key = asked     ? "solver.time_step: steps of "
                          : viscous ? "fluid.viscosity: " + roundedNumber(scene.fluid.viscosity) + " Pa s needs steps of at most "
                                    : "solver: in " + roundedNumber(widest(room)) +
                                          " m of room this fluid, with its relaxation and regularization, takes steps of at most ";
  return Error{ErrorKind::BadInput, (scene.file.empty() ? "" : scene.file.string() + ": ") + key + roundedNumber(p.maxStep) +
                                        " s, in which the rounding of positions alone is " +
                                        roundedNumber(least * p.minSpeedGain / p.maxStep) + " m/s; expected steps of " +
                                        roundedNumber(least) + " s or more"};
}

// The first step: half of what the tolerance allows under a column as high as all particles. Fluid that is released without its pressure
// compresses, and springs back with what a long step left; with it, a dam's worst particles are a quarter more compressed from the whole
// step on.
double firstStep(const Scene& scene, const SmoothingKernel& kernel, double head, const FluidParams& p) {
  if (scene.solver.tolerance <= 0 || head <= 0) return p.maxStep;
  return std::min<double>(p.maxStep, 0.5 * stepOfError(scene.solver.tolerance, head, p.relaxationAtRest / softness(scene), kernel));
}

void setGravity(const Scene& scene, FluidSetup& setup) {
  for (double g : scene.gravity) setup.gravity.push_back(f(g));
  setup.gravity.push_back(0);
  for (const GravityChange& change : scene.gravity_changes) {
    for (double g : change.value) setup.gravity.push_back(f(g));
    setup.gravity.push_back(f(change.at));
  }
  setup.params.gravityChanges = static_cast<uint32_t>(setup.gravity.size() / 4);
}

}  // namespace

double artificialViscosity(const Scene& scene) {
  const double d = scene.fluid.spacing;
  const double wanted =
      scene.solver.artificial_viscosity.value_or(kArtificialViscosity) * scene.fluid.density * d * std::sqrt(strongestGravity(scene) * d);
  return std::max(0.0, wanted - scene.fluid.viscosity);
}

bool startsWarm(const Scene& scene) { return wantedWarmGain(scene) > 0; }

uint32_t listCapacity(double reachInSpacings) {
  constexpr double kMaxReach = 5;  // spacings: more than any scene has that is allowed
  const double reach = std::fmin(std::fmax(reachInSpacings, 0), kMaxReach);
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(reach, 3);
  return (static_cast<uint32_t>(std::ceil(1.2 * ball)) + 3u) / 4u * 4u;
}

Expected<FluidSetup> makeFluidSetup(const Scene& scene, const StartFigures& start) {
  if (auto possible = checkScene(scene); !possible) return possible.error();
  const uint32_t count = start.count;
  const double *origin = start.origin, *extent = start.extent;
  const double d = scene.fluid.spacing, h = scene.fluid.smoothing_ratio * d;
  if (!(d > 0)) return Error{ErrorKind::BadInput, "fluid.spacing is not set: give it, or make the particles first"};
  FluidSetup setup;
  FluidParams& p = setup.params;
  const SmoothingKernel kernel(scene.solver.kernel, h, d);
  setup.kernel = scene.solver.kernel == KernelChoice::Wendland ? 0u : 1u;

  p.count = count;
  p.spacing = f(d);
  p.support = f(h);
  p.inverseSupport = f(1 / h);
  p.valueScale = f(kernel.valueScale());
  p.gradientScale = f(setup.kernel == 0 ? kernel.gradientScale() : kernel.gradientScale() / h);
  p.inverseRestGradient = f(1 / kernel.restGradientSum());
  p.regularization = f(regularization(scene) * kernel.restGradientSum());
  if (scene.solver.regularization.value_or(0) > regularization(scene))
    setup.warnings.push_back("solver.regularization " + roundedNumber(*scene.solver.regularization) +
                             " gains energy with this kernel: " + roundedNumber(regularization(scene)) + " is taken");
  setRelaxation(scene, kernel, setup);
  p.warmRelease = f(kWarmRelease);
  p.reach = f(h + kListSkin * d);
  p.travelLimit = f(kTravel * d);
  setup.substepsPerBlock = substepsPerBlock(scene.solver);
  p.listCapacity = scene.solver.neighbors == NeighborChoice::List ? listCapacity((h + kListSkin * d) / d) : 0u;
  p.cfl = f(std::max(scene.solver.cfl, kLeastCfl));
  if (scene.solver.cfl < kLeastCfl)
    setup.warnings.push_back("solver.cfl " + roundedNumber(scene.solver.cfl) +
                             " leaves no room to part particles in: " + roundedNumber(kLeastCfl) + " is taken");
  p.iterations = scene.solver.iterations;
  // Iterations do not stop at an error that the fluid cannot bear.
  p.tolerance = f(p.iterations > 1 ? std::min(scene.solver.tolerance, kStableError) : scene.solver.tolerance);
  p.maxSubsteps = scene.solver.max_substeps;
  p.maxStep = f(scene.solver.time_step.value_or(1.0 / 60));
  p.particleMass = f(scene.fluid.density * d * d * d);
  p.farLimit = f(kFarSpacings * d);
  p.nearLimit = f(wallReach(kernel) + (kTravel + 0.2) * d);
  p.solidSpeed = f(fastestSolid(scene));
  p.vorticity = f(scene.fluid.vorticity);
  if (scene.fluid.tensile > 0) {
    const ArtificialPressure pressure(kernel, scene.fluid.tensile, scene.fluid.tensile_radius, scene.fluid.tensile_power);
    if (pressure.rate > 0) {
      p.tensileRate = f(pressure.rate);
      p.tensileLimit = f(pressure.most);
      p.tensilePower = f(pressure.power);
      p.tensileInverse = f(pressure.inverse);
      p.tensileAtRest = f(pressure.atRest);
    } else {
      setup.whyNoArtificialPressure = "tensile_radius reaches neighbors at rest";
      setup.warnings.push_back("fluid.tensile does nothing: it leaves pairs from 0.95 spacings on alone, and tensile_radius is " +
                               roundedNumber(scene.fluid.tensile_radius * scene.fluid.smoothing_ratio) + " spacings");
    }
  }
  p.fullNeighbors = static_cast<uint32_t>(0.8 * 4.0 / 3.0 * std::numbers::pi * std::pow(h / d, 3));

  setWalls(scene, origin, p);
  setup.near = scene.domain.has_value() || !scene.solids.empty();
  if (setup.near) {
    const WallTables tables = makeWallTables(kernel);
    uint32_t first = 0;
    appendTable(setup.tables, tables.plane, first);
    appendTable(setup.tables, tables.edge, p.tableOffset2);
    appendTable(setup.tables, tables.corner, p.tableOffset3);
    appendTable(setup.tables, tables.face, p.tableOffsetFace);
    p.tableStep = f(tables.step);
    p.cornerStep = f(tables.cornerStep);
    p.tableNodes = tables.nodes;
    p.cornerNodes = tables.cornerNodes;
  }
  for (int a = 0; a < 3 && scene.domain; ++a)
    setup.thin |= scene.domain->max[a] - scene.domain->min[a] < 2 * wallReach(kernel) + scene.fluid.spacing;
  addSolids(scene, kernel, origin, setup);
  p.solidCount = static_cast<uint32_t>(setup.solids.size());
  setViscosity(scene, kernel, setup);
  setCalming(scene, kernel, setup);
  setGravity(scene, setup);
  setSpeeds(scene, start, p);
  double room[3];
  for (int a = 0; a < 3; ++a) room[a] = scene.domain ? scene.domain->max[a] - scene.domain->min[a] : 2 * extent[a];
  // What nothing can hold may be drops far apart: no column is higher than one drop of all of it.
  double height[3];
  for (int a = 0; a < 3; ++a)
    height[a] = setup.near ? extent[a] : std::min(extent[a], 1.5 * std::cbrt(static_cast<double>(count)) * scene.fluid.spacing);
  const double head = headOf(scene, height);
  setGains(scene, head, setup);
  setLongestStep(scene, kernel, head, setup);
  setStartPressure(scene, kernel, head, room, setup);
  setup.firstStep = firstStep(scene, kernel, head, p);

  if (auto able = checkSteps(scene, room, setup); !able) return able.error();
  setup.grid = chooseGridSize(p.reach, room, count);
  p.gridSizeX = setup.grid.size[0];
  p.gridSizeY = setup.grid.size[1];
  p.gridSizeZ = setup.grid.size[2];
  p.inverseCell = f(1 / setup.grid.cell);
  return setup;
}

}  // namespace rill
