// Declaring a frame: refs are checked here, the first mistake is kept for compile() to report.
#include "rill/graph.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

/// Unique over all graphs, so that another graph's ref is as stale as last frame's.
uint32_t nextEpoch() {
  static std::atomic<uint32_t> epoch{0};
  return ++epoch;
}

/// Whether a binding of this kind can see a resource that was declared with this use.
bool fits(BindingKind kind, bool isImage, Use use, bool draws) {
  if (isImage != (kind == BindingKind::StorageImage || kind == BindingKind::SampledImage)) return false;
  switch (kind) {
    case BindingKind::Storage:
      if (draws) return use == Use::DrawRead;
      [[fallthrough]];
    case BindingKind::StorageImage:
      return !draws && (use == Use::ComputeRead || use == Use::ComputeWrite || use == Use::ComputeAtomic);
    case BindingKind::Uniform:
      return use == (draws ? Use::DrawUniform : Use::ComputeUniform);
    case BindingKind::TexelFloat4:
    case BindingKind::TexelUint:
    case BindingKind::TexelUint4:
      return !draws && use == Use::ComputeTexel;
    case BindingKind::SampledImage:
      return use == (draws ? Use::DrawSampled : Use::ComputeSampled);
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
      return "a storage image";
    case BindingKind::SampledImage:
      return "a sampled image";
    default:
      return "a texel buffer";
  }
}

const char* usageName(VkImageUsageFlags usage) {
  switch (usage) {
    case VK_IMAGE_USAGE_STORAGE_BIT:
      return "VK_IMAGE_USAGE_STORAGE_BIT";
    case VK_IMAGE_USAGE_SAMPLED_BIT:
      return "VK_IMAGE_USAGE_SAMPLED_BIT";
    case VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT:
      return "VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT";
    case VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT:
      return "VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT";
    case VK_IMAGE_USAGE_TRANSFER_SRC_BIT:
      return "VK_IMAGE_USAGE_TRANSFER_SRC_BIT";
    default:
      return "VK_IMAGE_USAGE_TRANSFER_DST_BIT";
  }
}

constexpr uint32_t kMaxImageSide = 32768;  // more than devices offer, and few enough that sizes stay in 64 bits

constexpr ResourceRef kMistake{0, 0, 0};  ///< what a write returns for a mistake that has been reported

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

ResourceRef GraphImpl::add(ResourceData resource) {
  compiled = prepared = false;
  const std::string_view kind = resource.kind();
  const auto mistake = [&](std::string_view what) { fail(std::string(kind) + quoted(resource.name) + std::string(what)); };
  if (resource.isImage) {
    if (resource.desc.format == VK_FORMAT_UNDEFINED) mistake(" has no format");
    if (resource.desc.format == VK_FORMAT_S8_UINT) mistake(" is of a format with a stencil alone, which no pass can use");
    if (resource.desc.width == 0 || resource.desc.height == 0) mistake(" has no size");
    if (std::max(resource.desc.width, resource.desc.height) > kMaxImageSide)
      mistake(" of " + std::to_string(resource.desc.width) + " x " + std::to_string(resource.desc.height) + " texels: at most " +
              std::to_string(kMaxImageSide) + " a side are possible");
    const uint32_t most = uint32_t(std::bit_width(std::max({resource.desc.width, resource.desc.height, 1u})));
    if (resource.desc.levels == 0 || resource.desc.levels > most) {
      mistake(" has " + std::to_string(resource.desc.levels) + " levels: 1 to " + std::to_string(most) + " are possible at its size");
      resource.desc.levels = 1;
    }
  } else {
    if (resource.size == 0) mistake(" has no size");
    if (resource.size > kMaxBufferBytes)
      mistake(" of " + std::to_string(resource.size) + " bytes: at most " + std::to_string(kMaxBufferBytes) + " are possible");
  }
  for (ImportState* state : {&resource.before, &resource.after}) {
    if (isUse(state->use)) continue;
    fail("import " + quoted(resource.name) + ": " + std::to_string(unsigned(state->use)) + " is no Use");
    state->use = Use::Nothing;
  }
  if (resource.imported) checkStates(resource);
  const uint32_t index = uint32_t(resources.size());
  for (resource.level = 0; resource.level < (resource.isImage ? resource.desc.levels : 1); ++resource.level) resources.push_back(resource);
  return {index, 0, epoch};
}

void GraphImpl::checkStates(const ResourceData& import) {
  const auto mistake = [&](const std::string& what) { fail("import " + quoted(import.name) + ": " + what); };
  if (import.after == Use::Unknown) mistake("Use::Unknown is no state to leave it in");
  for (const ImportState& state : {import.before, import.after}) {
    const UseRow row = useRow(state);
    const bool hasLayout = row.layout != VK_IMAGE_LAYOUT_UNDEFINED;
    if (state.isOwn) {
      if (import.isImage && !hasLayout) mistake("a state of the host's own needs the image's layout");
      if (!import.isImage && hasLayout) mistake("a buffer has no layout, and the host's own state names one");
      if (!row.stage && (row.read | row.write)) mistake("the host's own state has accesses, but no stages that they are made in");
      continue;
    }
    if (state.use != Use::Nothing && state.use != Use::Unknown && (import.isImage ? !hasLayout : needsImage(state.use)))
      mistake(std::string("Use::") + row.name + " is no use of " + (import.isImage ? "an image" : "a buffer"));
    else if (import.madeFor != 0 && (row.usage & ~import.madeFor) != 0)
      mistake(std::string("Use::") + row.name + " is a state of it, but it was created without " + usageName(row.usage));
  }
  if (import.after.isOwn && import.after.own.layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
    mistake("no image can be brought into the layout PREINITIALIZED");
}

bool GraphImpl::madeFor(uint32_t pass, const ResourceData& resource, Use use) {
  if (!resource.isImage || resource.madeFor == 0 || (useRow(use).usage & ~resource.madeFor) == 0) return true;
  fail("pass '" + std::string(names[passes[pass].name]) + "' uses import " + quoted(resource.name) + " with Use::" + useRow(use).name +
       ", but it was created without " + usageName(useRow(use).usage));
  return false;
}

ResourceData* GraphImpl::resolve(ResourceRef ref, bool isImage, uint32_t pass, const char* doing) {
  if (ref == kMistake) return nullptr;
  const std::string_view passName = names[passes[pass].name];
  const char* kind = isImage ? " an image" : " a buffer";
  if (ref.index == kNone) {
    fail("pass '" + std::string(passName) + "' " + doing + kind + " that was never made (an empty ref)");
    return nullptr;
  }
  if (ref.epoch != epoch || ref.index >= resources.size() || resources[ref.index].isImage != isImage) {
    fail("pass '" + std::string(passName) + "' " + doing + kind +
         " of another graph or of an earlier frame: refs do not outlive Graph::reset()");
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
  pass.targets.first = uint32_t(targets.size());
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
  compiled = prepared = false;
  assert(pass + 1 == passes.size() && "a pass declares its accesses inside its own set-up");
  accesses.push_back(access);
  ++passes[pass].accesses.count;
}

void GraphImpl::read(uint32_t index, ResourceRef ref, bool isImage, Use use) {
  ResourceData* resource = resolve(ref, isImage, index, "reads");
  if (!resource) return;
  const auto pass = [&] { return "pass '" + std::string(names[passes[index].name]) + "'"; };
  if (!isUse(use))
    return fail(pass() + " reads " + quoted(resource->name) + " with " + std::to_string(unsigned(use)) + ", which is no Use");
  if (outsideOnly(use) || writes(use) || (isImage ? useRow(use).layout == VK_IMAGE_LAYOUT_UNDEFINED : needsImage(use)))
    return fail(pass() + " reads " + quoted(resource->name) + " with Use::" + useRow(use).name + ", which is no way for a pass to read" +
                (isImage ? " an image" : ""));
  if (!resource->hasContent()) return fail(pass() + " reads " + quoted(resource->name) + ", which no pass has written");
  if (!madeFor(index, *resource, use)) return;
  const Range range = passes[index].accesses;
  for (uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Access& other = accesses[i];
    if (other.resource != ref.index) continue;
    if (other.write)
      return fail(pass() + " reads and writes " + quoted(resource->name) +
                  ": declare the write alone (it may read as well), or make two passes");
    if (other.use == use) return;
    if (isImage && useRow(other.use).layout != useRow(use).layout)
      return fail(pass() + " reads " + quoted(resource->name) + " with Use::" + useRow(other.use).name + " and Use::" + useRow(use).name +
                  ", which need different layouts: make two passes");
  }
  addAccess(index, {ref.index, ref.version, use, false, true});
}

ResourceRef GraphImpl::write(uint32_t index, ResourceRef ref, bool isImage, Use use, Load load) {
  ResourceData* resource = resolve(ref, isImage, index, "writes");
  if (!resource) return kMistake;
  const auto pass = [&] { return "pass '" + std::string(names[passes[index].name]) + "'"; };
  if (!isUse(use)) {
    fail(pass() + " writes " + quoted(resource->name) + " with " + std::to_string(unsigned(use)) + ", which is no Use");
    return kMistake;
  }
  if (outsideOnly(use) || !writes(use) || (isImage ? useRow(use).layout == VK_IMAGE_LAYOUT_UNDEFINED : needsImage(use))) {
    fail(pass() + " writes " + quoted(resource->name) + " with Use::" + useRow(use).name + ", which is no way for a pass to write" +
         (isImage ? " an image" : ""));
    return kMistake;
  }
  if (accessOf(index, ref.index)) {
    fail(pass() + " uses " + quoted(resource->name) +
         " twice, once to write: declare the write alone (it may read as well), or make two passes");
    return kMistake;
  }
  if (!madeFor(index, *resource, use)) return kMistake;
  const bool fresh = !resource->hasContent();
  if (fresh && use == Use::ComputeAtomic) {
    fail(pass() + " does atomics on " + quoted(resource->name) + ", whose content is undefined: fill it first");
    return kMistake;
  }
  if (load == Load::Clear && !isTarget(use)) {
    fail(pass() + " writes " + quoted(resource->name) + " with Use::" + useRow(use).name +
         " and Load::Clear: only what is drawn to is cleared so");
    return kMistake;
  }
  if (fresh && load == Load::Keep && isTarget(use)) {
    fail(pass() + " draws to " + quoted(resource->name) + " and keeps what is there, but no pass has written it: clear or discard it");
    return kMistake;
  }
  addAccess(index, {ref.index, ++resource->version, use, true, load == Load::Keep && !fresh});
  return {ref.index, resource->version, epoch};
}

void GraphImpl::addTarget(uint32_t index, ResourceRef ref, Load load, const VkClearValue& clear) {
  PassData& pass = passes[index];
  const ResourceData& image = resources[ref.index];
  const auto mistake = [&](const std::string& what) {
    fail("pass '" + std::string(names[pass.name]) + "' draws to " + quoted(image.name) + what);
  };
  const bool isDepth = hasDepth(image.desc.format);
  const Access& access = accesses.back();
  if (isDepth != (access.use == Use::DepthTarget))
    return mistake(std::string(" with Use::") + useRow(access.use).name + ", but its format " +
                   (isDepth ? "holds depth" : "holds no depth"));
  for (uint32_t t = pass.targets.first; t < targets.size(); ++t) {
    const ResourceData& other = resources[targets[t].resource];
    if (other.width() != image.width() || other.height() != image.height())
      return mistake(" and to " + quoted(other.name) + ", which is of another size");
    if (isDepth && hasDepth(other.desc.format)) return mistake(" and to " + quoted(other.name) + ": one depth target is possible");
  }
  if (pass.targets.count == kMaxTargets) return mistake(": more than eight targets");
  targets.push_back({ref.index, load, true, clear});
  ++pass.targets.count;
}

void Pass::read(BufferRef buffer, Use use) { graph_.read(index_, buffer, false, use); }
void Pass::read(ImageRef image, Use use) { graph_.read(index_, image, true, use); }
BufferRef Pass::write(BufferRef buffer, Use use, bool discard) {
  return {graph_.write(index_, buffer, false, use, discard ? Load::Discard : Load::Keep)};
}
ImageRef Pass::write(ImageRef image, Use use, Load load, const VkClearValue& clear) {
  const ImageRef written{graph_.write(index_, image, true, use, load)};
  if (written != kMistake && isTarget(use)) graph_.addTarget(index_, written, load, clear);
  return written;
}
void Pass::sideEffect() { graph_.passes[index_].root = true; }

Kernel Pass::noPipeline() {
  graph_.fail("pass '" + std::string(graph_.names[graph_.passes[index_].name]) + "' declares a kernel without a pipeline (null)");
  return {};
}

Kernel Pass::kernel(const ComputePipeline* pipeline, std::span<const ResourceRef> refs) {
  if (!pipeline) return noPipeline();
  return bound(*pipeline, refs);
}

Kernel Pass::kernel(const GraphicsPipeline* pipeline, std::span<const ResourceRef> refs) {
  if (!pipeline) return noPipeline();
  if (graph_.error) return {};
  std::span<const VkFormat> colors = pipeline->colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  bool fitting = true;
  const Range range = graph_.passes[index_].targets;
  for (uint32_t t = range.first; t < range.first + range.count; ++t) {
    const VkFormat format = graph_.resources[graph_.targets[t].resource].desc.format;
    if (hasDepth(format)) {
      depth = format;
    } else {
      fitting = fitting && !colors.empty() && colors.front() == format;
      colors = colors.subspan(colors.empty() ? 0 : 1);
    }
  }
  if (!fitting || !colors.empty() || depth != pipeline->depth) {
    graph_.fail("pass '" + std::string(graph_.names[graph_.passes[index_].name]) + "', shader '" + pipeline->shader +
                "': its pipeline was made for targets of other formats, or another number of them, than the pass draws to");
    return {};
  }
  return bound(*pipeline, refs);
}

Kernel Pass::bound(const Pipeline& pipeline, std::span<const ResourceRef> refs) {
  const std::string_view pass = graph_.names[graph_.passes[index_].name];
  const auto mistake = [&](std::string message) {
    graph_.fail("pass '" + std::string(pass) + "', shader '" + pipeline.shader + "': " + std::move(message));
    return Kernel{};
  };
  const std::vector<BindingKind>& kinds = pipeline.set->kinds;
  if (refs.size() != kinds.size())
    return mistake(std::to_string(refs.size()) + " resources were given for its " + std::to_string(kinds.size()) + " bindings");
  const uint32_t first = uint32_t(graph_.bindings.size());
  for (size_t i = 0; i < refs.size(); ++i) {
    if (refs[i] == kMistake) return {};
    bool declared = false, fitting = false;
    const Range range = graph_.passes[index_].accesses;
    for (uint32_t k = range.first; k < range.first + range.count && !fitting; ++k) {
      const Access& access = graph_.accesses[k];
      // A write may be bound by the ref that went in or by the one that came out.
      if (refs[i].epoch != graph_.epoch || access.resource != refs[i].index) continue;
      if (access.version != refs[i].version && !(access.write && access.version == refs[i].version + 1)) continue;
      declared = true;
      fitting =
          fits(kinds[i], graph_.resources[access.resource].isImage, access.use, pipeline.bindPoint == VK_PIPELINE_BIND_POINT_GRAPHICS);
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
  graph_.kernels.push_back({&pipeline, {first, uint32_t(refs.size())}, VK_NULL_HANDLE});
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
  resource.madeFor = import.usage;
  return {impl_->add(resource)};
}

ImageRef Graph::level(ImageRef image, uint32_t k) {
  GraphImpl& graph = *impl_;
  if (image == kMistake) return image;
  if (image.epoch != graph.epoch || image.index >= graph.resources.size() || !graph.resources[image.index].isImage) {
    graph.fail("a level of an image of another graph or of an earlier frame was asked for");
    return {kMistake};
  }
  const ResourceData& resource = graph.memoryOf(image.index);
  if (k >= resource.desc.levels) {
    graph.fail("level " + std::to_string(k) + " of image " + graph.quoted(resource.name) + " was asked for: it has " +
               std::to_string(resource.desc.levels));
    return {kMistake};
  }
  return {{image.index - graph.resources[image.index].level + k, 0, graph.epoch}};
}

void Graph::skipped(std::string_view name, std::string_view reason) { impl_->skips.push_back({impl_->names.intern(name), reason}); }

Ticket Graph::readback(BufferRef buffer) {
  GraphImpl& graph = *impl_;
  const bool append = !graph.passes.empty() && graph.passes.back().readback;  // read-backs in a row are one pass
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
void Graph::enableTimings(bool enabled) { impl_->timed = enabled; }

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
