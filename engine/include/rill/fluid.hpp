#pragma once
// Position Based Fluids (Macklin and Mueller 2013) as passes of a render graph. Create a Fluid from a scene and its particles, add its
// passes to the graph of every frame, and read the particles from the returned FluidState.
//
//   rill::Scene scene;
//   scene.fluid.spacing = 0.04;
//   scene.fill = {rill::Fill{.shape = rill::SphereShape{{0, 1, 0}, 0.3}}};
//   auto particles = rill::makeParticles(scene);
//   auto water = rill::Fluid::create(device, {.scene = &scene, .particles = &*particles});
//   if (!water) return fail(water.error().message);
//   const rill::FluidState state = water->addTo(graph, {.advance_s = 1.0 / 60});  // every frame
//
// All state is on the device, which also chooses time steps and list rebuilds; addTo() records the largest number of substeps needed.
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/fluid_results.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

struct FluidSnapshot;  // rill/snapshot.hpp

/// Parameters of Fluid::create(). Pointers are not kept.
struct FluidDesc {
  const Scene* scene = nullptr;            ///< required; settings, domain, solids, gravity; fluid.spacing > 0
  const ParticleSet* particles = nullptr;  ///< required; see makeParticles()
  /// Optional: the state to continue from, of the same scene, with at most `capacity` particles; BadInput otherwise.
  const FluidSnapshot* snapshot = nullptr;
  /// Before simulated time starts: separate overlapping particles without changing velocities (settling), then solve for the initial
  /// hydrostatic pressure. Settling takes 1 recorded substep without overlaps and at most 512 with them; the pressure takes about 3 per
  /// layer of particles, at most 1,024. Frames that record fewer do not advance, and drop their time (FluidProgress::timeDropped_s).
  bool settle = true;
  /// Particles that there is room for; at least those at the start, for which 0 stands.
  uint32_t capacity = 0;
  bool storageReads = false;  ///< never use texel buffers to read arrays (slower on most CPU drivers)
  /// Measure loads on solids, as a scene with a probe of a load does: FluidState::loads, Fluid::solidLoads(). Fluid at solids then does
  /// not sleep in regions (solver.sleep). Loads that are measured for bodies alone leave out what sleeps at solids at rest.
  bool loads = false;
  /// Fewer and larger passes, with the same results: less latency on GPUs, slower on CPU drivers. Without a value: on all but CPU devices.
  std::optional<bool> mergePasses = {};
};

/// Device memory of a Fluid, bytes.
struct FluidMemory {
  uint64_t particleBytes = 0;  ///< per-particle arrays without the neighbor list
  uint64_t listBytes = 0;      ///< the neighbor list; 0 with solver.neighbors "grid"
  uint64_t gridBytes = 0;      ///< start of each grid cell, upper bound
  uint64_t total() const { return particleBytes + listBytes + gridBytes; }
};
/// A buffer of a Fluid.
struct FluidBuffer {
  const char* name = "";
  uint64_t bytes = 0;
};
/// The memory that a Fluid of `particles` particles needs, without allocating it. `scene` must pass checkScene().
RILL_API FluidMemory fluidMemory(const Scene& scene, uint64_t particles);

/// The largest number of particles, or capacity, of a Fluid of this scene on the device: within the memory that is available at the moment
/// (Device::availableBytes), in buffers of DeviceInfo::maxBufferBytes. `scene` must pass checkScene().
RILL_API uint32_t maxParticles(const Device& device, const Scene& scene);

/// Target pose of a driven solid at the end of an advance.
struct SolidTarget {
  uint32_t solid = 0;          ///< index into Scene::solids; a solid with `driven` 0 does not move
  Double3 center = {0, 0, 0};  ///< m; of a mesh: its origin; not finite: the solid does not move or turn
  /// From the solid's frame to the scene's, about the center: x y z w, finite, of any length above 0. None: the solid does not turn.
  std::optional<Quaternion> rotation = {};
};

/// A damped spring between a point of a body and a point of the scene, as of a mouse or a rope. It is implicit in time: stiff springs are
/// stable at any step. A body that is held or stopped does not move, nor does one along locked degrees of freedom.
struct BodyPull {
  uint32_t solid = 0;          ///< index into Scene::solids, of a solid with a body
  Double3 point = {0, 0, 0};   ///< of the body, m, in the solid's frame
  Double3 target = {0, 0, 0};  ///< of the scene, m
  double frequency_Hz = 2;     ///< of the body's mass on the spring without damping, above 0 and at most 1e6
  double dampingRatio = 1;     ///< over critical damping of that mass, 0 to 1e6
  double maxForce = kNoBound;  ///< N, above 0
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();
};

/// What an emitter does from the begin of an advance on, until the next target for it: a tap in a host's hand.
struct EmitterTarget {
  uint32_t emitter = 0;  ///< index into Scene::emitters, behind them the inflow; its times `from` and `until` still apply
  double flow = 0;       ///< m^3/s, >= 0; 0: closed
  /// Of the mouth, of a mesh its centroid, m; before its motion if keyframes move it. None: it stays.
  std::optional<Double3> center = {};
  std::optional<Double3> normal = {};  ///< direction of the flow, likewise, of any length above 0; none: it stays. Turns the shorter way
};

/// Parameters of Fluid::addTo().
struct FluidStep {
  double advance_s = 0;  ///< simulated time to advance by, s, >= 0; ignored with `resume`
  bool resume = false;   ///< continue an advance that the last graph did not complete, as offline callers do
  /// Largest number to record, rounded up to multiples of Fluid::substepsPerBlock(). With solver.sleep it may be 0, where
  /// FluidProgress::asleep is set: that is enough while the fluid sleeps. If it wakes, time is left, for a graph with `resume`.
  uint32_t substeps = 64;
  bool stats = false;  ///< measure FluidStats at the end
  /// Targets of driven solids. Each moves in a straight line and turns the shorter way, at constant velocities. Where a point of it might
  /// be faster than Solid::driven, it gets only part of both ways. Solids without a target rest. Not kept after addTo(). Ignored with
  /// `resume`, and without particles.
  std::span<const SolidTarget> targets = {};
  /// Springs that pull bodies during the advance, at most 64. Several on one body act one after another. Not kept after addTo(). Ignored
  /// with `resume`, and until simulated time begins.
  std::span<const BodyPull> pulls = {};
  /// Changes of emitters. Give those of a frame that is not executed again, with center and normal. Not kept after addTo(). Ignored with
  /// `resume`.
  std::span<const EmitterTarget> emitters = {};
  /// The advance begins only if the last one has no time left when the device comes to it; else the last one continues, as with `resume`.
  /// So the next advance can be recorded before the last is known to be complete. Not where solids are driven, nor with `pulls` or
  /// `emitters`: BadInput.
  bool queued = false;
};

/// The particles of a frame, as buffers of its graph. Read them with any Use. Buffers of particles have an unused entry after `capacity`.
struct FluidState {
  BufferRef position = {};       ///< vec4 per particle: xyz in m relative to `origin`; w: index of its fluid among resolvedFluids()
  BufferRef velocity = {};       ///< vec4 per particle: xyz in m/s; w: density over rest density with FluidStep::stats, else 1
  BufferRef id = {};             ///< uint per particle, which it keeps: unique, below 0x7F000000; at the start its index in the ParticleSet
  BufferRef concentration = {};  ///< vec4 per particle: share of each of diffusingFluids() in it; null if none diffuses
  BufferRef control = {};        ///< FluidControl (shaders/shared/fluid_records.h)
  /// Its first uint is the number of particles: they are the first entries of the arrays. Null: renderers take `capacity`.
  BufferRef countBuffer = {};
  BufferRef solids = {};  ///< SolidRecord (solid_records.h) per solid, at the present time; null if no solid is driven, a body or a mesh
  /// SolidRecord per solid, at the present time; null without solids. `solids` is the same buffer, or null where views need none.
  BufferRef boundaries = {};
  BufferRef meshWords = {};    ///< fields of the meshes (mesh_field.h); null without meshes
  BufferRef loads = {};        ///< SolidLoadRecord (solid_loads.h) per solid; null unless loads are measured, and with capacity 0
  uint32_t capacity = 0;       ///< entries of the arrays: particles at most; those beyond the particles are inactive, far from all others
  float spacing = 0;           ///< m
  Double3 origin = {0, 0, 0};  ///< m
};

/// Progress of an advance.
struct FluidProgress {
  bool known = false;        ///< whether a frame has finished
  double time_s = 0;         ///< simulated time
  double timeLeft_s = 0;     ///< remaining time of the advance; 0 once it is complete
  double timeDropped_s = 0;  ///< time of the advance that exceeded solver.max_substeps or the recorded substeps
  uint32_t substeps = 0;     ///< in the advance
  uint32_t iterations = 0;   ///< Jacobi iterations in the advance, summed over substeps
  uint32_t listBuilds = 0;   ///< neighbor list builds in the advance
  bool asleep = false;       ///< the fluid is at rest and takes no substeps (solver.sleep)
};

/// How often a pass that the device can skip was recorded and executed; the difference were empty dispatches.
struct FluidPassRuns {
  std::string_view name;  ///< as in PassReport; a name that ends with '/' stands for all passes with that prefix
  uint32_t executed = 0, recorded = 0;
};

class FluidImpl;

/// A fluid on a borrowed device. It may be moved, or destroyed once the graphs that it was added to have been recorded: what recorded
/// frames use is kept until Device::beginFrame() reports them as completed. A moved-from Fluid may only be destroyed or assigned to.
class RILL_API Fluid {
 public:
  /// BadInput for an invalid description; TooLarge, naming the bytes needed and available, before anything is allocated; OutOfMemory.
  static Expected<Fluid> create(Device& device, const FluidDesc& desc);
  ~Fluid();
  Fluid(Fluid&&) noexcept;
  Fluid& operator=(Fluid&&) noexcept;

  /// Adds the passes of one step; the fluid advances when the graph is recorded and executed. A negative or non-finite time, an
  /// invalid target and an invalid pull are reported by the graph's compile(); no pass is added then.
  FluidState addTo(Graph& graph, const FluidStep& step);
  /// The current particles, also between the pieces of an advance. Adds no pass. Requires an earlier graph with addTo().
  FluidState present(Graph& graph) const;

  /// Statistics of the last finished frame that had FluidStep::stats.
  std::optional<FluidStats> stats() const;
  /// Progress after the last finished frame. Does not need FluidStep::stats.
  const FluidProgress& progress() const;
  /// Executions of passes between the two last frames known to have finished. Passes that are not listed always execute.
  std::vector<FluidPassRuns> passRuns() const;

  /// Loads on the solids after the last finished frame; before the first, zeros or those of the snapshot. Empty unless loads are
  /// measured. Valid until the fluid is moved or destroyed; the next call that reads results may change the values.
  std::span<const SolidLoad> solidLoads() const;

  /// At the scene's probes of pressure, in their order, after the last finished frame; before the first, zeros or those of the snapshot.
  /// Valid until the fluid is moved or destroyed; the next call that reads results may change the values.
  std::span<const PressureReading> pressures() const;

  /// Of the scene's emitters (and of its inflow, the last one), and of its drains, in their order, after the last finished frame. Valid
  /// until the fluid is moved or destroyed; the next call that reads results may change the values.
  std::span<const FlowReading> emitted() const;
  std::span<const FlowReading> drained() const;

  /// Motion of the bodies, in the order of the solids, after the last finished frame. Valid until the fluid is moved or destroyed; the
  /// next call that reads results may change the values.
  std::span<const BodyMotion> bodies() const;

  /// Center of a driven solid at the end of the last declared advance, m: the target, or a point on the path to it if the target was too
  /// far. NaN for a solid that is not driven.
  Double3 drivenCenter(uint32_t solid) const;
  /// Its rotation then, a unit quaternion x y z w, likewise.
  Quaternion drivenRotation(uint32_t solid) const;

  uint32_t count() const;     ///< particles of the last finished frame, including inactive ones
  uint32_t capacity() const;  ///< particles that there is room for
  /// Number of substeps between neighbor list rebuilds; FluidStep::substeps is rounded up to multiples of it.
  uint32_t substepsPerBlock() const;
  /// Number of recorded substeps that completes any advance, including the first with FluidDesc::settle. Includes substeps that the
  /// device skips.
  uint32_t substepsToComplete() const;
  FluidMemory memory() const;
  std::span<const FluidBuffer> buffers() const;  ///< persistent buffers; Graph::transients has the temporary ones
  /// Settings that the solver cannot honor, with numbers ("viscosity 50 Pa s needs ..."). Fixed at creation.
  std::span<const std::string> warnings() const;

 private:
  friend struct ImplAccess;  // engine/core/impl_of.hpp
  explicit Fluid(std::unique_ptr<FluidImpl>);
  std::unique_ptr<FluidImpl> impl_;
};

}  // namespace rill
