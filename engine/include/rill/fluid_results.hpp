#pragma once
// What a Fluid (rill/fluid.hpp) measures: loads on solids, pressures, flows, motions of bodies, and statistics.
//
//   const std::optional<rill::FluidStats> stats = water.stats();  // of the last frame that asked for them
//   if (stats && stats->ledger.drained == stats->ledger.filled) return 0;  // everything has drained
#include <cstdint>
#include <optional>
#include <vector>

#include "rill/vectors.hpp"

namespace rill {

/// What the fluid does to a solid, in the axes of the scene; torques are about the solid's center (of a mesh: its origin).
struct SolidLoad {
  Double3 force = {0, 0, 0}, torque = {0, 0, 0};            ///< mean over the time that the last ended advance took, N and N m
  Double3 impulse = {0, 0, 0}, angularImpulse = {0, 0, 0};  ///< since the start, N s and N m s
};

/// Pressure of the fluid at a point, over that of the air: 0 in air, and inside a solid.
struct PressureReading {
  double mean = 0;       ///< over the time that the last ended advance took, Pa, >= 0
  double integral = 0;   ///< over the time since the start, Pa s
  bool covered = false;  ///< the point was inside a solid at the end
};

/// What has gone through an emitter or a drain since the start.
struct FlowReading {
  uint64_t particles = 0;
  double volume = 0;     ///< m^3: particles times spacing^3
  double blocked_s = 0;  ///< of an emitter: how long it had no place for some of its particles
};

/// What has become of the particles: filled + emitted = active + drained + left + inactive, always.
struct FluidLedger {
  uint64_t filled = 0;    ///< at the start
  uint64_t emitted = 0;   ///< by emitters
  uint64_t drained = 0;   ///< removed by drains
  uint64_t left = 0;      ///< removed beyond open sides (Domain::open_removes)
  uint64_t inactive = 0;  ///< not simulated: of the start, with a value that was not finite
  bool full = false;      ///< emitters found the capacity reached at some time
  bool outOfIds = false;  ///< emitters have stopped for good: ids, of which there are 0x7F000000, have run out
};

/// Where a body is and how fast it moves, in the scene.
struct BodyMotion {
  uint32_t solid = 0;                   ///< index among the scene's solids
  bool stopped = false;                 ///< for good: it moved farther than positions can be told apart, or its motion was not finite
  Double3 center = {0, 0, 0};           ///< of mass, m
  Quaternion rotation = {0, 0, 0, 1};   ///< unit quaternion x y z w, from the solid's frame to the scene's
  Double3 velocity = {0, 0, 0};         ///< of the center of mass, m/s
  Double3 angularVelocity = {0, 0, 0};  ///< rad/s
};

/// Figures of one of the scene's fluids.
struct FluidFigures {
  uint64_t particles = 0;                            ///< active ones
  FluidLedger ledger = {};                           ///< `full` and `outOfIds` are those of all
  double densityErrorMean = 0, densityErrorMax = 0;  ///< max(rho / rho0 - 1, 0)
};

/// Sums over the bodies of a scene.
struct BodyFigures {
  double kinetic_J = 0, potential_J = 0;  ///< potential: 0 at the origin, as that of the fluid
  Double3 momentum = {0, 0, 0};           ///< kg m/s
  uint64_t stopped = 0;                   ///< bodies; see BodyMotion::stopped
};

/// Statistics at one time. Sums are evaluated in a fixed order, so they are deterministic.
struct FluidStats {
  double time_s = 0;       ///< simulated time
  uint64_t particles = 0;  ///< active ones; in a scene in which none come or go, inactive ones too
  FluidLedger ledger = {};
  std::vector<FluidFigures> fluids = {};  ///< in the order of resolvedFluids(), which it has as many as
  double emitterBlocked_s = 0;            ///< since the start, in which some emitter had no place for its particles
  std::vector<double> emittersBlocked_s;  ///< the same of each emitter, then of the domain's inflow
  uint32_t substeps = 0;                  ///< in the last advance
  uint32_t iterations = 0;                ///< Jacobi iterations in the last advance, summed over substeps
  double timeDropped_s = 0;               ///< in the last advance
  double densityErrorMean = 0, densityErrorP99 = 0, densityErrorMax = 0;  ///< max(rho / rho0 - 1, 0)
  double densitySignedMedian = 0;  ///< median of rho / rho0 - 1 over particles with a full neighborhood
  double kinetic_J = 0, potential_J = 0;
  Double3 momentum = {0, 0, 0};            ///< kg m/s
  Double3 centerOfMass = {0, 0, 0};        ///< m
  double maxSpeed = 0;                     ///< m/s
  uint64_t nonFinite = 0;                  ///< particles made inactive since the start because a value was not finite
  uint64_t outside = 0;                    ///< particles beyond a closed wall, or that left through an open side
  uint64_t neighborOverflow = 0;           ///< particles that exceeded the list capacity at the last build and search the grid instead
  uint64_t loopBoundHits = 0;              ///< times that a shader loop reached its iteration limit since the start
  uint32_t listBuilds = 0;                 ///< neighbor list builds in the last advance
  std::optional<BodyFigures> bodies = {};  ///< if the scene has some; they are in no other figure
  std::optional<uint64_t> sleeping = {};   ///< particles asleep, all or those in regions at rest, with solver.sleep
  uint64_t diffusionBoundHits = 0;         ///< steps of diffusion since the start that needed more stages than they take
  uint64_t viscosityBoundHits = 0;         ///< substeps since the start whose viscosity needed more steps than its solve takes
  uint64_t viscosityCapped = 0;            ///< particles for which shear asked for more viscosity than the last solve reaches
  double artificialViscosity_Pa_s = 0;     ///< what solver.artificial_viscosity adds to the shortest waves now, Pa s, before its bound
};

}  // namespace rill
