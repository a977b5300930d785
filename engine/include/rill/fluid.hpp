#pragma once
// The PBF solver as passes of a render graph. All state lives on the device; time steps, list rebuilds and stops are decided there.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/graph.hpp"
#include "rill/scene.hpp"

namespace rill {

/// What a Fluid is made from. Both are read in create() and not kept.
struct FluidDesc {
  const Scene* scene = nullptr;  ///< settings, domain, solids, gravity; fluid.spacing > 0
  const ParticleSet* particles = nullptr;
  bool settle = true;         ///< before the first substep, part particles that overlap at the start: positions move, speeds do not
  bool storageReads = false;  ///< gather through storage buffers even where texel buffers would hold enough (slower on most CPU drivers)
};

/// Device memory of a Fluid, in bytes, split as reports show it.
struct FluidMemory {
  uint64_t particle_bytes = 0;  ///< all per-particle arrays, without the list
  uint64_t list_bytes = 0;      ///< the neighbour list; 0 with solver.neighbors "grid"
  uint64_t grid_bytes = 0;      ///< cell starts, at most
  uint64_t total() const { return particle_bytes + list_bytes + grid_bytes; }
};
/// What a Fluid of `particles` particles will need, computed in 64 bits from the numbers alone: before anything is allocated.
FluidMemory fluidMemory(const Scene& scene, uint64_t particles);

/// One piece of simulation to declare in a graph.
struct FluidStep {
  double advance_s = 0;    ///< s of simulated time to go on from where the last completed advance ended; ignored where `resume`
  bool resume = false;     ///< go on with the time that the last step left over (an offline caller records a frame in pieces)
  uint32_t substeps = 64;  ///< the most that this graph records, rounded up to whole blocks of `Fluid::substepsPerBlock()`
  bool stats = false;      ///< measure Stats at the end
};

/// Where a module finds the particles of this frame: versions of buffers of the same graph. Read them with any Use.
struct FluidState {
  BufferRef position;            ///< vec4 a particle: xyz in m relative to `origin`, w unused
  BufferRef velocity;            ///< vec4 a particle: xyz in m/s, w the density over rest density where the step asked for `stats`, else 1
  BufferRef id;                  ///< uint a particle: its number at birth
  BufferRef control;             ///< FluidControl (shaders/shared/fluid_records.h), read back by offline callers
  uint32_t count = 0;            ///< particles
  float spacing = 0;             ///< m
  double origin[3] = {0, 0, 0};  ///< m
};

/// How far an advance has got.
struct FluidProgress {
  bool known = false;         ///< a frame has finished
  double time_s = 0;          ///< simulated time
  double time_left_s = 0;     ///< of the advance; 0 when it is complete
  double time_dropped_s = 0;  ///< of the advance: what did not fit in solver.max_substeps
  uint32_t substeps = 0;      ///< of the advance
  uint32_t iterations = 0;    ///< of the advance, Jacobi iterations of all substeps
  uint32_t list_builds = 0;   ///< of the advance
};

/// Figures of one instant, measured on the device with sums in a fixed order.
struct FluidStats {
  double time_s = 0;  ///< simulated time
  uint64_t particles = 0;
  uint32_t substeps = 0;      ///< of the last advance
  uint32_t iterations = 0;    ///< Jacobi iterations of the last advance, all substeps added up
  double time_dropped_s = 0;  ///< of the last advance
  double density_error_mean = 0, density_error_p99 = 0, density_error_max = 0;  ///< compression only, fraction of rest density
  double density_signed_median = 0;  ///< of rho / rho0 - 1 over particles with a full neighbourhood
  double kinetic_J = 0, potential_J = 0;
  double momentum[3] = {0, 0, 0};        ///< kg m/s
  double centre_of_mass[3] = {0, 0, 0};  ///< m
  double max_speed = 0;                  ///< m/s
  uint64_t non_finite = 0;               ///< particles parked since the start
  uint64_t outside = 0;                  ///< centres beyond a closed wall, or gone through an open side
  uint64_t neighbour_overflow = 0;       ///< particles whose list was full at the last build: they walk the grid
  uint64_t loop_bound_hits = 0;          ///< times a bounded shader loop ran into its bound since the start
  uint32_t list_builds = 0;              ///< of the last advance
};

class FluidImpl;

/// A Position Based Fluid on a borrowed device (Macklin and Mueller 2013; ARCHITECTURE.md, "A substep"). Declares passes in a graph of its
/// host's; lives longer than every command buffer that they were recorded into.
class Fluid {
 public:
  /// BadInput for a description that cannot run, TooLarge (with bytes needed and available) where the device cannot hold it: nothing was
  /// allocated then. OutOfMemory where memory ran out.
  static Expected<std::unique_ptr<Fluid>> create(Device& device, const FluidDesc& desc);
  ~Fluid();

  /// Declares the passes of one step. It advances when recorded, not when declared.
  FluidState addTo(Graph& graph, const FluidStep& step);

  /// Of the last finished frame that asked for them.
  std::optional<FluidStats> stats() const;
  /// How far the last finished frame got with its advance. Known without asking for figures.
  const FluidProgress& progress() const;

  uint32_t count() const;  ///< particles, parked ones too
  /// What FluidStep::substeps is rounded up to whole multiples of.
  uint32_t substepsPerBlock() const;
  /// Recorded substeps that complete any advance: those that the device leaves out, to rebuild the list or because none is due, are among
  /// them.
  uint32_t mostSubsteps() const;
  FluidMemory memory() const;
  /// What the solver cannot follow, each with its figure ("viscosity 50 Pa s needs ..."). Known at creation.
  std::span<const std::string> warnings() const;

 private:
  explicit Fluid(std::unique_ptr<FluidImpl>);
  std::unique_ptr<FluidImpl> impl_;
};

}  // namespace rill
