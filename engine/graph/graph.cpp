// Declaring a frame: refs are checked here, the first mistake is kept for compile() to report.
#include "rill/graph.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

/// Unique over all graphs, so that another graph's ref is as stale as last frame's.
uint32_t nextEpoch() {
  static std::atomic<uint32_t> epoch{0};
  return ++epoch;
}

/// Whether a binding of this kind can see a buffer that was declared with this use.
bool fits(BindingKind kind, Use use) {
  switch (kind) {
    case BindingKind::Storage:
      return use == Use::ComputeRead || use == Use::ComputeWrite || use == Use::ComputeAtomic;
    case BindingKind::Uniform:
      return use == Use::ComputeUniform;
    case BindingKind::TexelFloat4:
    case BindingKind::TexelUint:
    case BindingKind::TexelUint4:
      return use == Use::ComputeTexel;
    case BindingKind::StorageImage:
    case BindingKind::SampledImage:
      return false;
  }
  return false;
}

const char* kindName(BindingKind kind) {
  switch (kind) {
    case BindingKind::Storage:
      return "a storage buffer";
    case BindingKind::Uniform:
      return "a uniform buffer";
    case BindingKind::StorageImage:
    case BindingKind::SampledImage:
      return "an image";
    default:
      return "a texel buffer";
  }
}

}  // namespace

GraphImpl::GraphImpl() : epoch(nextEpoch()) {}
GraphImpl::~GraphImpl() { reset(); }

void GraphImpl::reset() {
  collect();
  for (const auto& s : slots)
    if (device && s->frame <= device->clock.completed) std::erase_if(s->deliveries, [](const FrameSlot::Delivery& d) { return d.seen; });
  for (PassData& pass : passes)
    if (pass.record && pass.destroy) pass.destroy(pass.record);
  arena.rewind();
  passes.clear();
  resources.clear();
  accesses.clear();
  kernels.clear();
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

BufferRef GraphImpl::add(ResourceData resource) {
  compiled = prepared = false;
  if (resource.size == 0) fail("buffer " + quoted(resource.name) + " has no size");
  if (resource.size > kMaxBufferBytes)
    fail("buffer " + quoted(resource.name) + " of " + std::to_string(resource.size) + " bytes: at most " + std::to_string(kMaxBufferBytes) +
         " are possible");
  resources.push_back(resource);
  return {uint32_t(resources.size() - 1), 0, epoch};
}

ResourceData* GraphImpl::resolve(BufferRef ref, uint32_t pass, const char* doing) {
  if (ref == BufferRef{0, 0, 0}) return nullptr;  // what write() returned for a mistake already reported
  const std::string_view passName = names[passes[pass].name];
  if (ref.index == kNone) {
    fail("pass '" + std::string(passName) + "' " + doing + " a buffer that was never made (an empty ref)");
    return nullptr;
  }
  if (ref.epoch != epoch || ref.index >= resources.size()) {
    fail("pass '" + std::string(passName) + "' " + doing +
         " a buffer of another graph or of an earlier frame: refs do not outlive Graph::reset()");
    return nullptr;
  }
  ResourceData& resource = resources[ref.index];
  if (ref.version != resource.version) {
    fail("pass '" + std::string(passName) + "' " + doing + " version " + std::to_string(ref.version) + " of " + quoted(resource.name) +
         ", which a later write consumed: the latest is version " + std::to_string(resource.version));
    return nullptr;
  }
  return &resource;
}

uint32_t GraphImpl::beginPass(std::string_view name) {
  compiled = prepared = false;
  PassData pass;
  pass.name = names.intern(name);
  pass.accesses.first = uint32_t(accesses.size());
  pass.kernels.first = uint32_t(kernels.size());
  passes.push_back(pass);
  return uint32_t(passes.size() - 1);
}

const Access* GraphImpl::accessOf(uint32_t pass, uint32_t resource) const {
  const Range range = passes[pass].accesses;
  for (uint32_t i = range.first; i < range.first + range.count; ++i)
    if (accesses[i].resource == resource) return &accesses[i];
  return nullptr;
}

void GraphImpl::addAccess(uint32_t pass, Access access) {
  assert(pass + 1 == passes.size() && "a pass declares its accesses inside its own set-up");
  accesses.push_back(access);
  ++passes[pass].accesses.count;
}

void Pass::read(BufferRef buffer, Use use) {
  ResourceData* resource = graph_.resolve(buffer, index_, "reads");
  if (!resource) return;
  const std::string_view pass = graph_.names[graph_.passes[index_].name];
  if (use == Use::None || use == Use::Unknown || use == Use::HostRead || writes(use))
    return graph_.fail("pass '" + std::string(pass) + "' reads " + graph_.quoted(resource->name) + " with Use::" + useRow(use).name +
                       ", which is no way for a pass to read");
  if (resource->version == 0 && !resource->imported)
    return graph_.fail("pass '" + std::string(pass) + "' reads " + graph_.quoted(resource->name) + ", which no pass has written");
  const Range range = graph_.passes[index_].accesses;
  for (uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Access& other = graph_.accesses[i];
    if (other.resource != buffer.index) continue;
    if (other.write)
      return graph_.fail("pass '" + std::string(pass) + "' reads and writes " + graph_.quoted(resource->name) +
                         ": declare the write alone (it may read as well), or make two passes");
    if (other.use == use) return;
  }
  graph_.addAccess(index_, {buffer.index, buffer.version, use, false, true});
}

BufferRef Pass::write(BufferRef buffer, Use use, bool discard) {
  constexpr BufferRef mistake{0, 0, 0};
  ResourceData* resource = graph_.resolve(buffer, index_, "writes");
  if (!resource) return mistake;
  const std::string pass = "pass '" + std::string(graph_.names[graph_.passes[index_].name]) + "'";
  if (use == Use::Unknown || !writes(use)) {
    graph_.fail(pass + " writes " + graph_.quoted(resource->name) + " with Use::" + useRow(use).name +
                ", which is no way for a pass to write");
    return mistake;
  }
  if (graph_.accessOf(index_, buffer.index)) {
    graph_.fail(pass + " uses " + graph_.quoted(resource->name) +
                " twice, once to write: declare the write alone (it may read as well), or make two passes");
    return mistake;
  }
  const bool fresh = resource->version == 0 && !resource->imported;
  if (fresh && use == Use::ComputeAtomic) {
    graph_.fail(pass + " does atomics on " + graph_.quoted(resource->name) + ", whose content is undefined: fill it first");
    return mistake;
  }
  graph_.addAccess(index_, {buffer.index, ++resource->version, use, true, !discard && !fresh});
  return {buffer.index, resource->version, graph_.epoch};
}

void Pass::sideEffect() { graph_.passes[index_].root = true; }

Kernel Pass::kernel(const ComputePipeline* pipeline, std::span<const BufferRef> refs) {
  assert(pipeline);
  const std::string_view pass = graph_.names[graph_.passes[index_].name];
  const auto mistake = [&](std::string message) {
    graph_.fail("pass '" + std::string(pass) + "', shader '" + pipeline->shader + "': " + std::move(message));
    return Kernel{};
  };
  const std::vector<BindingKind>& kinds = pipeline->set->kinds;
  if (refs.size() != kinds.size())
    return mistake(std::to_string(refs.size()) + " buffers were given for its " + std::to_string(kinds.size()) + " bindings");
  const uint32_t first = uint32_t(graph_.bindings.size());
  for (size_t i = 0; i < refs.size(); ++i) {
    if (refs[i] == BufferRef{0, 0, 0}) return {};  // already reported
    bool declared = false, fitting = false;
    const Range range = graph_.passes[index_].accesses;
    for (uint32_t k = range.first; k < range.first + range.count && !fitting; ++k) {
      const Access& access = graph_.accesses[k];
      // A write may be bound by the ref that went in or by the one that came out.
      if (refs[i].epoch != graph_.epoch || access.resource != refs[i].index) continue;
      if (access.version != refs[i].version && !(access.write && access.version == refs[i].version + 1)) continue;
      declared = true;
      fitting = fits(kinds[i], access.use);
    }
    const auto name = [&] {
      return refs[i].index < graph_.resources.size() ? graph_.quoted(graph_.resources[refs[i].index].name) : "an empty ref";
    };
    if (!declared)
      return mistake("binding " + std::to_string(i) + " is " + name() + " in a version that the pass neither reads nor writes");
    if (!fitting)
      return mistake("binding " + std::to_string(i) + " is " + kindName(kinds[i]) + ", which no declared use of " + name() + " is");
    graph_.bindings.push_back(refs[i].index);
  }
  graph_.kernels.push_back({pipeline, {first, uint32_t(refs.size())}, VK_NULL_HANDLE});
  ++graph_.passes[index_].kernels.count;
  return {uint32_t(graph_.kernels.size() - 1)};
}

Graph::Graph() : impl_(std::make_unique<GraphImpl>()) {}
Graph::~Graph() = default;
void Graph::reset() { impl_->reset(); }

BufferRef Graph::create(std::string_view name, BufferDesc desc) {
  ResourceData resource;
  resource.name = impl_->names.intern(name);
  resource.size = desc.size;
  return impl_->add(resource);
}

BufferRef Graph::import(std::string_view name, const BufferImport& import) {
  ResourceData resource;
  resource.name = impl_->names.intern(name);
  resource.imported = true;
  resource.import = import;
  resource.size = import.size;
  if (import.after == Use::Unknown) impl_->fail("import " + impl_->quoted(resource.name) + ": Use::Unknown is no state to leave it in");
  return impl_->add(resource);
}

void Graph::skipped(std::string_view name, std::string_view reason) { impl_->skips.push_back({impl_->names.intern(name), reason}); }

Ticket Graph::readback(BufferRef buffer) {
  GraphImpl& graph = *impl_;
  const bool append = !graph.passes.empty() && graph.passes.back().readback;  // read-backs in a row are one pass
  const uint32_t pass = append ? uint32_t(graph.passes.size() - 1) : graph.beginPass("readback");
  graph.passes[pass].readback = graph.passes[pass].root = true;
  const Ticket ticket{graph.nextTicket++};
  Pass(graph, pass).read(buffer, Use::CopySource);
  if (!graph.error) graph.readbacks.push_back({ticket.id, pass, buffer.index, 0, graph.resources[buffer.index].size});
  return ticket;
}

std::span<const std::byte> Graph::data(Ticket ticket) const { return impl_->data(ticket); }
Expected<void> Graph::compile() { return impl_->compile(); }
Expected<void> Graph::prepare(Device& device) { return impl_->prepare(device); }
void Graph::record(VkCommandBuffer commandBuffer) { impl_->record(commandBuffer); }
std::string Graph::dot() const { return impl_->dot(); }
std::string Graph::json() const { return impl_->json(); }
std::span<const PassReport> Graph::report() const { return impl_->reports; }
void Graph::enableTimings(bool enabled) { impl_->timed = enabled; }

std::span<const Timing> Graph::timings() const {
  impl_->collect();
  return impl_->timings;
}

uint64_t Graph::transientBytes() const {
  uint64_t bytes = 0;
  for (uint64_t size : impl_->heapSizes) bytes += size;
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
