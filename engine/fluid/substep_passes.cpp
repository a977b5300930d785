// The passes of one substep: density, correction, contact, and the forces that a scene has. See docs/method.md.
#include "fluid/fluid_impl.hpp"

namespace rill {

void FluidImpl::declareSubstep(Graph& graph, uint32_t parity, bool first) {
  using enum FluidArray;
  ++recording_.substeps;
  parity_ = parity;
  beginSection();
  declare(graph, FluidPass::MoveSolids, Start::Density);
  declareBodies(graph);
  for (uint32_t iteration = 0; iteration < setup.params.iterations; ++iteration) {
    const Start start = iteration == 0 ? Start::Density : Start::Iterate;
    const ChunkPush push{0, 0, iteration};
    alias(Particle, Work);
    if (iteration > 0) {
      declare(graph, FluidPass::Pairs, start, push);
      declare(graph, FluidPass::Iterate, start, push);
      declare(graph, FluidPass::SumLoads, start);
      if (!setup.bodies.empty()) declare(graph, FluidPass::SolidLoads, start, LoadPush{0});
      declare(graph, FluidPass::MoveBodies, start, LoadPush{0});
    }
    alias(Place, Prediction);
    declare(graph, FluidPass::DisplaceDensity, start, DisplacePush{iteration == 0});
    alias(Particle, Prediction);
    declare(graph, FluidPass::Density, start, DensityPush{0, 0, iteration, parity, first});
    declare(graph, FluidPass::Control, Start::Always, ControlPush{iteration, parity, first});
  }
  alias(Particle, Work);
  declare(graph, FluidPass::Pairs, Start::Correct, ChunkPush{});
  declare(graph, FluidPass::Correct, Start::Correct, ChunkPush{});
  declare(graph, FluidPass::Collide, Start::Correct);
  declare(graph, FluidPass::SumLoads, Start::Correct);
  declare(graph, FluidPass::SolidLoads, Start::Correct, LoadPush{1});
  declare(graph, FluidPass::MoveBodies, Start::Correct, LoadPush{1});
  declare(graph, FluidPass::Pressure, Start::Correct);
  declareForces(graph, first);
  declare(graph, FluidPass::KeepMouthsFree, Start::Correct);
  declare(graph, FluidPass::Drain, Start::Correct);
}

// Predicts bodies from velocity, gravity and warm start, then solves their contacts.
void FluidImpl::declareBodies(Graph& graph) {
  declare(graph, FluidPass::PredictBodies, Start::Density);
  declare(graph, FluidPass::TouchedSolids, Start::Density);
  declare(graph, FluidPass::CountContacts, Start::Density, ContactPush{});
  for (uint32_t iteration = 0; iteration < kContactIterations; ++iteration) {
    declare(graph, FluidPass::Contacts, Start::Density, ContactPush{iteration});
    declare(graph, FluidPass::PushBodies, Start::Density);
  }
}

// Forces change velocities only. One pass after all of them predicts positions from the resulting velocities.
void FluidImpl::declareForces(Graph& graph, bool first) {
  if (exists(FluidPass::Viscosity, setup)) declareViscosity(graph);
  if (first && exists(FluidPass::NoiseDamping, setup)) declareNoiseDamping(graph);
  for (const FluidPassRow& row : fluidPassTable()) {
    if (!row.options.force) continue;
    if (row.extent == Extent::Gather)
      declare(graph, row.id, Start::Correct, ChunkPush{});
    else
      declare(graph, row.id, Start::Correct);
  }
  if (!first && !hasForces(setup)) return;
  const Start start = hasForces(setup) ? Start::Correct : Start::NoiseDamping;
  declare(graph, FluidPass::PredictAfterForces, start);
  declare(graph, FluidPass::PredictAtSolids, start);
}

// Sweeps of XSPH, there and back between the velocities and a copy.
void FluidImpl::declareViscosity(Graph& graph) {
  using enum FluidArray;
  const float share = 1.0f / float(setup.viscositySweeps);
  for (uint32_t sweep = 0; sweep < setup.viscositySweeps; ++sweep) {
    alias(SweepFrom, sweep % 2 == 0 ? Velocity : Smoothed);
    alias(SweepTo, sweep % 2 == 0 ? Smoothed : Velocity);
    declare(graph, FluidPass::Viscosity, Start::Correct, SweepPush{0, 0, share});
    declareNoSlip(graph, {share, sweep + 1 == setup.viscositySweeps});
  }
  if (!exists(FluidPass::CopyVelocities, setup)) return;
  alias(SweepFrom, Smoothed);
  declare(graph, FluidPass::CopyVelocities, Start::Correct);
}

// After a sweep, on its result. Bodies first get the velocity that they will have, so that the fluid sticks to that.
void FluidImpl::declareNoSlip(Graph& graph, const NoSlipPush& push) {
  declare(graph, FluidPass::NoSlipSums, Start::Correct, push);
  declare(graph, FluidPass::NoSlipBodies, Start::Correct);
  declare(graph, FluidPass::NoSlip, Start::Correct, push);
  declare(graph, FluidPass::NoSlipLoads, Start::Correct, push);
}

void FluidImpl::declareNoiseDamping(Graph& graph) {
  using enum FluidArray;
  alias(SweepFrom, Velocity);
  alias(SweepTo, Smoothed);
  declare(graph, FluidPass::VelocityNoise, Start::NoiseDamping, ChunkPush{});
  alias(SweepFrom, Smoothed);
  declare(graph, FluidPass::NoiseDamping, Start::NoiseDamping, ChunkPush{});
}

}  // namespace rill
