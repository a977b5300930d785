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
    declare(graph, FluidPass::MouthDensity, start, MouthDensityPush{iteration == 0});
    alias(Particle, Prediction);
    declare(graph, FluidPass::Density, start, DensityPush{0, 0, iteration, parity, first});
    declare(graph, FluidPass::Control, Start::Always, ControlPush{iteration, parity, first});
  }
  alias(Particle, Work);
  declare(graph, FluidPass::ShearViscosity, Start::Correct, ChunkPush{});
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
  for (uint32_t iteration = 0; iteration < contactIterations(setup.params.bodyCount); ++iteration) {
    declare(graph, FluidPass::Contacts, Start::Density, ContactPush{iteration});
    declare(graph, FluidPass::PushBodies, Start::Density);
  }
}

// Forces change velocities only. One pass after all of them predicts positions from the resulting velocities.
void FluidImpl::declareForces(Graph& graph, bool first) {
  if (exists(FluidPass::Viscosity, setup)) declareViscosity(graph);
  if (first && exists(FluidPass::NoiseDamping, setup)) declareNoiseDamping(graph);
  if (first && exists(FluidPass::Diffusion, setup)) declareDiffusion(graph);
  for (const FluidPassRow& row : fluidPassTable()) {
    if (!row.options.force) continue;
    if (row.extent == Extent::Gather)
      declare(graph, row.id, Start::Correct, ChunkPush{});
    else
      declare(graph, row.id, Start::Correct);
  }
  if (exists(FluidPass::SurfaceTension, setup)) declareTension(graph);
  if (!first && !hasForces(setup)) return;
  const Start start = hasForces(setup) ? Start::Correct : Start::NoiseDamping;
  declare(graph, FluidPass::PredictAfterForces, start);
  declare(graph, FluidPass::PredictAtSolids, start);
}

// An implicit step, by as many steps of Chebyshev's iteration as are recorded, of which the device takes those that it needs.
void FluidImpl::declareViscosity(Graph& graph) {
  using enum FluidArray;
  declare(graph, FluidPass::NoSlipHold, Start::Correct);
  declare(graph, FluidPass::Viscosity, Start::Correct, ChunkPush{});
  declare(graph, FluidPass::ViscosityPlan, Start::Correct);
  alias(DirectionTo, Direction);
  declare(graph, FluidPass::ViscosityStart, Start::Correct);
  for (uint32_t step = 1; step < setup.params.viscositySteps; ++step) {
    alias(DirectionFrom, step % 2 == 1 ? Direction : NextDirection);
    alias(DirectionTo, step % 2 == 1 ? NextDirection : Direction);
    declare(graph, FluidPass::ViscosityStep, Start::Correct, ChunkPush{0, 0, step});
  }
  declareNoSlip(graph);
  declare(graph, FluidPass::ViscousDisplacement, Start::Correct);
}

// Bodies first get the velocity that they will have, so that the fluid sticks to that.
void FluidImpl::declareNoSlip(Graph& graph) {
  declare(graph, FluidPass::NoSlipSums, Start::Correct);
  declare(graph, FluidPass::NoSlipBodies, Start::Correct);
  declare(graph, FluidPass::NoSlip, Start::Correct);
  declare(graph, FluidPass::NoSlipLoads, Start::Correct, LoadPush{exists(FluidPass::SurfaceLoads, setup) ? 0u : 1u});
}

// By the positions at the end of the substep.
void FluidImpl::declareTension(Graph& graph) {
  using enum FluidArray;
  declare(graph, FluidPass::SurfacePlanes, Start::Correct);
  alias(Particle, Position);
  declare(graph, FluidPass::SurfaceParticles, Start::Correct, ChunkPush{});
  declare(graph, FluidPass::SurfaceTension, Start::Correct, ChunkPush{});
  declare(graph, FluidPass::SurfaceForces, Start::Correct);
  declare(graph, FluidPass::SurfaceReactions, Start::Correct);
  declare(graph, FluidPass::SurfaceLoads, Start::Correct, LoadPush{1});
  alias(Particle, Work);
}

void FluidImpl::declareNoiseDamping(Graph& graph) {
  using enum FluidArray;
  alias(SweepFrom, Velocity);
  alias(SweepTo, Smoothed);
  declare(graph, FluidPass::VelocityNoise, Start::NoiseDamping, ChunkPush{});
  alias(SweepFrom, Smoothed);
  declare(graph, FluidPass::NoiseDamping, Start::NoiseDamping, ChunkPush{});
}

// An explicit step of as many stages as are recorded, of which the device takes those that it needs.
void FluidImpl::declareDiffusion(Graph& graph) {
  using enum FluidArray;
  declare(graph, FluidPass::Diffusion, Start::Diffusion, ChunkPush{});
  declare(graph, FluidPass::DiffusionPlan, Start::Diffusion);
  declare(graph, FluidPass::DiffusionStart, Start::Diffusion);
  for (uint32_t stage = 1; stage < setup.params.diffusionStages; ++stage) {
    alias(ConcentrationFrom, stage % 2 == 1 ? NextConcentration : Concentration);
    alias(ConcentrationTo, stage % 2 == 1 ? Concentration : NextConcentration);
    declare(graph, FluidPass::DiffusionStep, Start::Diffusion, ChunkPush{0, 0, stage});
  }
}

}  // namespace rill
