#pragma once
// The PBF solver as passes of a render graph. All state lives on the device; time steps, list rebuilds and stops are decided there.
//
//   rill::Scene scene;
//   scene.fluid.spacing = 0.04;
//   scene.fill = {rill::Fill{.sphere = rill::SphereShape{{0, 1, 0}, 0.3}}};
//   auto particles = rill::makeParticles(scene);
//   auto water = rill::Fluid::create(device, {.scene = &scene, .particles = &*particles});
//   if (!water) return fail(water.error().message);
//   const rill::FluidState state = (*water)->addTo(graph, {.advance_s = 1.0 / 60});  // every frame
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// All of a fluid's state that the bits of its later steps depend on, between two advances, on the host (ARCHITECTURE.md, "Checkpoints").
/// What a step writes before it reads it is not among it. Arrays have an entry a particle, in the order of the device.
struct FluidSnapshot {
  std::vector<uint32_t> control = {};                ///< FluidControl (shaders/shared/fluid_records.h), word by word
  std::vector<uint32_t> sums = {};                   ///< FluidSums, word by word
  std::vector<float> solids = {};                    ///< center (m) and velocity (m/s) of each solid, six numbers; empty where none moves
  std::vector<Float3> position = {}, velocity = {};  ///< m, m/s
  // Of the warm start; empty without one.
  std::vector<Float4> push = {};  ///< m/s^2; w: the multiplier of the last iteration (m^2), while the start's pressure is being found
  std::vector<float> warm = {};   ///< multipliers, m^2
  std::vector<uint32_t> id = {};
  std::vector<uint32_t> nearWall = {}, nearMore = {};  ///< particles near one wall; near several walls or a solid: rising
  // The neighbor list, as long as it is not due to be built anew.
  uint32_t listCapacity = 0;                 ///< entries a particle that the list holds
  std::vector<uint32_t> neighborCount = {};  ///< empty where the list is due, or the fluid has none
  std::vector<uint32_t> neighbors = {};      ///< of one particle after another; of none that has more than the list holds
  std::vector<uint32_t> cell = {};           ///< of the sorted particles, where some walk the grid
  friend bool operator==(const FluidSnapshot&, const FluidSnapshot&) = default;
};

/// What a Fluid is made from. All are read in create() and not kept.
struct FluidDesc {
  const Scene* scene = nullptr;  ///< settings, domain, solids, gravity; fluid.spacing > 0
  const ParticleSet* particles = nullptr;
  const FluidSnapshot* snapshot = nullptr;  ///< go on from it; of a fluid of the same scene and particles. BadInput where it is none
  /// Before the first substep in time: part particles that overlap at the start (positions move, speeds do not), then find the pressure
  /// that bears the fluid's weight, unless they still overlap. That takes recorded substeps: one where nobody overlaps and at most 512
  /// where some do, and about 3 for each layer of particles, at most 1,024. Where the first frames record fewer, the fluid stands still in
  /// them and their time is dropped (FluidProgress::time_dropped_s).
  bool settle = true;
  bool storageReads = false;  ///< read arrays through storage buffers even where texel buffers would do (slower on most CPU drivers)
};

/// Device memory of a Fluid, in bytes, split as reports show it.
struct FluidMemory {
  uint64_t particle_bytes = 0;  ///< all per-particle arrays, without the list
  uint64_t list_bytes = 0;      ///< the neighbor list; 0 with solver.neighbors "grid"
  uint64_t grid_bytes = 0;      ///< cell starts, at most
  uint64_t total() const { return particle_bytes + list_bytes + grid_bytes; }
};
/// One of them.
struct FluidBuffer {
  const char* name = "";
  uint64_t bytes = 0;
};
/// What a Fluid of `particles` particles will need, computed in 64 bits from the numbers alone: before anything is allocated. Of a scene
/// that checkScene() allows.
RILL_API FluidMemory fluidMemory(const Scene& scene, uint64_t particles);

/// Where the host wants a driven solid at the end of an advance.
struct SolidTarget {
  uint32_t solid = 0;            ///< of the scene's solids; one that is not driven does not move
  double center[3] = {0, 0, 0};  ///< m; not finite: it stays where it is
};

/// One piece of simulation to declare in a graph.
struct FluidStep {
  double advance_s = 0;    ///< s of simulated time to go on from where the last completed advance ended; ignored where `resume`
  bool resume = false;     ///< go on with the time that the last step left over (an offline caller records a frame in pieces)
  uint32_t substeps = 64;  ///< the most that this graph records, rounded up to whole blocks of `Fluid::substepsPerBlock()`
  bool stats = false;      ///< measure Stats at the end
  /// The way of driven solids during the advance: straight, even, at most as fast as each may be. One that is not named stays where it is.
  /// Read in addTo(); ignored where `resume`, and without particles.
  std::span<const SolidTarget> targets = {};
};

/// Where a module finds the particles of this frame: versions of buffers of the same graph. Read them with any Use. A Fluid's buffers have
/// room for one entry more than `count`, which means nothing.
struct FluidState {
  BufferRef position = {};       ///< vec4 a particle: xyz in m relative to `origin`, w unused
  BufferRef velocity = {};       ///< vec4 a particle: xyz in m/s, w the density over rest density where the step asked for `stats`, else 1
  BufferRef id = {};             ///< uint a particle: its number at birth
  BufferRef control = {};        ///< FluidControl (shaders/shared/fluid_records.h), read back by offline callers
  BufferRef solids = {};         ///< SolidRecord (likewise) each, as they are at present; none where no solid is driven
  uint32_t count = 0;            ///< particles
  float spacing = 0;             ///< m
  double origin[3] = {0, 0, 0};  ///< m
};

/// How far an advance has got.
struct FluidProgress {
  bool known = false;         ///< a frame has finished
  double time_s = 0;          ///< simulated time
  double time_left_s = 0;     ///< of the advance; 0 when it is complete
  double time_dropped_s = 0;  ///< of the advance: what did not fit in solver.max_substeps, or in what was recorded of the advance before
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
  double density_signed_median = 0;  ///< of rho / rho0 - 1 over particles with a full neighborhood
  double kinetic_J = 0, potential_J = 0;
  double momentum[3] = {0, 0, 0};        ///< kg m/s
  double center_of_mass[3] = {0, 0, 0};  ///< m
  double max_speed = 0;                  ///< m/s
  uint64_t non_finite = 0;               ///< particles parked since the start
  uint64_t outside = 0;                  ///< centers beyond a closed wall, or gone through an open side
  uint64_t neighbor_overflow = 0;        ///< particles whose list was full at the last build: they walk the grid
  uint64_t loop_bound_hits = 0;          ///< times a bounded shader loop ran into its bound since the start
  uint32_t list_builds = 0;              ///< of the last advance
  double artificial_viscosity_Pa_s = 0;  ///< what solver.artificial_viscosity adds at present, Pa s: nothing while the fluid is rough
};

/// A pass that the device switches on and off: of `of` times that it was recorded it was due `ran` times, and the others were empty
/// dispatches.
struct FluidPassRuns {
  std::string_view name;  ///< as in PassReport; ending with '/', of each pass whose name begins with it
  uint32_t ran = 0, of = 0;
};

class FluidImpl;

/// A Position Based Fluid on a borrowed device (Macklin and Mueller 2013; ARCHITECTURE.md, "A substep"). Declares passes in a graph of its
/// host's; lives longer than every command buffer that they were recorded into.
class RILL_API Fluid {
 public:
  /// BadInput for a description that cannot run, TooLarge (with bytes needed and available) where the device cannot hold it: nothing was
  /// allocated then. OutOfMemory where memory ran out.
  static Expected<std::unique_ptr<Fluid>> create(Device& device, const FluidDesc& desc);
  ~Fluid();

  /// Declares the passes of one step. It advances when recorded, not when declared. A time that is negative or not finite, and a target
  /// that names no solid of the scene, are errors that the graph's compile() reports: nothing is declared then.
  FluidState addTo(Graph& graph, const FluidStep& step);
  /// The particles as they are, between the pieces of an advance too: declares no pass. After a graph of addTo().
  FluidState present(Graph& graph) const;

  /// Of the last finished frame that asked for them.
  std::optional<FluidStats> stats() const;
  /// How far the last finished frame got with its advance. Known without asking for figures.
  const FluidProgress& progress() const;
  /// How often passes ran from the end of the last but one frame that is known to have finished to that of the last; those that are not
  /// named ran as often as they were recorded.
  std::vector<FluidPassRuns> passRuns() const;

  /// Where a driven solid is at the end of the last advance that was declared, m: short of its target where that was too far away.
  /// No numbers (NaN) for a solid that is not driven.
  std::array<double, 3> drivenCenter(uint32_t solid) const;

  uint32_t count() const;  ///< particles, parked ones too
  /// What FluidStep::substeps is rounded up to whole multiples of.
  uint32_t substepsPerBlock() const;
  /// Recorded substeps that complete any advance, the first one with all that FluidDesc::settle asks for: those that the device leaves out,
  /// to rebuild the list or because none is due, are among them.
  uint32_t substepsToComplete() const;
  FluidMemory memory() const;
  std::span<const FluidBuffer> buffers() const;  ///< that live as long as it; those of passes are the graph's (Graph::transients)
  /// What the solver cannot follow, each with its figure ("viscosity 50 Pa s needs ..."). Known at creation.
  std::span<const std::string> warnings() const;

  const FluidImpl& impl() const { return *impl_; }  ///< engine/fluid and its tests; not for hosts

 private:
  explicit Fluid(std::unique_ptr<FluidImpl>);
  std::unique_ptr<FluidImpl> impl_;
};

/// Reads a fluid's state back, in graphs of at most 128 MiB each:
///   for (SnapshotReader reader(fluid); !reader.done(); reader.take(graph)) { graph.reset(); reader.declare(graph); ... run it ... }
/// Before the first, a frame of the fluid with an `advance_s` of 0 has completed; between them nothing else is done with the fluid.
class RILL_API SnapshotReader {
 public:
  explicit SnapshotReader(const Fluid& fluid);
  bool done() const;
  void declare(Graph& graph);
  /// Failed where the graph's frame has not completed.
  Expected<void> take(const Graph& graph);
  FluidSnapshot& snapshot() { return snapshot_; }  ///< once done()

 private:
  void plan();
  const FluidImpl& fluid_;
  FluidSnapshot snapshot_;
  std::vector<uint32_t> parts_ = {};  ///< buffers to be read, in this order
  size_t next_ = 0;
  std::vector<Ticket> tickets_ = {};
};

}  // namespace rill
