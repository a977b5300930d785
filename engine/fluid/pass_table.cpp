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
bool copies(const FluidSetup& s) { return s.viscositySweeps % 2 == 1 || dampsNoise(s); }
bool terms(const FluidSetup& s) { return viscous(s) || swirls(s) || dampsNoise(s); }
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

}  // namespace

std::span<const FluidPassRow, kFluidPasses> fluidPassTable() {
  using enum FluidPass;
  using enum Extent;
  static const std::array<FluidPassRow, kFluidPasses> table = {{
      {Begin, "begin", "fluid/begin"},
      {FluidPass::Predict, "predict", "fluid/predict", Particles, {Start::Predict}},

      {Keys, "keys", "fluid/keys", Particles, {Start::Rebuild}, nullptr, nullptr, {{"REBUILDS", true}}},
      {Reorder, "reorder", "fluid/reorder", Particles, {Start::Rebuild}},
      {BuildList, "build list", "fluid/build", Chunks, {Start::Rebuild}, nullptr, nullptr, {}, true},
      {FinishRebuild, "finish rebuild", "fluid/finish_rebuild"},

      {MoveSolids, "move solids", "fluid/pose", One, {Start::Density}, moves, noMotion},
      {FluidPass::Iterate, "iterate", "fluid/iterate", Gather, {Start::Iterate}, iterates, oneIteration},
      {Walls, "walls and solids", "fluid/walls", Near, {Start::Density, Start::Iterate}, near, noWalls},
      {FluidPass::Density, "density", "fluid/density", Gather, {Start::Density, Start::Iterate}},
      {Control, "control", "fluid/control"},
      {CorrectWithArtificialPressure,
       "correct",
       "fluid/correct",
       Gather,
       {Start::Correct},
       artificialPressure,
       noArtificialPressure,
       {{"ARTIFICIAL_PRESSURE", true}},
       false,
       "artificial pressure"},
      {FluidPass::Correct, "correct", "fluid/correct", Gather, {Start::Correct}},
      {Collide, "collide", "fluid/collide", Corner, {Start::Correct}, solids, noSolids},
      {Viscosity, "viscosity", "fluid/viscosity", Gather, {Start::Correct}, viscous, noViscosity},
      {FluidPass::NoiseDamping, "noise damping", "fluid/viscosity", Gather, {Start::NoiseDamping}, dampsNoise, noNoiseDamping},
      {CopyVelocities, "copy velocities", "fluid/copy_velocity", Particles, {Start::Correct, Start::NoiseDamping}, copies},
      {Curl, "curl", "fluid/curl", Gather, {Start::Correct}, swirls, noVorticity},
      {Confine, "confine", "fluid/confine", Gather, {Start::Correct}, swirls, noVorticity},
      {PredictAfterTerms,
       "predict after terms",
       "fluid/predict",
       Particles,
       {Start::Correct, Start::NoiseDamping},
       terms,
       nullptr,
       {{"SOLIDS", false}}},
      {PredictAtSolids, "predict at solids", "fluid/predict", Corner, {Start::Correct, Start::NoiseDamping}, termsAndSolids},

      {MeasureWalls, "measure walls", "fluid/walls", Near, {Start::Figures}, near},
      {MeasureKeys, "measure keys", "fluid/keys", Particles, {Start::Figures}},
      {MeasureOrder, "measure order", "fluid/measure_order", Particles, {Start::Figures}},
      {Measure, "measure", "fluid/measure", Particles, {Start::Figures}, nullptr, nullptr, {}, true},
      {MeasureSums, "measure sums", "fluid/measure_sums", Partials},
      {Reduce, "reduce", "fluid/measure_reduce"},
  }};
  return table;
}

}  // namespace rill
