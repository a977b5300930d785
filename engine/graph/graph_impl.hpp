#pragma once
// What is behind rill::Graph. One frame's declaration and plan are flat arrays that keep their capacity from frame to frame.
//   graph.cpp declares, compile.cpp culls and plans, plan_reuse.cpp takes over the plan of an equal frame, prepare.cpp gets what the device
//   must give, record.cpp records, describe.cpp writes it all down.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device_impl.hpp"
#include "gpu/pipeline.hpp"
#include "graph/frame_slot.hpp"
#include "graph/hazard.hpp"
#include "graph/image_store.hpp"
#include "graph/memory_plan.hpp"
#include "graph/names.hpp"
#include "graph/record_arena.hpp"
#include "rill/graph.hpp"

namespace rill {

inline constexpr uint32_t kNone = UINT32_MAX;

struct Access {
  uint32_t resource = 0;
  uint32_t version = 0;  ///< read, or made by the write
  Use use = Use::Nothing;
  bool write = false;
  bool keep = false;  ///< a write that also needs the old content
  friend bool operator==(const Access&, const Access&) = default;
};

struct Range {
  uint32_t first = 0, count = 0;
};

inline constexpr size_t kMaxTargets = 8;  ///< of a pass, the depth among them; Vulkan guarantees four colors

/// An image that a pass draws to.
struct Target {
  uint32_t resource = 0;
  Load load = Load::Keep;
  bool store = true;  ///< somebody wants what is drawn
  VkClearValue clear{};
};

struct KernelData {
  const Pipeline* pipeline = nullptr;
  Range bindings;  ///< into GraphImpl::bindings: resource indices
  VkDescriptorSet set = VK_NULL_HANDLE;
};

/// A change of an image's layout, part of a pass's barrier.
struct Transition {
  uint32_t resource = 0;
  VkImageLayout from = VK_IMAGE_LAYOUT_UNDEFINED, to = VK_IMAGE_LAYOUT_UNDEFINED;
  Scope scope;
};

/// Why a pass waits.
struct Cause {
  uint32_t resource = 0;
  Hazard hazard = Hazard::None;
  const char* use = "";
};

/// The one barrier before a pass, or at the end of the frame.
struct PlannedBarrier {
  Scope scope;
  Range causes, transitions;
  bool empty() const { return scope.empty() && transitions.count == 0; }
};

struct PassData {
  uint32_t name = 0;
  Range accesses, kernels, targets;
  void* record = nullptr;
  void (*invoke)(void*, Commands&) = nullptr;
  void (*destroy)(void*) = nullptr;
  bool root = false;
  bool readback = false;  ///< made by Graph::readback
  bool alive = false;
  std::string_view reason;  ///< why it was culled
  PlannedBarrier barrier;
};

struct ResourceData {
  uint32_t name = 0;
  bool imported = false;
  bool isImage = false;
  bool needed = false;         ///< while culling: whether a later pass, or somebody outside, wants the content
  ImportState before, after;   ///< of an import
  VkFlags madeFor = 0;         ///< of an import: the usage that its host says it was created for; 0: not said
  uint64_t size = 0;           ///< bytes; an image's is an estimate until prepare() has asked
  ImageDesc desc;              ///< of an image: all of its levels
  uint32_t level = 0;          ///< of an image: each is a resource of its own, one after another
  uint32_t version = 0;        ///< the latest one
  uint32_t placement = kNone;  ///< of a transient that is used; a pyramid's stands at its level 0
  bool placed = false;         ///< while planning: it has waited for what its memory held before
  HazardState state;           ///< after the first `barriersSeen`, see stateNow()
  uint32_t barriersSeen = 0;
  VkImageUsageFlags usage = 0;                       ///< of an image, by the passes that run; a pyramid's stands at its level 0
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< while planning: the image's
  VkBuffer buffer = VK_NULL_HANDLE;                  ///< a transient's is resolved by prepare()
  uint64_t offset = 0;
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;

  const char* kind() const { return isImage ? "image " : "buffer "; }
  uint32_t width() const { return std::max(1u, desc.width >> level); }
  uint32_t height() const { return std::max(1u, desc.height >> level); }
  /// Imported in a state that keeps its content, or written by a pass.
  bool hasContent() const { return version > 0 || (imported && (!isImage || (before != Use::Nothing && before != Use::Unknown))); }
};

struct PassedBarrier {
  Scope scope;
  uint32_t seeing = 0;  ///< usesSeeing(scope)
};

/// Where the transients of one kind lie.
struct TransientPlan {
  std::vector<Placement> placements;
  std::vector<uint32_t> resources;  ///< of each placement
  std::vector<uint32_t> tenants;    ///< while planning: placements that a later one may have to wait for
  std::vector<uint64_t> heapSizes;
};

struct Readback {
  uint64_t ticket = 0;
  uint32_t pass = 0, resource = 0;
  uint32_t buffer = 0;            ///< of the slot's
  uint64_t offset = 0, size = 0;  ///< in it
};

/// The frame whose plan the graph holds, as it was declared and planned.
struct PlannedFrame {
  bool valid = false;
  std::vector<PassData> passes;
  std::vector<ResourceData> resources;
  std::vector<Access> accesses;
  std::vector<Target> targets;
};

struct Skipped {
  uint32_t name;
  std::string_view reason;
};

class GraphImpl {
 public:
  GraphImpl();
  ~GraphImpl();
  /// Expires with the graph: for modules that wait for read-backs of one that its host may destroy before.
  std::weak_ptr<GraphImpl> watched() const { return life_; }

  // graph.cpp
  void reset();
  ResourceRef add(ResourceData resource);
  void checkStates(const ResourceData& import);
  /// Null, with the frame's error set, for a ref that is stale, consumed or none at all.
  ResourceData* resolve(ResourceRef ref, bool isImage, uint32_t pass, const char* doing);
  void read(uint32_t pass, ResourceRef ref, bool isImage, Use use);
  ResourceRef write(uint32_t pass, ResourceRef ref, bool isImage, Use use, Load load);
  void addTarget(uint32_t pass, ResourceRef ref, Load load, const VkClearValue& clear);
  uint32_t beginPass(std::string_view name);
  void addAccess(uint32_t pass, Access access);
  void fail(std::string message);
  std::string quoted(uint32_t name) const { return "'" + std::string(names[name]) + "'"; }
  const Access* accessOf(uint32_t pass, uint32_t resource) const;
  /// What the pass that is being recorded does with this version of a resource; asserted that it does.
  const Access& recorded(uint32_t pass, ResourceRef ref) const;
  /// Whether the pass may use the resource so, by what its host has created it for.
  bool madeFor(uint32_t pass, const ResourceData& resource, Use use);

  // compile.cpp
  Expected<void> compile();
  void cull();
  void placeTransients();
  void reportHeaps();
  TransientPlan& planOf(const ResourceData& resource) { return plans[resource.isImage]; }
  const TransientPlan& planOf(const ResourceData& resource) const { return plans[resource.isImage]; }
  /// Where what concerns a resource's memory stands: level 0 of a pyramid, else itself.
  ResourceData& memoryOf(uint32_t resource) { return resources[resource - resources[resource].level]; }
  const ResourceData& memoryOf(uint32_t resource) const { return resources[resource - resources[resource].level]; }
  HazardState& stateNow(ResourceData& resource);
  void waitForMemory(uint32_t resource, const HazardState& seam);
  void planBarriers();
  void makeReport();
  Expected<void> checkImports() const;

  // plan_reuse.cpp
  /// At the end of a frame: its plan may serve the next one.
  void keepPlan();
  /// Whether the frame is declared like the one before; it then has that one's plan.
  bool reusePlan();

  // prepare.cpp
  Expected<void> prepare(Device& device);
  Expected<void> growHeaps(DeviceImpl& device);
  Expected<void> resolveBuffers(DeviceImpl& device);
  Expected<void> placeReadbacks(DeviceImpl& device, FrameSlot& slot);
  Expected<void> learnImages(DeviceImpl& device);
  Expected<void> resolveImages(DeviceImpl& device, FrameSlot& slot);
  void shareSets();
  Expected<void> makeSets(DeviceImpl& device, FrameSlot& slot);
  /// Timings and read-backs of frames that have completed since the last look.
  void collect();
  std::span<const std::byte> data(Ticket ticket);

  // record.cpp
  void record(VkCommandBuffer commandBuffer);
  void beginTargets(const PassData& pass, VkCommandBuffer commandBuffer) const;

  // describe.cpp
  std::string memoryText(uint32_t resource) const;
  std::string dot() const;
  std::string json() const;
  std::vector<TransientReport> transients() const;

  Names names;
  RecordArena arena;
  uint32_t epoch = 0;
  std::optional<Error> error;  ///< the first mistake in the declaration
  bool compiled = false, prepared = false;
  bool timed = true;
  bool draws = false;  ///< some frame so far has drawn

  std::vector<PassData> passes;
  std::vector<ResourceData> resources;
  std::vector<Access> accesses;
  std::vector<KernelData> kernels;
  std::vector<Target> targets;
  std::vector<uint32_t> bindings;
  std::vector<Readback> readbacks;
  std::vector<Skipped> skips;

  MemoryPlanner planner;
  TransientPlan plans[2];  ///< of buffers, of images
  std::vector<TransientHeap> heapReports;
  PlannedFrame before;
  bool planWhole = false;                     ///< of this frame: nothing has failed since compile()
  uint64_t plansMade = 0;                     ///< how often a plan could not be taken over
  std::vector<PassedBarrier> barriersPassed;  ///< while planning
  std::vector<Cause> causes;
  std::vector<Transition> transitions;
  std::vector<VkImageMemoryBarrier2> imageBarriers;  ///< of `transitions`, made by prepare()
  PlannedBarrier finalBarrier;
  std::vector<PassReport> reports;
  std::vector<uint32_t> rowOfName;  ///< scratch: where a name stands in a list

  DeviceImpl* device = nullptr;
  std::vector<Buffer> heaps;
  ImageStore images;
  std::vector<std::unique_ptr<FrameSlot>> slots;
  FrameSlot* slot = nullptr;  ///< of the prepared frame
  SetSharing sharing;
  std::vector<Timing> timings;
  std::vector<uint64_t> stamps;
  uint64_t timingsFrame = 0;
  uint64_t nextTicket = 1;

 private:
  std::shared_ptr<GraphImpl> life_{this, [](GraphImpl*) {}};  ///< owns nothing
};

}  // namespace rill
