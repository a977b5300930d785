#include "fluid/pass_table.hpp"

#include <array>

namespace rill {
namespace {

bool near(const FluidSetup& s) { return s.near; }
bool solids(const FluidSetup& s) { return s.params.solidCount > 0; }
bool moves(const FluidSetup& s) { return s.movingSolids; }
bool iterates(const FluidSetup& s) { return s.params.iterations > 1; }
bool artificialPressure(const FluidSetup& s) { return s.params.tensileRate > 0; }
bool viscous(const FluidSetup& s) { return s.viscositySweeps > 0; }
bool dampsNoise(const FluidSetup& s) { return s.params.noiseDampingRate > 0; }
bool swirls(const FluidSetup& s) { return s.params.vorticity > 0; }
bool drags(const FluidSetup& s) { return s.params.drag > 0; }
bool copies(const FluidSetup& s) { return s.viscositySweeps % 2 == 1 || dampsNoise(s); }
bool terms(const FluidSetup& s) { return hasForces(s) || dampsNoise(s); }
bool termsAndSolids(const FluidSetup& s) { return terms(s) && solids(s); }

using Reason = std::string_view;
Reason noWalls(const FluidSetup&) { return "no domain and no solids"; }
Reason noSolids(const FluidSetup&) { return "no solids"; }
Reason noMotion(const FluidSetup&) { return "no solid moves"; }
Reason oneIteration(const FluidSetup&) { return "one iteration a substep"; }
Reason noArtificialPressure(const FluidSetup& s) { return s.whyNoArtificialPressure; }
Reason noViscosity(const FluidSetup&) { return "viscosity is 0"; }
Reason noNoiseDamping(const FluidSetup& s) { return s.whyNoNoiseDamping; }
Reason noVorticity(const FluidSetup&) { return "vorticity is 0"; }
Reason noDrag(const FluidSetup&) { return "drag is 0"; }

using P = FluidPass;
using E = Extent;
using S = Start;
constexpr std::array<FluidPassRow, kFluidPasses> kPassTable = {{
    {.id = P::Begin, .name = "begin", .shader = "fluid/begin"},
    {.id = P::Predict, .name = "predict", .shader = "fluid/predict", .extent = E::Particles, .starts = {S::Predict}},

    {.id = P::Keys, .name = "keys", .shader = "fluid/keys", .extent = E::Particles, .starts = {S::Rebuild}, .constant = {"REBUILDS", true}},
    {.id = P::Reorder, .name = "reorder", .shader = "fluid/reorder", .extent = E::Particles, .starts = {S::Rebuild}},
    {.id = P::BuildList,
     .name = "build list",
     .shader = "fluid/build",
     .extent = E::Chunks,
     .starts = {S::Rebuild},
     .wholeSubgroups = true},
    {.id = P::FinishRebuild, .name = "finish rebuild", .shader = "fluid/finish_rebuild"},

    {.id = P::MoveSolids, .name = "move solids", .shader = "fluid/pose", .starts = {S::Density}, .exists = moves, .reason = noMotion},
    {.id = P::Iterate,
     .name = "iterate",
     .shader = "fluid/iterate",
     .extent = E::Gather,
     .starts = {S::Iterate},
     .exists = iterates,
     .reason = oneIteration},
    {.id = P::Walls,
     .name = "walls and solids",
     .shader = "fluid/walls",
     .extent = E::Near,
     .starts = {S::Density, S::Iterate},
     .exists = near,
     .reason = noWalls},
    {.id = P::Density, .name = "density", .shader = "fluid/density", .extent = E::Gather, .starts = {S::Density, S::Iterate}},
    {.id = P::Control, .name = "control", .shader = "fluid/control"},
    {.id = P::CorrectWithArtificialPressure,
     .name = "correct",
     .shader = "fluid/correct",
     .extent = E::Gather,
     .starts = {S::Correct},
     .exists = artificialPressure,
     .reason = noArtificialPressure,
     .feature = "artificial pressure",
     .constant = {"ARTIFICIAL_PRESSURE", true}},
    {.id = P::Correct, .name = "correct", .shader = "fluid/correct", .extent = E::Gather, .starts = {S::Correct}},
    {.id = P::Collide,
     .name = "collide",
     .shader = "fluid/collide",
     .extent = E::Corner,
     .starts = {S::Correct},
     .exists = solids,
     .reason = noSolids},

    {.id = P::Viscosity,
     .name = "viscosity",
     .shader = "fluid/viscosity",
     .extent = E::Gather,
     .starts = {S::Correct},
     .exists = viscous,
     .reason = noViscosity},
    {.id = P::NoiseDamping,
     .name = "noise damping",
     .shader = "fluid/viscosity",
     .extent = E::Gather,
     .starts = {S::NoiseDamping},
     .exists = dampsNoise,
     .reason = noNoiseDamping},
    {.id = P::CopyVelocities,
     .name = "copy velocities",
     .shader = "fluid/copy_velocity",
     .extent = E::Particles,
     .starts = {S::Correct, S::NoiseDamping},
     .exists = copies},
    {.id = P::Curl,
     .name = "curl",
     .shader = "fluid/curl",
     .extent = E::Gather,
     .starts = {S::Correct},
     .exists = swirls,
     .reason = noVorticity,
     .force = true},
    {.id = P::Confine,
     .name = "confine",
     .shader = "fluid/confine",
     .extent = E::Gather,
     .starts = {S::Correct},
     .exists = swirls,
     .reason = noVorticity,
     .force = true},
    {.id = P::Drag,
     .name = "drag",
     .shader = "fluid/drag",
     .extent = E::Particles,
     .starts = {S::Correct},
     .exists = drags,
     .reason = noDrag,
     .force = true},
    {.id = P::PredictAfterTerms,
     .name = "predict after terms",
     .shader = "fluid/predict",
     .extent = E::Particles,
     .starts = {S::Correct, S::NoiseDamping},
     .exists = terms,
     .constant = {"SOLIDS", false}},
    {.id = P::PredictAtSolids,
     .name = "predict at solids",
     .shader = "fluid/predict",
     .extent = E::Corner,
     .starts = {S::Correct, S::NoiseDamping},
     .exists = termsAndSolids},

    {.id = P::MeasureWalls, .name = "measure walls", .shader = "fluid/walls", .extent = E::Near, .starts = {S::Figures}, .exists = near},
    {.id = P::MeasureKeys, .name = "measure keys", .shader = "fluid/keys", .extent = E::Particles, .starts = {S::Figures}},
    {.id = P::MeasureOrder, .name = "measure order", .shader = "fluid/measure_order", .extent = E::Particles, .starts = {S::Figures}},
    {.id = P::Measure,
     .name = "measure",
     .shader = "fluid/measure",
     .extent = E::Particles,
     .starts = {S::Figures},
     .wholeSubgroups = true},
    {.id = P::MeasureSums, .name = "measure sums", .shader = "fluid/measure_sums", .extent = E::Partials},
    {.id = P::Reduce, .name = "reduce", .shader = "fluid/measure_reduce"},
}};

}  // namespace

std::span<const FluidPassRow, kFluidPasses> fluidPassTable() { return kPassTable; }

bool hasForces(const FluidSetup& setup) {
  if (viscous(setup)) return true;
  for (const FluidPassRow& row : fluidPassTable())
    if (row.force && exists(row.id, setup)) return true;
  return false;
}

}  // namespace rill
