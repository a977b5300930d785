#include "fluid/pass_table.hpp"

#include <algorithm>

namespace rill {
namespace {

bool solids(const FluidSetup& s) { return s.params.solidCount > 0; }
bool moves(const FluidSetup& s) {
  return std::ranges::any_of(s.solids, [](const SolidRecord& solid) { return solid.keyCount > 0; });
}
bool bodies(const FluidSetup& s) { return !s.bodies.empty(); }
bool loads(const FluidSetup& s) { return s.loads; }
bool probesPressure(const FluidSetup& s) { return !s.pressureProbes.empty(); }
bool emits(const FluidSetup& s) { return !s.emitters.empty(); }
bool drains(const FluidSetup& s) { return !s.drains.empty() || s.params.openRemoves != 0; }
bool iterates(const FluidSetup& s) { return s.params.iterations > 1; }
bool stepsOfViscosity(const FluidSetup& s) { return s.params.viscosityRate > 0 && s.params.viscositySteps > 1; }
bool shearViscosity(const FluidSetup& s) { return s.shearViscosity; }
bool viscous(const FluidSetup& s) { return s.params.viscosityRate > 0; }
bool noSlip(const FluidSetup& s) { return s.noSlipSolids; }
bool noSlipBodies(const FluidSetup& s) { return s.noSlipBodies; }
bool noSlipAfterwards(const FluidSetup& s) { return s.noSlipBodies || (s.noSlipSolids && s.loads); }
bool noSlipLoads(const FluidSetup& s) { return s.noSlipSolids && s.loads; }
bool noisy(const FluidSetup& s) { return s.params.noiseDampingRate > 0; }
bool swirls(const FluidSetup& s) { return s.params.vorticity > 0; }
bool tense(const FluidSetup& s) { return s.params.tensionRate > 0; }
bool wetsSolids(const FluidSetup& s) { return tense(s) && solids(s); }
bool pullsSolids(const FluidSetup& s) { return wetsSolids(s) && s.loads; }
bool drags(const FluidSetup& s) { return s.params.drag > 0; }
bool sleeps(const FluidSetup& s) { return s.params.sleeps != 0; }
bool regions(const FluidSetup& s) { return s.params.regionsX != 0; }
bool regionsAtSolids(const FluidSetup& s) { return regions(s) && solids(s); }
bool loadsAsleep(const FluidSetup& s) { return sleeps(s) && (loads(s) || probesPressure(s)); }
bool diffuses(const FluidSetup& s) { return s.params.maxDiffusionRate > 0; }
bool stepsOfDiffusion(const FluidSetup& s) { return diffuses(s) && s.params.diffusionStages > 1; }
bool several(const FluidSetup& s) { return s.fluids > 1; }
bool separate(const FluidSetup& s) { return !s.mergesPasses; }
bool forcesOrDamping(const FluidSetup& s) { return hasForces(s) || noisy(s); }
bool forcesOrDampingAtSolids(const FluidSetup& s) { return forcesOrDamping(s) && solids(s); }

constexpr PassCondition kAlways, kSolids{solids, "no solids"}, kMoves{moves, "no solid moves"}, kBodies{bodies, "no bodies"},
    kLoads{loads, "no loads asked for, and no bodies"}, kProbesPressure{probesPressure, "no probes of pressure"},
    kEmits{emits, "no emitters"}, kDrainsFluid{drains, "no drains, and no open sides that remove"},
    kIterates{iterates, "one iteration a substep"}, kViscous{viscous, "viscosity is 0"},
    kShearViscosity{shearViscosity, "shear changes no viscosity"}, kNoSlip{noSlip, "no solid has slip false, or viscosity is 0"},
    kSwirls{swirls, "vorticity is 0"}, kTense{tense, "surface tension is 0"}, kDrags{drags, "drag is 0"},
    kNoisy{noisy, nullptr, &FluidSetup::whyNoNoiseDamping}, kSleeps{sleeps, nullptr, &FluidSetup::whyNoSleep},
    kRegions{regions, nullptr, &FluidSetup::whyNoRegions}, kFluids{several, "one fluid"}, kDiffuses{diffuses, "no fluid diffuses"};

using P = FluidPass;
using E = Extent;
using S = Start;
constexpr PassOptions kClusters{.clusters = true}, kForce{.force = true};
constexpr std::array<S, 2> kEnd{S::Correct}, kEndOrDamped{S::Correct, S::NoiseDamping}, kFigures{S::Figures}, kRebuild{S::Rebuild},
    kDiffusion{S::Diffusion}, kSolve{S::Density, S::Iterate};

constexpr std::array<FluidPassRow, kFluidPasses> kPassTable = {{
    {P::PlanEmission, "plan emission", "fluid/plan_emission", E::One, {}, {emits}},
    {P::Begin, "begin", "fluid/begin"},
    {P::FallAsleep, "fall asleep", "fluid/fall_asleep", E::Particles, {S::FallAsleep}, kSleeps},
    {P::LoadsAsleep, "loads asleep", "fluid/loads_asleep", E::One, {}, {loadsAsleep}},
    {P::Predict, "predict", "fluid/predict", E::Particles, {S::Predict}},
    {P::PredictFirstAtSolids, "predict first at solids", "fluid/predict", E::NearSolids, {S::Predict}, {solids}},

    {P::Emit, "emit", "fluid/emit", E::Births, kRebuild, kEmits},
    {P::RestMotion, "motion of regions", "fluid/rest_motion", E::Particles, kRebuild, kRegions},
    {P::RestSolids, "regions at solids", "fluid/rest_solids", E::NearSolids, kRebuild, {regionsAtSolids}},
    {P::RestRegions, "regions at rest", "fluid/rest_regions", E::Regions, kRebuild, {regions}},
    {P::RestWake, "wake regions", "fluid/rest_wake", E::Regions, kRebuild, {regions}},
    {P::RestZones, "zones of regions", "fluid/rest_zones", E::Regions, kRebuild, {regions}},
    {P::Keys, "keys", "fluid/keys", E::Keys, kRebuild, kAlways, {.constant = {"REBUILDS", true}}},
    {P::Reorder, "reorder", "fluid/reorder", E::Particles, kRebuild},
    {P::SortConcentration, "sort concentrations", "fluid/sort_concentration", E::Particles, kRebuild, {diffuses}},
    {P::KeepConcentration, "keep concentrations", "fluid/keep_concentration", E::Particles, kRebuild, {diffuses}},
    {P::BuildList, "build list", "fluid/build", E::Chunks, kRebuild, kAlways, kClusters},
    {P::NearMouths, "particles near mouths", "fluid/near_mouths", E::Particles, kRebuild, kEmits},
    {P::FinishRebuild, "finish rebuild", "fluid/finish_rebuild"},

    {P::MoveSolids, "move solids", "fluid/pose", E::One, {S::Density}, kMoves},
    {P::PredictBodies, "predict bodies", "fluid/predict_bodies", E::One, {S::Density}, kBodies},
    {P::TouchedSolids, "touched solids", "fluid/touched_solids", E::Bodies, {S::Density}, kBodies},
    {P::CountContacts, "count contacts", "fluid/count_contacts", E::ContactPoints, {S::Density}, kBodies},
    {P::Contacts, "contacts", "fluid/contacts", E::Contacts, {S::Density}, kBodies},
    {P::PushBodies, "push bodies", "fluid/push_bodies", E::ContactBodies, {S::Density}, kBodies},
    {P::Iterate, "iterate", "fluid/iterate", E::Gather, {S::Iterate}, kIterates},
    {P::DisplaceDensity, "density of solids", "fluid/solids", E::NearSolids, kSolve, kSolids},
    {P::MouthDensity, "density of mouths", "fluid/mouth_density", E::NearMouths, kSolve, kEmits},
    {P::Density, "density", "fluid/density", E::Gather, kSolve},
    {P::Control, "control", "fluid/control", E::One, {}, {separate}},
    {P::ShearViscosity, "viscosity by shear", "fluid/shear_viscosity", E::Gather, kEnd, kShearViscosity},
    {P::Pairs, "pairs at solids", "fluid/pairs", E::NearGather, {S::Correct, S::Iterate}, kSolids},
    {P::Correct, "correct", "fluid/correct", E::Gather, kEnd},
    {P::Collide, "collide", "fluid/collide", E::InReach, kEnd, kSolids},

    {P::SumLoads, "sum loads", "fluid/loads", E::NearSolids, {S::Correct, S::Iterate}, kLoads, kClusters},
    {P::SolidLoads, "loads on solids", "fluid/solid_loads", E::One, {S::Correct, S::Iterate}, kLoads},
    {P::MoveBodies, "move bodies", "fluid/move_bodies", E::One, {S::Correct, S::Iterate}, kBodies},

    {P::Pressure, "pressure at probes", "fluid/pressure", E::PressureProbes, {S::Correct}, kProbesPressure},

    {P::NoSlipHold, "no-slip hold of solids", "fluid/no_slip_hold", E::NearSolids, kEnd, kNoSlip},
    {P::Viscosity, "viscosity", "fluid/viscosity", E::Gather, kEnd, kViscous},
    {P::ViscosityPlan, "viscosity plan", "fluid/viscosity_plan", E::One, kEnd, {viscous}},
    {P::ViscosityStart, "viscosity start", "fluid/viscosity_start", E::Particles, kEnd, {viscous}},
    {P::ViscosityStep, "viscosity step", "fluid/viscosity_step", E::Gather, kEnd, {stepsOfViscosity}},
    {P::NoSlipSums, "no-slip sums of bodies", "fluid/no_slip_sums", E::NearSolids, kEnd, {noSlipBodies}},
    {P::NoSlipBodies, "no slip of bodies", "fluid/no_slip_bodies", E::Bodies, kEnd, {noSlipBodies}},
    {P::NoSlip, "no slip at bodies", "fluid/no_slip", E::NearSolids, kEnd, {noSlipAfterwards}},
    {P::NoSlipLoads, "no-slip loads", "fluid/force_loads", E::One, kEnd, {noSlipLoads}},
    {P::ViscousDisplacement, "viscous displacement", "fluid/viscous_displacement", E::Particles, kEnd, {shearViscosity}},
    {P::VelocityNoise, "velocity noise", "fluid/velocity_noise", E::Gather, {S::NoiseDamping}, kNoisy},
    {P::NoiseDamping, "noise damping", "fluid/noise_damping", E::Gather, {S::NoiseDamping}, kNoisy},
    {P::Diffusion, "diffusion", "fluid/diffusion", E::Gather, kDiffusion, kDiffuses},
    {P::DiffusionPlan, "diffusion plan", "fluid/diffusion_plan", E::One, kDiffusion, {diffuses}},
    {P::DiffusionStart, "diffusion start", "fluid/diffusion_start", E::Particles, kDiffusion, {diffuses}},
    {P::DiffusionStep, "diffusion step", "fluid/diffusion_step", E::Gather, kDiffusion, {stepsOfDiffusion}},
    {P::Curl, "curl", "fluid/curl", E::Gather, kEnd, kSwirls, kForce},
    {P::Confine, "confine", "fluid/confine", E::Gather, kEnd, kSwirls, kForce},
    {P::Drag, "drag", "fluid/drag", E::Particles, kEnd, kDrags, kForce},
    {P::SurfacePlanes, "planes of solids", "fluid/surface_planes", E::NearSolids, kEnd, {wetsSolids}},
    {P::SurfaceParticles, "particles at surfaces", "fluid/surface_particles", E::Gather, kEnd, {tense}},
    {P::SurfaceTension, "surface tension", "fluid/surface_tension", E::Gather, kEnd, kTense},
    {P::SurfaceForces, "forces of surfaces", "fluid/surface_forces", E::Particles, kEnd, {tense}},
    {P::SurfaceReactions, "surface tension on solids", "fluid/surface_reactions", E::NearSolids, kEnd, {pullsSolids}},
    {P::SurfaceLoads, "surface loads", "fluid/force_loads", E::One, kEnd, {pullsSolids}},
    {P::PredictAfterForces, "predict after forces", "fluid/predict", E::Particles, kEndOrDamped, {forcesOrDamping}},
    {P::PredictAtSolids, "predict at solids", "fluid/predict", E::NearSolids, kEndOrDamped, {forcesOrDampingAtSolids}},
    {P::KeepMouthsFree, "keep mouths free", "fluid/mouths", E::NearMouths, kEnd, {emits}},
    {P::Drain, "drain", "fluid/drain", E::Particles, kEnd, kDrainsFluid},

    {P::MeasureDisplaced, "measure solids", "fluid/solids", E::NearSolids, kFigures, {solids}},
    {P::MeasureMouths, "measure mouths", "fluid/mouth_density", E::NearMouths, kFigures, {emits}},
    {P::MeasureKeys, "measure keys", "fluid/keys", E::Keys, kFigures},
    {P::MeasureOrder, "measure order", "fluid/measure_order", E::Particles, kFigures},
    {P::Measure, "measure", "fluid/measure", E::Particles, kFigures, kAlways, kClusters},
    {P::MeasureFluids, "measure fluids", "fluid/measure_fluids", E::Particles, kFigures, kFluids},
    {P::MeasureSums, "measure sums", "fluid/measure_sums", E::Partials},
    {P::Reduce, "reduce", "fluid/measure_reduce"},
}};

}  // namespace

std::span<const FluidPassRow, kFluidPasses> fluidPassTable() { return kPassTable; }

bool hasForces(const FluidSetup& setup) {
  if (viscous(setup) || tense(setup)) return true;
  for (const FluidPassRow& row : kPassTable)
    if (row.options.force && row.condition.holds(setup)) return true;
  return false;
}

}  // namespace rill
