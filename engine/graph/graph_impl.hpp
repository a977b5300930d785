#pragma once
// Implementation of rill::Graph. Declaration and plan are flat arrays that keep their capacity between frames.
//   graph.cpp has the public functions; resources.cpp, accesses.cpp and kernels.cpp declare; compile.cpp culls and plans;
//   plan_reuse.cpp reuses the plan of an equal frame; prepare.cpp and descriptor_sets.cpp create device objects; record.cpp
//   records; readbacks.cpp and timings.cpp return results; describe.cpp exports.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/impl_of.hpp"
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
/// Returned by a write whose error has been reported; causes no further errors.
inline constexpr ResourceRef kInvalidRef{0, 0, 0};

struct Access {
  uint32_t resource = 0;
  uint32_t version = 0;  ///< the version read, or produced by the write
  Use use = Use::Nothing;
  bool write = false;
  bool keep = false;  ///< a write that also needs the old content
  friend bool operator==(const Access&, const Access&) = default;
};

struct Range {
  uint32_t first = 0, count = 0;
};

inline constexpr size_t kMaxTargets = 8;  ///< per pass, including depth; Vulkan guarantees four color attachments

/// An image that a pass draws to.
struct Target {
  uint32_t resource = 0;
  Load load = Load::Keep;
  bool store = true;  ///< the content is used later
  VkClearValue clear{};
};

struct KernelData {
  const Pipeline* pipeline = nullptr;
  Range bindings;  ///< into GraphImpl::bindings: resource indices
  VkDescriptorSet set = VK_NULL_HANDLE;
};

/// A layout transition, part of a pass's barrier.
struct Transition {
  uint32_t resource = 0;
  VkImageLayout from = VK_IMAGE_LAYOUT_UNDEFINED, to = VK_IMAGE_LAYOUT_UNDEFINED;
  Scope scope;
};

/// The reason for a dependency of a pass.
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
  bool readback = false;  ///< declared by Graph::readback
  bool alive = false;
  std::string_view reason;  ///< why it was culled
  PlannedBarrier barrier;
};

struct ResourceData {
  uint32_t name = 0;
  bool imported = false;
  bool isImage = false;
  bool needed = false;         ///< during culling: the content is used by a later pass or after the graph
  ImportState before, after;   ///< of an import
  VkFlags createdUsage = 0;    ///< of an import: usage flags at creation; 0: unknown
  uint64_t size = 0;           ///< bytes; for images an estimate until prepare() has queried the device
  ImageDesc desc;              ///< of an image: all of its levels
  uint32_t level = 0;          ///< of an image: levels are consecutive resources
  uint32_t version = 0;        ///< latest version
  uint32_t placement = kNone;  ///< of a used transient; for images stored at level 0
  bool placed = false;         ///< during planning: it depends on the previous users of its memory
  HazardState state;           ///< after the first `barriersApplied`, see currentState()
  uint32_t barriersApplied = 0;
  VkImageUsageFlags usage = 0;                       ///< of an image, from its uses in executed passes; stored at level 0
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< during planning: current layout
  VkBuffer buffer = VK_NULL_HANDLE;                  ///< transients: set by prepare()
  uint64_t offset = 0;
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;

  const char* kind() const { return isImage ? "image " : "buffer "; }
  uint32_t width() const { return std::max(1u, desc.width >> level); }
  uint32_t height() const { return std::max(1u, desc.height >> level); }
  /// Whether the content is defined: imported in a state that keeps it, or written by a pass.
  bool hasContent() const { return version > 0 || (imported && (!isImage || (before != Use::Nothing && before != Use::Unknown))); }
};

struct AppliedBarrier {
  Scope scope;
  uint32_t visibleUses = 0;  ///< usesMadeVisible(scope)
};

/// Placement of the transients of one kind (buffers or images).
struct TransientPlan {
  std::vector<Placement> placements;
  std::vector<uint32_t> resources;        ///< of each placement
  std::vector<uint32_t> aliasCandidates;  ///< during planning: placements that a later one may have to wait for
  std::vector<uint64_t> heapSizes;
};

struct Readback {
  uint64_t ticket = 0;
  uint32_t pass = 0, resource = 0;
  uint32_t buffer = 0;            ///< of the slot's
  uint64_t offset = 0, size = 0;  ///< in it
};

/// The last completely planned frame, for comparison and reuse.
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
  /// Expires with the graph. For modules that wait for read-backs of a graph which the host may destroy.
  std::weak_ptr<GraphImpl> weakSelf() const { return life_; }

  // graph.cpp
  void reset();
  void fail(std::string message);
  std::string quoted(uint32_t name) const { return "'" + std::string(names[name]) + "'"; }

  // resources.cpp
  ResourceRef add(ResourceData resource);
  void checkStates(const ResourceData& import);
  /// Whether an import's usage flags allow this use; sets the frame's error if not.
  bool checkUsage(uint32_t pass, const ResourceData& resource, Use use);

  // accesses.cpp
  /// Null, with the frame's error set, if the ref is empty, stale or consumed.
  ResourceData* resolve(ResourceRef ref, bool isImage, uint32_t pass, const char* verb);
  void read(uint32_t pass, ResourceRef ref, bool isImage, Use use);
  ResourceRef write(uint32_t pass, ResourceRef ref, bool isImage, Use use, Load load);
  void addTarget(uint32_t pass, ResourceRef ref, Load load, const VkClearValue& clear);
  uint32_t beginPass(std::string_view name);
  void addAccess(uint32_t pass, Access access);
  const Access* accessOf(uint32_t pass, uint32_t resource) const;

  // compile.cpp
  Expected<void> compile();
  void cull();
  void placeTransients();
  void reportHeaps();
  TransientPlan& planOf(const ResourceData& resource) { return plans[resource.isImage]; }
  const TransientPlan& planOf(const ResourceData& resource) const { return plans[resource.isImage]; }
  /// The resource that holds placement and usage: level 0 of an image with mip levels, otherwise itself.
  ResourceData& memoryOf(uint32_t resource) { return resources[resource - resources[resource].level]; }
  const ResourceData& memoryOf(uint32_t resource) const { return resources[resource - resources[resource].level]; }
  HazardState& currentState(ResourceData& resource);
  void waitForAliasedMemory(uint32_t resource, const HazardState& previousFrame);
  void planBarriers();
  void makeReport();
  Expected<void> checkImports() const;

  // plan_reuse.cpp
  /// Saves the plan at the end of a frame.
  void keepPlan();
  /// Copies the previous frame's plan if the declarations are equal; false if they differ.
  bool reusePlan();

  // prepare.cpp
  Expected<void> prepare(Device& device);
  Expected<void> checkSizes(const DeviceImpl& d) const;
  Expected<void> growHeaps(DeviceImpl& device);
  Expected<void> resolveBuffers(DeviceImpl& device);
  Expected<void> queryImageRequirements(DeviceImpl& device);
  Expected<void> resolveImages(DeviceImpl& device, FrameSlot& slot);

  // descriptor_sets.cpp
  void deduplicateSets();
  Expected<void> allocateSets(DeviceImpl& device, FrameSlot& slot);

  // readbacks.cpp
  /// Packs the read-backs into buffers of at most kSharedBufferBytes; a larger one has a buffer of its own.
  Expected<void> placeReadbacks(DeviceImpl& device, FrameSlot& slot);
  std::span<const std::byte> data(Ticket ticket);

  // timings.cpp
  /// Makes room for the timestamps of the frame.
  Expected<void> prepareTimings(DeviceImpl& device, FrameSlot& slot);
  /// Updates the timings from the newest completed frame.
  void collect();

  // record.cpp
  void record(VkCommandBuffer commandBuffer);
  void beginTargets(const PassData& pass, VkCommandBuffer commandBuffer) const;
  /// The access that the pass declared for this version of a resource; asserts that there is one.
  const Access& declaredAccess(uint32_t pass, ResourceRef ref) const;

  // describe.cpp
  std::string memoryLabel(uint32_t resource) const;
  std::string dot() const;
  std::string json() const;
  std::vector<TransientReport> transients() const;

  Names names;
  RecordArena arena;
  uint32_t epoch = 0;
  std::optional<Error> error;  ///< the first declaration error
  bool compiled = false, prepared = false;
  bool timingsEnabled = true;
  bool usesGraphics = false;  ///< a frame so far declared a graphics use

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
  PlannedFrame previousPlan;
  bool planComplete = false;                    ///< compile(), and prepare() if called, succeeded for this frame
  uint64_t plansMade = 0;                       ///< number of plans that were not reused
  std::vector<AppliedBarrier> appliedBarriers;  ///< during planning
  std::vector<Cause> causes;
  std::vector<Transition> transitions;
  std::vector<VkImageMemoryBarrier2> imageBarriers;  ///< of `transitions`, made by prepare()
  PlannedBarrier finalBarrier;
  std::vector<PassReport> reports;
  std::vector<uint32_t> rowByName;  ///< scratch: name id -> row of a report

  DeviceImpl* device = nullptr;
  std::vector<Buffer> heaps;
  ImageStore images;
  std::vector<std::unique_ptr<FrameSlot>> slots;
  FrameSlot* slot = nullptr;  ///< of the prepared frame
  SetDeduplication setDedup;
  std::vector<Timing> timings;
  std::vector<uint64_t> stamps;
  uint64_t timingsFrame = 0;
  uint64_t nextTicket = 1;

 private:
  std::shared_ptr<GraphImpl> life_{this, [](GraphImpl*) {}};  ///< owns nothing
};

}  // namespace rill
