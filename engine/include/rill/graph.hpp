#pragma once
// The render graph. Passes are declared every frame, compiled on the CPU into barriers and a memory
// plan, and recorded into the host's command buffer. The graph never submits and never waits.
//
// Passes dispatch and draw with pipelines of rill/pipeline.hpp, which have no samplers: shaders read
// images with texelFetch. For filtering, vertex buffers or ray queries a pass records with the host's own
// pipelines and descriptor sets: Commands::handle() returns the command buffer, Commands::buffer() and
// image() return the handles. The graph's barriers cover these passes as well.
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

/// The resources of a kernel, in binding order. Version and access follow from the uses that the pass declares.
using Bindings = std::initializer_list<ResourceRef>;

/// A pipeline and its bound resources, declared during setup so that record() cannot fail.
struct Kernel {
  uint32_t index = UINT32_MAX;
};

/// Identifies a read-back; see Graph::data().
struct Ticket {
  uint64_t id = 0;
};

/// Declares one pass: what it reads and writes, and the kernels it dispatches.
class RILL_API Pass {
 public:
  /// One pass may read a buffer with several uses, but not both read and write it: a write may read as well.
  void read(BufferRef buffer, Use use);
  void read(ImageRef image, Use use);
  /// Consumes `buffer` and returns the version that this pass produces. The old content is kept unless
  /// `discard` is set. A new transient has undefined content, so atomics on it are an error: fill it first.
  [[nodiscard]] BufferRef write(BufferRef buffer, Use use, bool discard = false);
  /// ColorTarget and DepthTarget make the image an attachment; colors are attached in the order of these
  /// calls. All targets of a pass have the same size, and a pass with targets may only draw. Load::Keep is
  /// an error for a target with undefined content.
  [[nodiscard]] ImageRef write(ImageRef image, Use use, Load load = Load::Keep, const VkClearValue& clear = {});
  /// Prevents culling of the pass if nothing reads its results.
  void sideEffect();
  /// Binds buffers and images in the order of the pipeline's bindings. The pass must have declared a read
  /// or a write of each version.
  Kernel kernel(const ComputePipeline* pipeline, std::span<const ResourceRef> bindings);
  Kernel kernel(const ComputePipeline* pipeline, Bindings bindings) {
    return kernel(pipeline, std::span<const ResourceRef>(bindings.begin(), bindings.size()));
  }
  /// For a graphics pipeline. The pass's targets are declared before and match the pipeline's formats.
  Kernel kernel(const GraphicsPipeline* pipeline, std::span<const ResourceRef> bindings);
  Kernel kernel(const GraphicsPipeline* pipeline, Bindings bindings) {
    return kernel(pipeline, std::span<const ResourceRef>(bindings.begin(), bindings.size()));
  }

 private:
  friend class Graph;
  friend class GraphImpl;
  friend struct PassAccess;
  Kernel missingPipeline();
  Kernel bindKernel(const Pipeline& pipeline, std::span<const ResourceRef> bindings);
  Pass(GraphImpl& graph, uint32_t index) : graph_(graph), index_(index) {}
  GraphImpl& graph_;
  uint32_t index_;
};

/// Commands available to a record lambda. None of them can fail. Using a resource version that the pass
/// did not declare is an assert.
class RILL_API Commands {
 public:
  /// Dispatches `groups` workgroups. More than 65,535 are folded into x and y, possibly with extra groups:
  /// the shader computes its group index as gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x and
  /// checks it against the count. 0 groups record nothing.
  void dispatch(Kernel kernel, uint64_t groups, std::span<const std::byte> push = {});
  template <class Push>
  void dispatch(Kernel kernel, uint64_t groups, const Push& push) {
    dispatch(kernel, groups, std::as_bytes(std::span(&push, 1)));
  }
  /// Dispatches exactly `groups`, without folding. If a dimension is 0 nothing is recorded.
  void dispatch(Kernel kernel, Groups groups, std::span<const std::byte> push = {});
  template <class Push>
  void dispatch(Kernel kernel, Groups groups, const Push& push) {
    dispatch(kernel, groups, std::as_bytes(std::span(&push, 1)));
  }
  /// Reads a VkDispatchIndirectCommand at byte `offset` of `arguments` (declared with Use::Indirect).
  void dispatchIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, std::span<const std::byte> push = {});
  template <class Push>
  void dispatchIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, const Push& push) {
    dispatchIndirect(kernel, arguments, offset, std::as_bytes(std::span(&push, 1)));
  }
  /// Only in a pass with targets. The viewport covers the whole targets until viewport() is called.
  void draw(Kernel kernel, uint32_t vertices, uint32_t instances, std::span<const std::byte> push = {});
  template <class Push>
  void draw(Kernel kernel, uint32_t vertices, uint32_t instances, const Push& push) {
    draw(kernel, vertices, instances, std::as_bytes(std::span(&push, 1)));
  }
  /// Reads a VkDrawIndirectCommand at byte `offset` of `arguments` (declared with Use::Indirect).
  void drawIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, std::span<const std::byte> push = {});
  template <class Push>
  void drawIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, const Push& push) {
    drawIndirect(kernel, arguments, offset, std::as_bytes(std::span(&push, 1)));
  }
  /// Sets viewport and scissor of the following draws of this pass, in texels; must lie within the targets.
  void viewport(uint32_t x, uint32_t y, uint32_t width, uint32_t height);
  void copy(BufferRef source, BufferRef target, uint64_t bytes, uint64_t sourceOffset = 0, uint64_t targetOffset = 0);
  /// At most 64 KiB, a multiple of 4 bytes; the data is copied into the command buffer.
  void update(BufferRef target, std::span<const std::byte> bytes, uint64_t offset = 0);
  void fill(BufferRef target, uint32_t value, uint64_t offset = 0, uint64_t bytes = UINT64_MAX);  ///< UINT64_MAX: to the end
  /// Copies the whole image from or to tightly packed rows at byte `offset` of the buffer, a multiple of 4
  /// and of the texel size.
  void copy(BufferRef source, ImageRef target, uint64_t offset = 0);
  void copy(ImageRef source, BufferRef target, uint64_t offset = 0);
  /// Copies the whole image to one of the same size and texel size.
  void copy(ImageRef source, ImageRef target);
  void clear(ImageRef target, const VkClearColorValue& value);

  /// The command buffer, for commands of the host. The pass's barrier is already recorded; in a pass with
  /// targets rendering has begun, with viewport and scissor covering the targets. No other state is bound,
  /// and state that the host binds is valid until the end of the pass or the next dispatch() or draw().
  /// Rendering and queries that the host begins must end within the pass.
  VkCommandBuffer handle() const;
  /// The Vulkan handles of a ref that this pass declared. Those of a transient change from frame to frame:
  /// use them only in this recording, and in descriptor sets that no other frame in flight uses.
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

/// One frame's graph: declare, compile(), prepare(), record(), then reset() and declare the next frame.
/// Declaring equal frames allocates nothing. Not thread safe. Passes execute in the order of declaration.
class RILL_API Graph {
 public:
  Graph();
  ~Graph();
  Graph(Graph&&) noexcept;  ///< not while a pass is declared; a moved-from Graph may only be destroyed or assigned to
  Graph& operator=(Graph&&) noexcept;

  /// Clears the declared frame and invalidates its refs. Read-backs in flight, the transients' memory and
  /// timings are kept.
  void reset();

  BufferRef create(std::string_view name, BufferDesc desc);  ///< transient: in the graph's memory, content initially undefined
  ImageRef create(std::string_view name, ImageDesc desc);
  /// The initial version of mip level k of an image created or imported with more than k levels.
  ImageRef level(ImageRef image, uint32_t k);
  BufferRef import(std::string_view name, const BufferImport& import);
  ImageRef import(std::string_view name, const ImageImport& import);

  /// `setup(Pass&)` declares the pass and returns the callable, taking Commands&, that records it.
  template <class Setup>
  void pass(std::string_view name, Setup&& setup) {
    const uint32_t index = beginPass(name);
    Pass declared(*impl_, index);
    auto record = setup(declared);
    using Record = decltype(record);
    // The callable is stored in the graph's arena, which is reused every frame.
    void* place = endPass(
        index, sizeof(Record), alignof(Record), [](void* self, Commands& commands) { (*static_cast<Record*>(self))(commands); },
        std::is_trivially_destructible_v<Record> ? nullptr : +[](void* self) { static_cast<Record*>(self)->~Record(); });
    ::new (place) Record(std::move(record));
  }

  /// Reports a pass that a module left out, and why (shown by --explain). `reason` must outlive the frame.
  void skipped(std::string_view name, std::string_view reason);

  /// Copies the buffer's content at this point of the pass order; available once the frame has completed.
  Ticket readback(BufferRef buffer);
  /// Empty while the frame is in flight, if it was abandoned, and for a ticket not queried within 16 frames
  /// of completion. The span is valid until the first reset() after it was first returned.
  std::span<const std::byte> data(Ticket ticket) const;

  /// Culls passes and plans barriers and memory, without using a device. Fails with BadInput, naming pass
  /// and resource, for any declaration error: a stale or consumed ref, a read of undefined content, a buffer
  /// without a size, an image without a format. Sizes of new kinds of images are estimates at this point.
  Expected<void> compile();
  /// Creates everything that can fail: memory, descriptor sets, query pools. Queries the size of new kinds
  /// of images and plans again if an estimate was wrong. Fails with BadInput if a resource exceeds a limit
  /// or its format does not support a use, NoDevice if no memory type suits all transient images,
  /// OutOfMemory, Failed. Transient images that this frame no longer declares are destroyed, so two
  /// alternating kinds of frames should use two graphs.
  Expected<void> prepare(Device& device);
  /// Records into the host's command buffer, which must be in the recording state and outside a render
  /// pass. Cannot fail. One call per prepare().
  void record(VkCommandBuffer commandBuffer);

  std::string dot() const;                                ///< Graphviz: passes (culled ones dashed, with the reason), resources, lifetimes
  std::string json() const;                               ///< passes, barriers, resources, memory plan
  std::span<const Timing> timings() const;                ///< of the last completed frame
  std::span<const PassReport> report() const;             ///< of the last compiled frame
  uint64_t transientBytes() const;                        ///< device memory of the last compiled frame's transients, after aliasing
  std::span<const TransientHeap> transientHeaps() const;  ///< the same per heap, with the size before aliasing
  std::vector<TransientReport> transients() const;        ///< of the last compiled frame; only those that an executed pass uses

  /// Writes a timestamp before the first pass and after each pass. On by default; a software driver takes
  /// about 30 us per timestamp.
  void enableTimings(bool enabled);

 private:
  friend class Pass;
  friend class Commands;
  friend struct ImplAccess;  // engine/core/impl_of.hpp
  uint32_t beginPass(std::string_view name);
  void* endPass(uint32_t index, size_t bytes, size_t alignment, void (*invoke)(void*, Commands&), void (*destroy)(void*));
  std::unique_ptr<GraphImpl> impl_;
};

}  // namespace rill
