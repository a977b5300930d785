#include "bench/traffic/trace.hpp"

#include <cstring>
#include <map>
#include <optional>

#include "gpu/device_impl.hpp"
#include "graph/graph_impl.hpp"

namespace rill::bench {
namespace {

constexpr uint32_t kMaxIndirect = 65536;  // dispatches of a graph whose group counts are read back

/// Intercepts the commands of a graph while it is recorded, by replacing functions in the device's table.
class Recorder {
 public:
  Recorder(DeviceImpl& device, const Buffer& counts) : device_(device), driver_(device.vk), counts_(counts) {
    current_ = this;
    device.vk.CmdBindPipeline = [](VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) {
      current_->pipeline_ = pipeline;
      current_->driver_.CmdBindPipeline(commands, point, pipeline);
    };
    device.vk.CmdBindDescriptorSets = [](VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout, uint32_t first,
                                         uint32_t count, const VkDescriptorSet* sets, uint32_t offsetCount, const uint32_t* offsets) {
      current_->set_ = sets[0];
      current_->driver_.CmdBindDescriptorSets(commands, point, layout, first, count, sets, offsetCount, offsets);
    };
    device.vk.CmdDispatch = [](VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
      current_->add(uint64_t{x} * y * z, {});
      current_->driver_.CmdDispatch(commands, x, y, z);
    };
    device.vk.CmdDispatchIndirect = [](VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
      current_->add(0, current_->keepCounts(commands, buffer, offset));
      current_->driver_.CmdDispatchIndirect(commands, buffer, offset);
    };
    device.vk.CmdFillBuffer = [](VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size, uint32_t value) {
      current_->addTransfer(size);
      current_->driver_.CmdFillBuffer(commands, buffer, offset, size, value);
    };
    device.vk.CmdCopyBuffer = [](VkCommandBuffer commands, VkBuffer from, VkBuffer to, uint32_t count, const VkBufferCopy* regions) {
      for (uint32_t k = 0; k < count; ++k) current_->addTransfer(2 * regions[k].size);
      current_->driver_.CmdCopyBuffer(commands, from, to, count, regions);
    };
  }
  ~Recorder() {
    release();
    current_ = nullptr;
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Call once the graph is declared: from now on the pass that is being recorded is known.
  void follow(GraphImpl& graph) {
    graph_ = &graph;
    calls_.reserve(graph.passes.size());
    passes_.resize(graph.passes.size());
    for (uint32_t k = 0; k < graph.passes.size(); ++k) {
      PassData& pass = graph.passes[k];
      calls_.push_back({k, pass.record, pass.invoke});
      if (!pass.record) continue;
      pass.record = &calls_.back();
      pass.invoke = [](void* self, Commands& commands) {
        const Call& call = *static_cast<const Call*>(self);
        current_->pass_ = call.pass;
        call.invoke(call.record, commands);
        current_->pass_.reset();
      };
    }
  }

  /// The graph and the device's table are again what they were.
  void release() {
    device_.vk = driver_;
    for (const Call& call : calls_) {
      graph_->passes[call.pass].record = call.record;
      graph_->passes[call.pass].invoke = call.invoke;
    }
    calls_.clear();
  }

  /// After the device has finished, before the graph is reset.
  Expected<std::vector<TracedPass>> take() {
    if (keptCounts_ == kMaxIndirect) return Error{ErrorKind::Failed, "a graph has too many indirect dispatches to trace them"};
    std::vector<TracedPass> traced;
    for (size_t k = 0; k < graph_->passes.size(); ++k) {
      const PassData& pass = graph_->passes[k];
      if (!pass.alive || pass.readback) continue;
      TracedPass& made = traced.emplace_back(std::move(passes_[k].traced));
      made.name = graph_->names[pass.name];
      made.barrier = !pass.barrier.empty();
      for (const Seen& seen : passes_[k].dispatches) {
        auto dispatch = describe(pass, seen);
        if (!dispatch) return dispatch.error();
        made.dispatches.push_back(std::move(*dispatch));
      }
    }
    return traced;
  }

 private:
  struct Call {
    uint32_t pass;
    void* record;
    void (*invoke)(void*, Commands&);
  };
  struct Seen {
    VkPipeline pipeline;
    VkDescriptorSet set;
    uint64_t groups;
    std::optional<uint32_t> counts;  ///< where the counts of an indirect one are kept
  };
  struct Recorded {
    TracedPass traced;
    std::vector<Seen> dispatches;
  };

  void add(uint64_t groups, std::optional<uint32_t> counts) {
    if (pass_) passes_[*pass_].dispatches.push_back({pipeline_, set_, groups, counts});
  }
  void addTransfer(uint64_t bytes) {
    if (!pass_) return;
    ++passes_[*pass_].traced.transfers;
    passes_[*pass_].traced.transferBytes += bytes;
  }

  /// Copies what an indirect dispatch is about to read.
  uint32_t keepCounts(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
    if (keptCounts_ == kMaxIndirect) return 0;
    const auto wait = [&](VkPipelineStageFlags2 from, VkAccessFlags2 written, VkPipelineStageFlags2 to, VkAccessFlags2 used) {
      const VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, from, written, to, used};
      VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
      dependency.memoryBarrierCount = 1;
      dependency.pMemoryBarriers = &barrier;
      driver_.CmdPipelineBarrier2(commands, &dependency);
    };
    wait(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
    const VkBufferCopy region{offset, keptCounts_ * sizeof(VkDispatchIndirectCommand), sizeof(VkDispatchIndirectCommand)};
    driver_.CmdCopyBuffer(commands, buffer, counts_.handle(), 1, &region);
    wait(VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
         VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_HOST_READ_BIT);
    return keptCounts_++;
  }

  Expected<TracedDispatch> describe(const PassData& pass, const Seen& seen) {
    const std::string where = "pass '" + std::string(graph_->names[pass.name]) + "'";
    for (uint32_t k = pass.kernels.first; k < pass.kernels.first + pass.kernels.count; ++k) {
      const KernelData& kernel = graph_->kernels[k];
      const Pipeline& pipeline = *kernel.pipeline;
      if (pipeline.handle != seen.pipeline || (kernel.bindings.count > 0 && kernel.set != seen.set)) continue;
      const auto accesses = accessesOf(pipeline);
      if (!accesses) return Error{accesses.error().kind, where + ", shader '" + pipeline.shader + "': " + accesses.error().message};
      TracedDispatch made{seen.groups, (*accesses)->groupSize, {}};
      if (seen.counts) {
        VkDispatchIndirectCommand counts;
        std::memcpy(&counts, counts_.mapped() + *seen.counts * sizeof counts, sizeof counts);
        made.groups = uint64_t{counts.x} * counts.y * counts.z;
      }
      for (uint32_t b = 0; b < kernel.bindings.count && b < (*accesses)->bindings.size(); ++b) {
        const BindingAccess& access = (*accesses)->bindings[b];
        if (!access.reads && !access.writes) continue;
        const ResourceData& resource = graph_->resources[graph_->bindings[kernel.bindings.first + b]];
        made.bindings.push_back({std::string(b < pipeline.bindings.size() ? pipeline.bindings[b].name : std::string_view()),
                                 std::string(graph_->names[resource.name]), resource.size, access});
      }
      return made;
    }
    return Error{ErrorKind::Failed, where + " dispatched a pipeline that it did not declare"};
  }

  Expected<const ShaderAccesses*> accessesOf(const Pipeline& pipeline) {
    if (const auto known = accesses_.find(&pipeline); known != accesses_.end()) return &known->second;
    auto found = shaderAccesses(pipeline.words.empty() ? embeddedSpirv(device_, pipeline.shader) : pipeline.words, pipeline.constants);
    if (!found) return found.error();
    return &accesses_.emplace(&pipeline, std::move(*found)).first->second;
  }

  static inline thread_local Recorder* current_ = nullptr;
  DeviceImpl& device_;
  const DeviceTable driver_;
  const Buffer& counts_;
  uint32_t keptCounts_ = 0;
  GraphImpl* graph_ = nullptr;
  std::vector<Call> calls_;
  std::vector<Recorded> passes_;
  std::optional<uint32_t> pass_;  ///< the one being recorded
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::map<const Pipeline*, ShaderAccesses> accesses_;
};

}  // namespace

Expected<std::vector<TracedPass>> traceGraph(Workbench& workbench, const std::function<void(Graph&)>& declare) {
  auto counts =
      createBuffer(workbench.device(), "traced group counts", kMaxIndirect * sizeof(VkDispatchIndirectCommand), MemoryKind::Readback);
  if (!counts) return counts.error();
  Recorder recorder(implOf(workbench.device()), *counts);
  const auto ran = workbench.run([&](Graph& graph) {
    declare(graph);
    recorder.follow(implOf(graph));
  });
  recorder.release();
  if (!ran) return ran.error();
  return recorder.take();
}

}  // namespace rill::bench
