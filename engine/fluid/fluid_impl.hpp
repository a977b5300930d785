#pragma once
// What a Fluid holds: its settings, its buffers, its pipelines, and what it has declared and not yet heard of.
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <type_traits>

#include "core/impl_of.hpp"
#include "fluid/arrays.hpp"
#include "fluid/dispatch_commands.hpp"
#include "fluid/pass_table.hpp"
#include "fluid/room.hpp"
#include "fluid/settings.hpp"
#include "fluid/staging.hpp"
#include "gpu/resources.hpp"
#include "graph/shader_pass.hpp"
#include "rill/fluid.hpp"
#include "rill/snapshot.hpp"
#include "sort/key_sort.hpp"

namespace rill {

inline bool finite(const Float3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
/// As a float: infinite where its square does not fit.
inline float speedOf(const Float3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Range of entries that one list buffer serves; the whole fluid where there is no list.
struct Chunk {
  uint32_t first = 0, last = 0;
};

/// Where an array lies among a fluid's buffers; lists have one for each chunk.
constexpr size_t slotOf(FluidArray array, uint32_t chunk = 0) {
  return array == FluidArray::List && chunk > 0 ? kArrays + chunk - 1 : static_cast<size_t>(array);
}
constexpr size_t kSlots = kArrays + kMaxListChunks - 1;

/// A row of the pass table as this fluid dispatches it.
struct PreparedPass {
  struct Variant {
    const ComputePipeline* pipeline = nullptr;
    uint32_t over = kOverShape;
    std::vector<FluidArray> arrays = {};  ///< in the order of the bindings
  };
  std::vector<Variant> variants;
  FluidArray arguments = FluidArray::Commands;          ///< what the commands are in
  std::vector<std::array<uint32_t, kStarts>> commands;  ///< of each variant, by start
};

/// How often the passes were recorded, by what starts them.
using PassCounts = std::array<std::array<uint32_t, kStarts>, kFluidPasses>;

class FluidImpl {
 public:
  static Expected<std::unique_ptr<FluidImpl>> create(Device& device, const FluidDesc& desc);
  FluidState addTo(Graph& graph, const FluidStep& step);
  FluidState present(Graph& graph) const;
  void poll() const;
  std::vector<FluidPassRuns> passRuns() const;
  /// The figures of a frame that were measured, by what came back with them. `fluids`: FluidFigureRecords, of several fluids.
  FluidStats statsOf(const MeasureResult& result, std::span<const std::byte> fluids, const FluidControl& control,
                     const FluidSums& sums) const;
  std::vector<FluidFigures> figuresOfFluids(std::span<const std::byte> measured, const FluidStats& all) const;
  FluidLedger ledgerOf(uint32_t particles, uint32_t inactive) const;  ///< of a scene in which none come or go: those there are
  void takeBodies(std::span<const std::byte> records) const;          ///< BodyRecords
  void takePressures(std::span<const std::byte> records) const;       ///< PressureProbeRecords
  void takeLoads(std::span<const std::byte> records) const;           ///< SolidLoadRecords
  void takeFlows(std::span<const std::byte> flow, std::span<const std::byte> emitters, std::span<const std::byte> drains) const;
  std::span<const Chunk> chunks() const { return chunks_; }
  const Buffer& buffer(FluidArray array, uint32_t chunk = 0) const { return slot(slotOf(array, chunk)); }
  const Buffer& slot(size_t slot) const { return buffers_[slot]; }

  FluidSetup setup;
  FluidMemory memory;
  std::vector<FluidBuffer> made;  ///< the buffers, for reports
  uint32_t capacity = 0;          ///< particles at most
  mutable uint32_t count = 0;     ///< particles at the end of the last frame that is known to have finished
  Double3 origin = {0, 0, 0};
  mutable std::optional<FluidStats> stats;
  mutable FluidProgress progress;
  mutable std::vector<SolidLoad> solidLoads;
  mutable std::vector<PressureReading> pressures;
  mutable FlowRecord ledger{};                        ///< of the last finished frame
  mutable std::vector<FlowReading> emitted, drained;  ///< likewise
  mutable std::vector<BodyRecord> bodyRecords;        ///< of the last finished frame
  mutable std::vector<BodyMotion> bodyMotions;        ///< likewise

 private:
  /// What was recorded, since the start, of what the device switches on and off.
  struct Recorded {
    PassCounts passes{};
    uint32_t substeps = 0, sorts = 0;  ///< sorts: with those of figures, which always run
  };

  /// What of it the device executed.
  struct Executed {
    uint32_t substeps = 0, iterations = 0, builds = 0, noiseDampings = 0, diffusions = 0, fallsAsleep = 0;
  };

  struct Pending {
    std::weak_ptr<GraphImpl> graph = {};
    Ticket control = {}, sums = {}, measure = {}, fluidFigures = {}, loads = {}, bodies = {}, pressures = {}, flow = {}, emitters = {},
           drains = {};
    bool measured = false;
    bool uploads = false;  ///< the start state has been copied once this frame has finished
    Recorded recorded = {};
  };

  /// An advance that moves driven solids, and where they were before it.
  struct Drive {
    uint64_t number = 0;
    uint64_t frame = 0;  ///< into whose commands it was recorded; 0: not yet
    std::vector<PoseRecord> from;
  };

  // fluid.cpp
  Expected<void> makeBuffers(Device& device, bool storageReads);
  // pipelines.cpp
  Expected<void> preparePasses(Device& device);
  Expected<void> preparePass(Device& device, const FluidPassRow& row);
  /// NoDevice if the particles of a workgroup cannot work together in clusters.
  static Expected<void> checkClusters(const Device& device);
  std::vector<NamedConstant> constants(Device& device) const;
  // start_state.cpp
  void stageScene();
  void stageStart(const ParticleSet& particles, bool settle);
  void stageFlows();
  void stageParticles(std::vector<Float3> positions, std::vector<Float3> velocities, std::vector<uint8_t> fluids);
  void stageConcentrations(std::vector<Float4> given, const std::vector<uint8_t>& fluids);  ///< `given`: empty: nothing has mixed
  // resume_state.cpp
  void stageSnapshot(const FluidSnapshot& s);
  void resumeDecisions(const FluidSnapshot& s, uint32_t nearMouths);
  void resumeSolids(const FluidSnapshot& s);
  void resumePressures(const FluidSnapshot& s);
  void resumeFlows(const FluidSnapshot& s);
  void resumeArrays(const FluidSnapshot& s);
  void resumeNeighbors(const FluidSnapshot& s, bool allNearMouths);
  // host_input.cpp
  void declareUpload(Graph& graph);
  void declareDrive(Graph& graph, const FluidStep& step);
  void forgetAbandoned();  ///< what has been declared in frames that were given up
  /// The message on an index of a solid that does not exist.
  std::string solidOutOfRange(uint32_t solid) const;
  // pulls.cpp
  /// What is wrong with FluidStep::pulls; empty if nothing.
  std::string faultOfPulls(const FluidStep& step) const;
  void declarePulls(Graph& graph, std::span<const BodyPull> pulls);
  // emitter_targets.cpp
  /// What is wrong with FluidStep::emitters; empty if nothing.
  std::string faultOfEmitters(const FluidStep& step) const;
  void declareEmitters(Graph& graph, const FluidStep& step);
  // passes.cpp
  FluidState described() const;  ///< without buffers
  bool validate(Graph& graph, const FluidStep& step) const;
  void importAll(Graph& graph);
  void declareBegin(Graph& graph, double advance, bool queued = false, size_t pulls = 0, bool emitters = false);
  void declareRebuild(Graph& graph);
  /// Sorts by the cell of `places`; `keys` is the pass that finds it. The results are SortStart, SortArrived, SortOrder.
  void sortKeys(Graph& graph, FluidPass keys, Start start, FluidArray places, const SortTargets& targets, const Gate* gate);
  void declareSkipped(Graph& graph) const;
  // substep_passes.cpp
  void declareSubstep(Graph& graph, uint32_t parity, bool first);  ///< first of its block
  void declareBodies(Graph& graph);
  void declareForces(Graph& graph, bool first);
  void declareViscosity(Graph& graph);
  void declareNoSlip(Graph& graph);
  void declareTension(Graph& graph);
  void declareNoiseDamping(Graph& graph);
  void declareDiffusion(Graph& graph);
  // measure_passes.cpp
  void declareMeasure(Graph& graph, Pending& pending);
  // declare.cpp
  template <class Push = NoPush>
  void declare(Graph& graph, FluidPass pass, Start start = Start::Always, Push push = {});
  /// Bytes from the first command to that of a variant; 0 for Start::Always. A start that the row lacks is an error of compile().
  uint64_t commandOffset(Graph& graph, const FluidPassRow& row, size_t variant, Start start) const;
  Kernel bind(Graph& graph, Pass& pass, const FluidPassRow& row, const PreparedPass::Variant& variant, uint32_t chunk);
  uint64_t fixedGroups(Extent extent) const;
  /// This frame's version of an array, or of the one that an alias stands for.
  BufferRef& ref(FluidArray array, uint32_t chunk = 0) { return refs_[slotOf(aliases_[static_cast<size_t>(array)], chunk)]; }
  /// From now on shaders see `target` under the name of `alias`.
  void alias(FluidArray alias, FluidArray target) { aliases_[static_cast<size_t>(alias)] = target; }
  void resetAliases();
  void beginSection();  ///< transients of the section before are given up
  uint32_t chunkCount() const { return static_cast<uint32_t>(chunks_.size()); }

  std::array<Buffer, kSlots> buffers_;
  std::array<BufferRef, kSlots> refs_{};
  std::array<FluidArray, kArrays> aliases_{};
  std::array<PreparedPass, kFluidPasses> passes_;
  DispatchCommands commands_;
  uint32_t sortCommand_ = 0;  // the first of the sort's in a rebuild; those for figures follow
  uint32_t parity_ = 0;       // of the substep being declared
  std::optional<KeySort> sort_;
  std::vector<Chunk> chunks_;
  mutable std::optional<Staging> staging_;  // the start state, until it has been copied
  bool texel_ = false;
  DeviceImpl* device_ = nullptr;
  bool uploaded_ = false;
  std::optional<uint64_t> uploadFrame_;  // into whose commands the upload was recorded
  bool resumed_ = false;                 // from a snapshot
  bool drivenMove_ = false;              // whether one moves in that advance by more than rounding
  float drivenSpeed_ = 0;                // m/s, of the fastest point of driven solids in the advance declared last
  double emptyTime_ = 0;                 // simulated time of a fluid without particles, s
  mutable std::deque<Pending> pending_;
  Recorded recording_;                              // by all frames that were declared
  mutable Recorded recordedLast_, recordedBefore_;  // at the end of the last finished frame, and of the one before
  mutable Executed executed_, executedBefore_;      // likewise
  std::deque<Drive> drives_;                        // those that the device has not finished
  uint64_t driveCount_ = 0;
};

// A pass records a dispatch for each chunk and variant, and nothing where the condition of its row does not hold.
template <class Push>
void FluidImpl::declare(Graph& graph, FluidPass pass, Start start, Push push) {
  if (!exists(pass, setup)) return;
  const FluidPassRow& row = rowOf(pass);
  const PreparedPass& prepared = passes_[static_cast<size_t>(pass)];
  ++recording_.passes[static_cast<size_t>(pass)][static_cast<size_t>(start)];
  graph.pass(row.name, [&](Pass& declared) {
    struct Dispatched {
      Kernel kernel;
      uint64_t offset;
    };
    std::array<Dispatched, 2 * kMaxListChunks> all;
    size_t dispatches = 0;
    const bool chunked = row.extent == Extent::Chunks || row.extent == Extent::Gather || row.extent == Extent::NearGather;
    if (start != Start::Always) declared.read(ref(prepared.arguments), Use::Indirect);
    for (uint32_t c = 0; c < (chunked ? chunkCount() : 1); ++c)
      for (size_t v = 0; v < prepared.variants.size(); ++v) {
        all[dispatches++] = {bind(graph, declared, row, prepared.variants[v], c), commandOffset(graph, row, v, start)};
      }
    return [=, this, arguments = ref(prepared.arguments), groups = fixedGroups(row.extent), each = prepared.variants.size(),
            direct = start == Start::Always](Commands& commands) mutable {
      for (size_t k = 0; k < dispatches; ++k) {
        if constexpr (requires { push.first; }) {
          push.first = chunks_[k / each].first;
          push.last = chunks_[k / each].last;
        }
        const DispatchSize size = direct ? DispatchSize(groups) : DispatchSize(arguments, all[k].offset);
        dispatch(commands, all[k].kernel, size, push);
      }
    };
  });
}

}  // namespace rill
