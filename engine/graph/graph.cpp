// The public functions. compile() reports the first error of the declarations.
#include "rill/graph.hpp"

#include <atomic>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

/// Unique over all graphs, so that refs of other graphs are detected like refs of earlier frames.
uint32_t nextEpoch() {
  static std::atomic<uint32_t> epoch{0};
  return ++epoch;
}

}  // namespace

GraphImpl::GraphImpl() : epoch(nextEpoch()) {}
GraphImpl::~GraphImpl() { reset(); }

void GraphImpl::reset() {
  collect();
  for (const auto& s : slots)
    if (device && s->frame <= device->clock.completed)
      std::erase_if(s->pendingReadbacks, [](const FrameSlot::PendingReadback& d) { return d.returned; });
  for (PassData& pass : passes)
    if (pass.record && pass.destroy) pass.destroy(pass.record);
  arena.rewind();
  keepPlan();
  passes.clear();
  resources.clear();
  accesses.clear();
  kernels.clear();
  targets.clear();
  bindings.clear();
  readbacks.clear();
  skips.clear();
  error.reset();
  compiled = prepared = false;
  slot = nullptr;
  epoch = nextEpoch();
}

void GraphImpl::fail(std::string message) {
  if (!error) error = Error{ErrorKind::BadInput, std::move(message)};
}

Graph::Graph() : impl_(std::make_unique<GraphImpl>()) {}
Graph::~Graph() = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;
void Graph::reset() { impl_->reset(); }

BufferRef Graph::create(std::string_view name, BufferDesc desc) {
  ResourceData resource;
  resource.name = impl_->names.intern(name);
  resource.size = desc.size;
  return {impl_->add(resource)};
}

ImageRef Graph::create(std::string_view name, ImageDesc desc) {
  ResourceData resource;
  resource.name = impl_->names.intern(name);
  resource.isImage = true;
  resource.desc = desc;
  return {impl_->add(resource)};
}

BufferRef Graph::import(std::string_view name, const BufferImport& import) {
  ResourceData resource;
  resource.name = impl_->names.intern(name);
  resource.imported = true;
  resource.before = import.before;
  resource.after = import.after;
  resource.buffer = import.handle;
  resource.offset = import.offset;
  resource.size = import.size;
  return {impl_->add(resource)};
}

ImageRef Graph::import(std::string_view name, const ImageImport& import) {
  ResourceData resource;
  resource.name = impl_->names.intern(name);
  resource.imported = resource.isImage = true;
  resource.before = import.before;
  resource.after = import.after;
  resource.image = import.handle;
  resource.desc = import.desc;
  resource.createdUsage = import.usage;
  return {impl_->add(resource)};
}

ImageRef Graph::level(ImageRef image, uint32_t k) {
  GraphImpl& graph = *impl_;
  if (image == kInvalidRef) return image;
  if (image.epoch != graph.epoch || image.index >= graph.resources.size() || !graph.resources[image.index].isImage) {
    graph.fail("Graph::level: ref of another graph or an earlier frame");
    return {kInvalidRef};
  }
  const ResourceData& resource = graph.memoryOf(image.index);
  if (k >= resource.desc.levels) {
    graph.fail("level " + std::to_string(k) + " of image " + graph.quoted(resource.name) + " requested, but it has " +
               std::to_string(resource.desc.levels));
    return {kInvalidRef};
  }
  return {{image.index - graph.resources[image.index].level + k, 0, graph.epoch}};
}

void Graph::skipped(std::string_view name, std::string_view reason) { impl_->skips.push_back({impl_->names.intern(name), reason}); }

Ticket Graph::readback(BufferRef buffer) {
  GraphImpl& graph = *impl_;
  const bool append = !graph.passes.empty() && graph.passes.back().readback;  // consecutive read-backs share one pass
  const uint32_t pass = append ? uint32_t(graph.passes.size() - 1) : graph.beginPass("readback");
  graph.passes[pass].readback = graph.passes[pass].root = true;
  const Ticket ticket{graph.nextTicket++};
  Pass(graph, pass).read(buffer, Use::CopySource);
  if (!graph.error) graph.readbacks.push_back({ticket.id, pass, buffer.index, 0, 0, graph.resources[buffer.index].size});
  return ticket;
}

std::span<const std::byte> Graph::data(Ticket ticket) const { return impl_->data(ticket); }
Expected<void> Graph::compile() { return impl_->compile(); }
Expected<void> Graph::prepare(Device& device) { return impl_->prepare(device); }
void Graph::record(VkCommandBuffer commandBuffer) { impl_->record(commandBuffer); }
std::string Graph::dot() const { return impl_->dot(); }
std::string Graph::json() const { return impl_->json(); }
std::span<const PassReport> Graph::report() const { return impl_->reports; }
void Graph::enableTimings(bool enabled) { impl_->timingsEnabled = enabled; }

std::span<const Timing> Graph::timings() const {
  impl_->collect();
  return impl_->timings;
}

std::span<const TransientHeap> Graph::transientHeaps() const { return impl_->heapReports; }
std::vector<TransientReport> Graph::transients() const { return impl_->transients(); }

uint64_t Graph::transientBytes() const {
  uint64_t bytes = 0;
  for (const TransientHeap& heap : impl_->heapReports) bytes += heap.bytes;
  return bytes;
}

uint32_t Graph::beginPass(std::string_view name) { return impl_->beginPass(name); }

void* Graph::endPass(uint32_t index, size_t bytes, size_t alignment, void (*invoke)(void*, Commands&), void (*destroy)(void*)) {
  PassData& pass = impl_->passes[index];
  pass.record = impl_->arena.allocate(bytes, alignment);
  pass.invoke = invoke;
  pass.destroy = destroy;
  return pass.record;
}

}  // namespace rill
