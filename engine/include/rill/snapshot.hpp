#pragma once
// The state of a fluid on the host, for checkpoints: a fluid that is created from it goes on with the same bits.
//
//   rill::SnapshotReader reader(water);  // after a frame with advance_s = 0 has completed
//   while (!reader.done()) {
//     graph.reset();
//     reader.declare(graph);
//     run(graph);  // compile, prepare, record, submit, wait
//     if (auto taken = reader.take(graph); !taken) return fail(taken.error().message);
//   }
//   const rill::FluidSnapshot state = std::move(reader.snapshot());
//   auto again = rill::Fluid::create(device, {.scene = &scene, .particles = &particles, .snapshot = &state});
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// See FluidSnapshot::neighbors.
inline constexpr uint32_t kImageOfNeighbors = 0x80000000;

/// A particle near solids.
struct NearSolids {
  uint32_t particle = 0;  ///< its index
  /// Indices of the solids, increasing; 0xffff after the last. If the first is 0xfffe, any solid may be near.
  std::array<uint16_t, 30> solids = {};
  friend bool operator==(const NearSolids&, const NearSolids&) = default;
};

/// The persistent state of a fluid between two advances, on the host: everything that later steps depend on, bit by bit
/// (docs/architecture.md, "What is persisted"). Arrays have one entry per particle, in the order of the device.
struct FluidSnapshot {
  std::vector<uint32_t> control = {};    ///< FluidControl (shaders/shared/fluid_records.h), word by word
  std::vector<uint32_t> sums = {};       ///< FluidSums, word by word
  std::vector<float> solids = {};        ///< the pose of each solid (shaders/shared/solid_records.h); empty if no solid moves
  std::vector<uint32_t> bodies = {};     ///< BodyRecord (body_records.h) of each body, word by word
  std::vector<uint32_t> slips = {};      ///< SlipRecord of each contact point of the bodies, word by word
  std::vector<float> loads = {};         ///< SolidLoadRecord (solid_loads.h) of each solid, word by word; empty unless loads are measured
  std::vector<uint32_t> pressures = {};  ///< PressureProbeRecord (pressure_probe.h) of each probe of pressure, word by word
  /// FlowRecord (flow_records.h), then EmitterRecord of each emitter and DrainRecord of each drain, word by word; empty if no particles
  /// come or go.
  std::vector<uint32_t> flows = {};
  /// RegionRecord (region_records.h) of each region of the grid that may fall asleep on its own, word by word; empty if none may,
  /// or if all are awake.
  std::vector<uint32_t> regions = {};
  std::vector<Float3> position = {}, velocity = {};  ///< m, m/s
  std::vector<uint8_t> fluid = {};                   ///< index among the scene's fluids; empty if it has one
  // Warm start; empty without one.
  std::vector<Float4> warmAcceleration = {};  ///< m/s^2; w: last multiplier (m^2) while the initial pressure is solved for
  std::vector<float> warmStart = {};          ///< multipliers, m^2
  std::vector<Float4> concentration = {};     ///< as FluidState::concentration; empty: nothing diffuses
  std::vector<uint32_t> id = {};
  std::vector<uint32_t> rest = {};          ///< zones (region_records.h) that the particles were sorted by; empty as `regions` is
  std::vector<NearSolids> nearSolids = {};  ///< by increasing particle
  // Neighbor list; empty if the next step rebuilds it.
  uint32_t listCapacity = 0;                 ///< capacity of the list, entries per particle; a neighbor takes one or two
  std::vector<uint32_t> neighborCount = {};  ///< neighbors of each particle; empty without a valid list
  /// Concatenated by particle; without those of particles that exceed the capacity. Near walls an entry kImageOfNeighbors + k comes before
  /// those whose image k (shaders/fluid/images.glsl) is near; 0 is the neighbors themselves. With surface tension those that only samples
  /// of the surface reach come first, after kImageOfNeighbors + 30 or 31 (shaders/shared/neighbor_list.h).
  std::vector<uint32_t> neighbors = {};
  std::vector<uint32_t> cell = {};  ///< cell of each particle when they were sorted, plus their number in a region asleep
  friend bool operator==(const FluidSnapshot&, const FluidSnapshot&) = default;
};

/// Reads the state of a fluid back for a checkpoint, one buffer of the fluid a graph:
///   for (SnapshotReader reader(fluid); !reader.done(); reader.take(graph)) { graph.reset(); reader.declare(graph); ... run it ... }
/// Requires that a frame with `advance_s` = 0 has completed. Do not use the fluid otherwise until done().
class RILL_API SnapshotReader {
 public:
  explicit SnapshotReader(const Fluid& fluid);
  bool done() const;           ///< whether everything has been read
  void declare(Graph& graph);  ///< adds the next read-backs to a graph
  /// Collects the data of a completed frame. Failed if it has not completed.
  Expected<void> take(const Graph& graph);
  FluidSnapshot& snapshot() { return snapshot_; }  ///< valid once done()

 private:
  void plan();
  void takeRecords(std::span<const std::span<const std::byte>> data);
  const FluidImpl& fluid_;
  FluidSnapshot snapshot_;
  std::vector<uint32_t> parts_ = {};  ///< indices of the buffers to read, in order
  size_t next_ = 0;
  std::vector<Ticket> tickets_ = {};
  std::vector<uint32_t> heads_ = {};  ///< of the neighbor lists
};

}  // namespace rill
