#pragma once
// The one table of a fluid's passes. Pipelines, bindings, dispatch commands, reports of what is skipped and counts of what ran follow from
// its rows. To add a pass: a value of FluidPass and its row in pass_table.cpp, its shader in shaders/fluid, and
// the call that declares it, in substep_passes.cpp for one of a substep.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "fluid/settings.hpp"
#include "gpu/shader_constants.hpp"
#include "shared/fluid_records.h"

namespace rill {

enum class FluidPass : uint8_t {
  PlanEmission,
  Begin,
  FallAsleep,
  LoadsAsleep,
  Predict,
  PredictFirstAtSolids,
  // A rebuild.
  Emit,
  RestMotion,
  RestSolids,
  RestRegions,
  RestWake,
  RestZones,
  Keys,
  Reorder,
  SortConcentration,
  KeepConcentration,
  BuildList,
  NearMouths,
  FinishRebuild,
  // A substep.
  MoveSolids,
  PredictBodies,
  TouchedSolids,
  CountContacts,
  Contacts,
  PushBodies,
  Iterate,
  DisplaceDensity,
  MouthDensity,
  Density,
  Control,
  ShearViscosity,
  Pairs,
  Correct,
  Collide,
  SumLoads,
  SolidLoads,
  MoveBodies,
  Pressure,
  NoSlipHold,
  Viscosity,
  ViscosityPlan,
  ViscosityStart,
  ViscosityStep,
  NoSlipSums,
  NoSlipBodies,
  NoSlip,
  NoSlipLoads,
  ViscousDisplacement,
  VelocityNoise,
  NoiseDamping,
  Diffusion,
  DiffusionPlan,
  DiffusionStart,
  DiffusionStep,
  Curl,
  Confine,
  Drag,
  SurfacePlanes,
  SurfaceParticles,
  SurfaceTension,
  SurfaceForces,
  SurfaceReactions,
  SurfaceLoads,
  PredictAfterForces,
  PredictAtSolids,
  KeepMouthsFree,
  Drain,
  // Figures.
  MeasureDisplaced,
  MeasureMouths,
  MeasureKeys,
  MeasureOrder,
  Measure,
  MeasureFluids,
  MeasureSums,
  Reduce,
  kCount
};
constexpr size_t kFluidPasses = static_cast<size_t>(FluidPass::kCount);

/// The part of an advance that a pass belongs to. Those of a measurement are in no advance without figures.
enum class PassSection : uint8_t { Start, Rebuild, Substep, Figures };
constexpr PassSection sectionOf(FluidPass pass) {
  if (pass < FluidPass::Emit) return PassSection::Start;
  if (pass < FluidPass::MoveSolids) return PassSection::Rebuild;
  return pass < FluidPass::MeasureDisplaced ? PassSection::Substep : PassSection::Figures;
}

/// What starts a dispatch; shaders/shared/dispatch_commands.h says when.
enum class Start : uint8_t {
  Always = kStartAlways,
  Predict = kStartPredict,
  Density = kStartDensity,
  Iterate = kStartIterate,
  Correct = kStartCorrect,
  CorrectOdd = kStartCorrectOdd,  ///< in place of Correct, in every second substep; rows and calls name Correct
  NoiseDamping = kStartNoiseDamping,
  Rebuild = kStartRebuild,
  Figures = kStartFigures,
  FallAsleep = kStartFallAsleep,
  Diffusion = kStartDiffusion,
  kCount
};
constexpr size_t kStarts = static_cast<size_t>(Start::kCount);

/// What a pass is over.
enum class Extent : uint8_t {
  One,         ///< one workgroup
  Particles,   ///< all particles
  Keys,        ///< the keys of a sort: of all particles, which a variant of the shader counts, or of all entries if it is by digits
  Partials,    ///< the workgroups that add up figures
  Chunks,      ///< all particles, a dispatch for each buffer of the neighbor list
  Gather,      ///< the same over neighbors, in two variants: the device starts the one that reads lists or the one that can walk the grid
  NearSolids,  ///< particles near solids
  InReach,     ///< particles in reach of solids
  NearMouths,  ///< particles near mouths of emitters
  Regions,     ///< regions that fall asleep on their own
  Bodies,      ///< rigid bodies
  ContactPoints,   ///< sample points of those that may touch something
  Contacts,        ///< those of their sample points that may touch something
  ContactBodies,   ///< rigid bodies in contact
  PressureProbes,  ///< a workgroup each
  Births,          ///< particles that emitters may add at a rebuild
  NearGather       ///< the same over their neighbors; where passes are merged (on GPUs) in the variant that can walk the grid alone
};

/// Whether a pass sums over neighbors.
constexpr bool gathers(Extent extent) { return extent == Extent::Gather || extent == Extent::NearGather; }

/// When a pass exists, and what the report of skipped passes says where it does not.
struct PassCondition {
  bool (*holds)(const FluidSetup&) = [](const FluidSetup&) { return true; };
  const char* reason = nullptr;            ///< null: it goes unsaid
  std::string FluidSetup::*why = nullptr;  ///< in place of `reason`
};

struct PassOptions {
  NamedConstant constant = {};  ///< besides those of the fluid
  bool clusters = false;        ///< CLUSTER invocations work together, in whole subgroups
  bool force = false;           ///< changes velocities at the end of every substep, in the order of the table; declared by its row alone
};

struct FluidPassRow {
  FluidPass id;
  std::string_view name;    ///< in graphs and reports
  std::string_view shader;  ///< reads arrays through texel buffers if the fluid does and the shader has such a variant
  Extent extent = Extent::One;
  std::array<Start, 2> starts = {};  ///< Start::Always, or up to two others
  PassCondition condition = {};
  PassOptions options = {};
};

/// In the order of FluidPass.
std::span<const FluidPassRow, kFluidPasses> fluidPassTable();
inline const FluidPassRow& rowOf(FluidPass pass) { return fluidPassTable()[static_cast<size_t>(pass)]; }
inline bool exists(FluidPass pass, const FluidSetup& setup) { return rowOf(pass).condition.holds(setup); }

/// Whether a pass also does what follows from it, in place of the control pass (FluidDesc::mergePasses).
inline bool runsControl(FluidPass pass, const FluidSetup& setup) { return pass == FluidPass::Density && setup.mergesPasses; }

/// Whether viscosity or another force changes velocities in every substep: the prediction then follows after them.
bool hasForces(const FluidSetup& setup);

}  // namespace rill
