#pragma once
// What a Fluid holds: its settings, its buffers, its pipelines.
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>

#include "core/impl_of.hpp"
#include "fluid/settings.hpp"
#include "fluid/staging.hpp"
#include "gpu/resources.hpp"
#include "rill/fluid.hpp"
#include "sort/key_sort.hpp"

namespace rill {

inline bool finite(const Float3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
/// As a float: infinite where its square does not fit.
inline float speedOf(const Float3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

constexpr uint32_t kMaxListChunks = 16;

/// Device buffers that live as long as the fluid. Arrays of `count` + 1 entries end with the dummy neighbor that pads lists.
struct FluidBuffers {
  Buffer params, control, sums, shapes, commands, gravity, tables, solids, keyframes;
  Buffer position, velocity, prediction, warmAcceleration, work, warm, id;  // vec4 each but the last two
  Buffer multiplier;                                                        // where there are several iterations
  Buffer neighborCount, cell, start, nearSample, nearList;
  std::vector<Buffer> lists;
};

/// Of the particles near one wall, and of those near several walls or a solid.
struct WallPipelines {
  const ComputePipeline *plane = nullptr, *corner = nullptr;
};

/// A pass over the neighbors: from the list, and the variant that can walk the grid as well. No list variant where there is no list.
struct GatherPipelines {
  const ComputePipeline *list = nullptr, *walk = nullptr;
};

struct FluidPipelines {
  const ComputePipeline *begin = nullptr, *control = nullptr, *finishRebuild = nullptr, *predict = nullptr, *keys = nullptr,
                        *reorder = nullptr, *build = nullptr;
  const ComputePipeline *collide = nullptr, *predictAfterTerms = nullptr, *pose = nullptr;
  WallPipelines walls;
  GatherPipelines density, correct, correctWithArtificialPressure, iterate, viscosity, curl, confine;
  const ComputePipeline* copyVelocity = nullptr;
  const ComputePipeline *measureKeys = nullptr, *measureOrder = nullptr, *measure = nullptr, *measureSums = nullptr, *reduce = nullptr;
};

/// One frame's versions of the buffers.
struct FluidRefs {
  BufferRef params, control, sums, shapes, commands, gravity, tables, solids, keyframes;
  BufferRef position, velocity, prediction, warmAcceleration, work, warm, id, multiplier;
  BufferRef neighborCount, cell, start, nearSample, nearList;
  std::array<BufferRef, kMaxListChunks> lists;
};

/// Range of particles that one list buffer serves; the whole fluid where there is no list.
struct Chunk {
  uint32_t first = 0, last = 0;
  uint64_t groups() const { return divideUp(last - first, kFluidGroup); }
};

class FluidImpl {
 public:
  static Expected<std::unique_ptr<FluidImpl>> create(Device& device, const FluidDesc& desc);
  FluidState addTo(Graph& graph, const FluidStep& step);
  FluidState present(Graph& graph) const;
  void poll() const;
  std::vector<FluidPassRuns> passRuns() const;
  const FluidRefs& refs() const { return r_; }  ///< of the step declared last
  std::span<const Chunk> chunks() const { return chunks_; }
  const FluidBuffers& buffers() const { return buffers_; }

  FluidSetup setup;
  FluidMemory memory;
  std::vector<FluidBuffer> made;  ///< the buffers, for reports
  uint32_t count = 0;
  double origin[3] = {0, 0, 0};
  mutable std::optional<FluidStats> stats;
  mutable FluidProgress progress;

 private:
  /// What was recorded, since the start, of what the device switches on and off.
  struct Recorded {
    uint32_t substeps = 0, blocks = 0, rebuilds = 0, sorts = 0;  ///< sorts: with those of figures, which always run
  };

  /// What of it the device ran.
  struct Ran {
    uint32_t substeps = 0, iterations = 0, builds = 0, blocks = 0, calms = 0;
  };

  struct Pending {
    std::weak_ptr<GraphImpl> graph;
    Ticket control, sums, measure;
    bool measured;
    bool uploads;  ///< the start state has been copied once this frame has finished
    Recorded recorded;
  };

  /// An advance that moves driven solids, and where they were before it.
  struct Drive {
    uint64_t number = 0;
    uint64_t frame = 0;  ///< into whose commands it was recorded; 0: not yet
    std::vector<std::array<float, 3>> from;
  };

  Expected<void> makeBuffers(Device& device, bool storageReads);
  Expected<void> makePipelines(Device& device);
  void stageScene();
  void stageStart(const ParticleSet& particles, bool settle);
  void stageSnapshot(const FluidSnapshot& snapshot);
  void stageParticles(std::vector<Float3> positions, std::vector<Float3> velocities);
  FluidState described() const;  ///< without buffers
  bool possible(Graph& graph, const FluidStep& step) const;
  BufferRef& versionOf(const Buffer& buffer);
  void importAll(Graph& graph);
  void declareUpload(Graph& graph);
  void declareDrive(Graph& graph, const FluidStep& step);
  void forgetAbandoned();  ///< what has been declared in frames that were given up
  void declareBegin(Graph& graph, double advance);
  Kernel keysKernel(Pass& pass, const ComputePipeline* pipeline, BufferRef places, BufferRef& keys, KeyCounters& counters);
  void declareRebuild(Graph& graph);
  void declareSubstep(Graph& graph, uint32_t parity, bool first);  ///< first of its block
  void declareCollide(Graph& graph, std::string_view name, const ComputePipeline* pipeline, BufferRef free, uint32_t parity);
  void declareTerms(Graph& graph, uint32_t parity, bool calms);
  void declareSweeps(Graph& graph, std::string_view name, uint32_t sweeps, uint32_t command, float share);
  void declareMeasure(Graph& graph, Pending& pending);
  void declareSkipped(Graph& graph);
  uint32_t chunkCount() const { return static_cast<uint32_t>(chunks_.size()); }
  uint32_t commandCount() const;

  FluidBuffers buffers_;
  FluidPipelines pipes_;
  FluidRefs r_;
  std::optional<KeySort> sort_;
  std::vector<Chunk> chunks_;
  mutable std::optional<Staging> staging_;  // the start state, until it has been copied
  bool texel_ = false;
  DeviceImpl* device_ = nullptr;
  bool uploaded_ = false;
  std::optional<uint64_t> uploadFrame_;  // into whose commands the upload was recorded
  bool resumed_ = false;                 // from a snapshot
  float drivenSpeed_ = 0;                // m/s, the fastest driven solid of the advance declared last
  double emptyTime_ = 0;                 // simulated time of a fluid without particles, s
  mutable std::deque<Pending> pending_;
  Recorded recording_;                              // by all frames that were declared
  mutable Recorded recordedLast_, recordedBefore_;  // at the end of the last finished frame, and of the one before
  mutable Ran ran_, ranBefore_;                     // likewise
  std::deque<Drive> drives_;                        // those that the device has not finished
  uint64_t driveCount_ = 0;
};

}  // namespace rill
