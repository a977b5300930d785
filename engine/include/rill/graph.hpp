#pragma once
// The render graph: passes declared every frame, compiled on the CPU into an order, barriers and a memory plan, and recorded
// into the host's command buffer. It never submits and never waits.
//
// Passes dispatch and draw with pipelines of rill/pipeline.hpp, whose bindings have no samplers: shaders read images by texelFetch. A pass
// that wants more (filtering, vertex buffers, ray queries) records with the host's own pipelines and descriptor sets: Commands::handle()
// gives the command buffer, Commands::buffer() and image() the handles. The graph's barriers serve it just so.
//
//   graph.reset();
//   rill::BufferRef counts = graph.create("counts", {4096});
//   graph.pass("clear", [&](rill::Pass& pass) {
//     counts = pass.write(counts, rill::Use::CopyTarget);
//     return [counts](rill::Commands& commands) { commands.fill(counts, 0); };
//   });
//   const rill::Ticket ticket = graph.readback(counts);
//   if (auto ok = graph.compile(); !ok) return fail(ok.error().message);
//   if (auto ok = graph.prepare(device); !ok) return fail(ok.error().message);
//   graph.record(commandBuffer);
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/graph_reports.hpp"
#include "rill/graph_resources.hpp"

namespace rill {

struct ComputePipeline;
struct GraphicsPipeline;
struct Pipeline;
class GraphImpl;
class Graph;

/// Workgroups of a dispatch in three dimensions, at most 65,535 in each.
struct Groups {
  uint32_t x = 1, y = 1, z = 1;
};

/// Names a binding of a kernel: the version and how the shader sees it follow from the pass's declared use.
using Bindings = std::initializer_list<ResourceRef>;

/// A pipeline with what is bound to it, declared at set-up so that record() cannot fail.
struct Kernel {
  uint32_t index = UINT32_MAX;
};

/// A read-back in flight.
struct Ticket {
  uint64_t id = 0;
};

/// Declares one pass: what it reads and writes, and the kernels it dispatches.
class RILL_API Pass {
 public:
  /// A buffer may be read in several ways by one pass, but not read and written: a write reads as well.
  void read(BufferRef buffer, Use use);
  void read(ImageRef image, Use use);
  /// Consumes `buffer` and returns the version that this pass makes. The old content is kept unless `discard`; a new
  /// transient has none to keep (so atomics on one are an error: fill it first).
  [[nodiscard]] BufferRef write(BufferRef buffer, Use use, bool discard = false);
  /// Targets (ColorTarget, DepthTarget) are what the pass draws to, colors in the order of these calls; all are of one size, and a pass
  /// with targets only draws. Keep of an image that has no content is an error there.
  [[nodiscard]] ImageRef write(ImageRef image, Use use, Load load = Load::Keep, const VkClearValue& clear = {});
  /// The pass matters even if nobody reads what it writes.
  void sideEffect();
  /// Binds buffers and images, in the order of the pipeline's bindings, each a version that this pass reads or one that it wrote.
  Kernel kernel(const ComputePipeline* pipeline, std::span<const ResourceRef> bindings);
  Kernel kernel(const ComputePipeline* pipeline, Bindings bindings) {
    return kernel(pipeline, std::span<const ResourceRef>(bindings.begin(), bindings.size()));
  }
  /// The same for a pipeline that draws to this pass's targets, which are declared before and are of the pipeline's formats.
  Kernel kernel(const GraphicsPipeline* pipeline, std::span<const ResourceRef> bindings);
  Kernel kernel(const GraphicsPipeline* pipeline, Bindings bindings) {
    return kernel(pipeline, std::span<const ResourceRef>(bindings.begin(), bindings.size()));
  }

 private:
  friend class Graph;
  friend class GraphImpl;
  Kernel noPipeline();
  Kernel bound(const Pipeline& pipeline, std::span<const ResourceRef> bindings);
  Pass(GraphImpl& graph, uint32_t index) : graph_(graph), index_(index) {}
  GraphImpl& graph_;
  uint32_t index_;
};

/// What a record lambda can do. Nothing here fails. A version of a resource that the pass did not declare is an assert.
class RILL_API Commands {
 public:
  /// `groups` workgroups; more than 65,535 are folded into x and y, so the shader takes its group index as
  /// gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x and checks its bound. 0 groups records nothing.
  void dispatch(Kernel kernel, uint64_t groups, std::span<const std::byte> push = {});
  template <class Push>
  void dispatch(Kernel kernel, uint64_t groups, const Push& push) {
    dispatch(kernel, groups, std::as_bytes(std::span(&push, 1)));
  }
  /// Workgroups as they are given, nothing folded: gl_WorkGroupID is what the shader expects. A 0 among them records nothing.
  void dispatch(Kernel kernel, Groups groups, std::span<const std::byte> push = {});
  template <class Push>
  void dispatch(Kernel kernel, Groups groups, const Push& push) {
    dispatch(kernel, groups, std::as_bytes(std::span(&push, 1)));
  }
  /// Three uint at `offset` bytes of `arguments` (declared with Use::Indirect).
  void dispatchIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, std::span<const std::byte> push = {});
  template <class Push>
  void dispatchIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, const Push& push) {
    dispatchIndirect(kernel, arguments, offset, std::as_bytes(std::span(&push, 1)));
  }
  /// In a pass with targets. The viewport is all of them until viewport() is called.
  void draw(Kernel kernel, uint32_t vertices, uint32_t instances, std::span<const std::byte> push = {});
  template <class Push>
  void draw(Kernel kernel, uint32_t vertices, uint32_t instances, const Push& push) {
    draw(kernel, vertices, instances, std::as_bytes(std::span(&push, 1)));
  }
  /// Four uint (vertices, instances, first of each) at `offset` bytes of `arguments` (declared with Use::Indirect).
  void drawIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, std::span<const std::byte> push = {});
  template <class Push>
  void drawIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, const Push& push) {
    drawIndirect(kernel, arguments, offset, std::as_bytes(std::span(&push, 1)));
  }
  /// Texels that the following draws of this pass cover, scissor included; within the targets.
  void viewport(uint32_t x, uint32_t y, uint32_t width, uint32_t height);
  void copy(BufferRef source, BufferRef target, uint64_t bytes, uint64_t sourceOffset = 0, uint64_t targetOffset = 0);
  /// At most 64 KiB, a multiple of 4; kept in the command buffer until it runs.
  void update(BufferRef target, std::span<const std::byte> bytes, uint64_t offset = 0);
  void fill(BufferRef target, uint32_t value, uint64_t offset = 0, uint64_t bytes = UINT64_MAX);  ///< UINT64_MAX: to the end
  /// The whole image from or to tightly packed rows that start at `offset` bytes of the buffer: a multiple of 4 and of a texel's bytes.
  void copy(BufferRef source, ImageRef target, uint64_t offset = 0);
  void copy(ImageRef source, BufferRef target, uint64_t offset = 0);
  /// The whole image, to one of the same size and of a format whose texels are as large.
  void copy(ImageRef source, ImageRef target);
  void clear(ImageRef target, const VkClearColorValue& value);

  /// For commands of the host's own, between those above or in place of them. The pass's barrier has been recorded; in a pass with targets
  /// rendering has begun, with viewport and scissor set to all of them. Nothing else is bound, and what the host binds lasts to the end of
  /// the pass at most: dispatch() and draw() bind all that they need. The host ends what it begins (rendering, queries) within the pass.
  VkCommandBuffer handle() const;
  /// What is behind a ref that this pass declared. Of a transient it is another buffer or image from frame to frame, which the passes of
  /// this frame's one recording may use: it goes into descriptor sets that no other frame in flight uses, and no command of a later one.
  VkDescriptorBufferInfo buffer(BufferRef buffer) const;
  ImageHandle image(ImageRef image) const;

 private:
  friend class GraphImpl;
  Commands(GraphImpl& graph, VkCommandBuffer commandBuffer) : graph_(graph), commandBuffer_(commandBuffer) {}
  struct Arguments {
    VkBuffer buffer;
    uint64_t offset;
  };
  Arguments argumentsAt(BufferRef arguments, uint64_t offset, uint64_t bytes) const;
  void bind(Kernel kernel, std::span<const std::byte> push);
  void copyWhole(BufferRef buffer, ImageRef image, uint64_t offset, bool toImage);
  GraphImpl& graph_;
  VkCommandBuffer commandBuffer_;
  uint32_t pass_ = 0;
};

/// One frame's graph. Declare, compile(), prepare(), record(); then reset() and declare the next frame: a steady state allocates nothing.
/// Not thread safe. Execution order is the order of declaration.
class RILL_API Graph {
 public:
  Graph();
  ~Graph();
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  /// Forgets the declared frame; refs of it become stale. Read-backs in flight, the transients' memory and timings stay.
  void reset();

  BufferRef create(std::string_view name, BufferDesc desc);  ///< transient: lives in the graph's own memory, content undefined at first
  ImageRef create(std::string_view name, ImageDesc desc);
  /// Level k of an image that was created or imported with more than k levels, as it was then: later versions are what writes return.
  ImageRef level(ImageRef image, uint32_t k);
  BufferRef import(std::string_view name, const BufferImport& import);
  ImageRef import(std::string_view name, const ImageImport& import);

  /// `setup(Pass&)` declares the pass and returns what records it, a callable taking Commands&.
  template <class Setup>
  void pass(std::string_view name, Setup&& setup) {
    const uint32_t index = beginPass(name);
    Pass declared(*impl_, index);
    auto record = setup(declared);
    using Record = decltype(record);
    // The callable is kept in the graph's own memory, which is used again every frame.
    void* place = endPass(
        index, sizeof(Record), alignof(Record), [](void* self, Commands& commands) { (*static_cast<Record*>(self))(commands); },
        std::is_trivially_destructible_v<Record> ? nullptr : +[](void* self) { static_cast<Record*>(self)->~Record(); });
    ::new (place) Record(std::move(record));
  }

  /// For --explain: a module says that it left a pass out, and why. `reason` must outlive the frame (a literal).
  void skipped(std::string_view name, std::string_view reason);

  /// The buffer's bytes as of this place among the passes, readable once the host's clock says that the frame has completed.
  Ticket readback(BufferRef buffer);
  /// Empty while in flight, for an abandoned frame, and for a ticket that nobody asked about for 16 frames.
  /// The span is valid until the next reset() after it was first seen ready.
  std::span<const std::byte> data(Ticket ticket) const;

  /// Culls, orders, plans barriers and memory. Touches no GPU. BadInput, naming pass and resource, for a stale or consumed ref,
  /// a read of a resource that nobody wrote, a buffer of no size, an image without a format. What memory an image of a new kind takes is an
  /// estimate.
  Expected<void> compile();
  /// Everything that can fail: memory, descriptor sets, query pools. Asks the device for the size of images of a new kind, and plans
  /// again where the estimate was wrong. BadInput where a resource is more than the device can bind or its format cannot be used so,
  /// NoDevice where no memory type suits all transient images, OutOfMemory, Failed. Transient images that the frame before had and this
  /// one has not are destroyed: frames that alternate should have a graph each.
  Expected<void> prepare(Device& device);
  /// Records into the host's command buffer, which is in the recording state and outside a render pass. Cannot fail.
  void record(VkCommandBuffer commandBuffer);

  std::string dot() const;                     ///< Graphviz; culled passes dashed with the reason, resources with memory and lifetime
  std::string json() const;                    ///< passes, barriers, resources, memory plan
  std::span<const Timing> timings() const;     ///< of the last frame that the host's clock says has completed
  std::span<const PassReport> report() const;  ///< of the last compiled frame
  uint64_t transientBytes() const;             ///< of device memory that the last compiled frame's transients take, aliased
  std::span<const TransientHeap> transientHeaps() const;  ///< where these bytes are, and what aliasing saves
  std::vector<TransientReport> transients() const;        ///< of the last compiled frame, those that a pass uses

  /// A timestamp before the first pass and after each. Default true; a software driver takes some 30 us for each.
  void enableTimings(bool enabled);

  GraphImpl& impl() { return *impl_; }  ///< engine/graph and its tests; not for hosts

 private:
  friend class Pass;
  friend class Commands;
  uint32_t beginPass(std::string_view name);
  void* endPass(uint32_t index, size_t bytes, size_t alignment, void (*invoke)(void*, Commands&), void (*destroy)(void*));
  std::unique_ptr<GraphImpl> impl_;
};

}  // namespace rill
