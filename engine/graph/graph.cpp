// Declaration of a frame. Refs are checked here; compile() reports the first error.
#include "rill/graph.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

/// Unique over all graphs, so that refs of other graphs are detected like refs of earlier frames.
uint32_t nextEpoch() {
  static std::atomic<uint32_t> epoch{0};
  return ++epoch;
}

/// Whether a resource declared with this use can be bound as this kind.
bool kindMatchesUse(BindingKind kind, bool isImage, Use use, bool draws) {
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
    case BindingKind::TexelUint2:
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

constexpr uint32_t kMaxImageSide = 32768;  // above any device limit, and sizes in bytes still fit in 64 bits

constexpr ResourceRef kInvalidRef{0, 0, 0};  ///< returned by a write whose error has been reported; causes no further errors

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

ResourceRef GraphImpl::add(ResourceData resource) {
  compiled = prepared = false;
  const std::string_view kind = resource.kind();
  const auto reject = [&](std::string_view what) { fail(std::string(kind) + quoted(resource.name) + std::string(what)); };
  if (resource.isImage) {
    if (resource.desc.format == VK_FORMAT_UNDEFINED) reject(" has no format");
    if (resource.desc.format == VK_FORMAT_S8_UINT) reject(": stencil-only formats are not supported");
    if (resource.desc.width == 0 || resource.desc.height == 0) reject(": size is 0");
    if (std::max(resource.desc.width, resource.desc.height) > kMaxImageSide)
      reject(" of " + std::to_string(resource.desc.width) + " x " + std::to_string(resource.desc.height) + " texels; expected at most " +
             std::to_string(kMaxImageSide) + " per side");
    const uint32_t maxLevels = uint32_t(std::bit_width(std::max({resource.desc.width, resource.desc.height, 1u})));
    if (resource.desc.levels == 0 || resource.desc.levels > maxLevels) {
      reject(" has " + std::to_string(resource.desc.levels) + " levels; expected 1 to " + std::to_string(maxLevels));
      resource.desc.levels = 1;
    }
  } else {
    if (resource.size == 0) reject(": size is 0");
    if (resource.size > kMaxBufferBytes)
      reject(" of " + std::to_string(resource.size) + " bytes; expected at most " + std::to_string(kMaxBufferBytes));
  }
  for (ImportState* state : {&resource.before, &resource.after}) {
    if (isUse(state->use)) continue;
    fail("import " + quoted(resource.name) + ": invalid Use value " + std::to_string(unsigned(state->use)));
    state->use = Use::Nothing;
  }
  if (resource.imported) checkStates(resource);
  const uint32_t index = uint32_t(resources.size());
  for (resource.level = 0; resource.level < (resource.isImage ? resource.desc.levels : 1); ++resource.level) resources.push_back(resource);
  return {index, 0, epoch};
}

void GraphImpl::checkStates(const ResourceData& import) {
  const auto reject = [&](const std::string& what) { fail("import " + quoted(import.name) + ": " + what); };
  if (import.after == Use::Unknown) reject("Use::Unknown is not a valid final state");
  for (const ImportState& state : {import.before, import.after}) {
    const UseRow row = useRow(state);
    const bool hasLayout = row.layout != VK_IMAGE_LAYOUT_UNDEFINED;
    if (state.isCustom) {
      if (import.isImage && !hasLayout) reject("a custom state of an image needs a layout");
      if (!import.isImage && hasLayout) reject("a custom state of a buffer must not have a layout");
      if (!row.stage && (row.read | row.write)) reject("the custom state has accesses but no stages");
      continue;
    }
    if (state.use != Use::Nothing && state.use != Use::Unknown && (import.isImage ? !hasLayout : isImageOnly(state.use)))
      reject(std::string("Use::") + row.name + " is not a use of " + (import.isImage ? "an image" : "a buffer"));
    else if (import.createdUsage != 0 && (row.usage & ~import.createdUsage) != 0)
      reject(std::string("Use::") + row.name + " is one of its states, but it was created without " + usageName(row.usage));
  }
  if (import.after.isCustom && import.after.custom.layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
    reject("VK_IMAGE_LAYOUT_PREINITIALIZED is not a valid final layout");
}

bool GraphImpl::checkUsage(uint32_t pass, const ResourceData& resource, Use use) {
  if (!resource.isImage || resource.createdUsage == 0 || (useRow(use).usage & ~resource.createdUsage) == 0) return true;
  fail("pass '" + std::string(names[passes[pass].name]) + "' uses import " + quoted(resource.name) + " with Use::" + useRow(use).name +
       ", but it was created without " + usageName(useRow(use).usage));
  return false;
}

ResourceData* GraphImpl::resolve(ResourceRef ref, bool isImage, uint32_t pass, const char* verb) {
  if (ref == kInvalidRef) return nullptr;
  const std::string_view passName = names[passes[pass].name];
  const char* kind = isImage ? " an image" : " a buffer";
  if (ref.index == kNone) {
    fail("pass '" + std::string(passName) + "' " + verb + kind + " through an empty ref");
    return nullptr;
  }
  if (ref.epoch != epoch || ref.index >= resources.size() || resources[ref.index].isImage != isImage) {
    fail("pass '" + std::string(passName) + "' " + verb + kind +
         " through a ref of another graph or an earlier frame; refs are valid until Graph::reset()");
    return nullptr;
  }
  ResourceData& resource = resources[ref.index];
  if (ref.version != resource.version) {
    fail("pass '" + std::string(passName) + "' " + verb + " version " + std::to_string(ref.version) + " of " + quoted(resource.name) +
         ", which a later write consumed; expected version " + std::to_string(resource.version));
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
  assert(pass + 1 == passes.size() && "accesses must be declared during the pass's own setup");
  accesses.push_back(access);
  ++passes[pass].accesses.count;
}

void GraphImpl::read(uint32_t index, ResourceRef ref, bool isImage, Use use) {
  ResourceData* resource = resolve(ref, isImage, index, "reads");
  if (!resource) return;
  const auto pass = [&] { return "pass '" + std::string(names[passes[index].name]) + "'"; };
  if (!isUse(use)) return fail(pass() + " reads " + quoted(resource->name) + " with invalid Use value " + std::to_string(unsigned(use)));
  if (isImportOnly(use) || writes(use) || (isImage ? useRow(use).layout == VK_IMAGE_LAYOUT_UNDEFINED : isImageOnly(use)))
    return fail(pass() + " reads " + quoted(resource->name) + " with Use::" + useRow(use).name + ", which is not a read use" +
                (isImage ? " an image" : ""));
  if (!resource->hasContent())
    return fail(pass() + " reads " + quoted(resource->name) + ", whose content is undefined; write it in an earlier pass");
  if (!checkUsage(index, *resource, use)) return;
  const Range range = passes[index].accesses;
  for (uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Access& other = accesses[i];
    if (other.resource != ref.index) continue;
    if (other.write)
      return fail(pass() + " reads and writes " + quoted(resource->name) +
                  "; declare only the write (it may read as well), or use two passes");
    if (other.use == use) return;
    if (isImage && useRow(other.use).layout != useRow(use).layout)
      return fail(pass() + " reads " + quoted(resource->name) + " with Use::" + useRow(other.use).name + " and Use::" + useRow(use).name +
                  ", which need different layouts; use two passes");
  }
  addAccess(index, {ref.index, ref.version, use, false, true});
}

ResourceRef GraphImpl::write(uint32_t index, ResourceRef ref, bool isImage, Use use, Load load) {
  ResourceData* resource = resolve(ref, isImage, index, "writes");
  if (!resource) return kInvalidRef;
  const auto pass = [&] { return "pass '" + std::string(names[passes[index].name]) + "'"; };
  if (!isUse(use)) {
    fail(pass() + " writes " + quoted(resource->name) + " with invalid Use value " + std::to_string(unsigned(use)));
    return kInvalidRef;
  }
  if (isImportOnly(use) || !writes(use) || (isImage ? useRow(use).layout == VK_IMAGE_LAYOUT_UNDEFINED : isImageOnly(use))) {
    fail(pass() + " writes " + quoted(resource->name) + " with Use::" + useRow(use).name + ", which is not a write use" +
         (isImage ? " an image" : ""));
    return kInvalidRef;
  }
  if (accessOf(index, ref.index)) {
    fail(pass() + " uses " + quoted(resource->name) +
         " more than once, including a write; declare only the write (it may read as well), or use two passes");
    return kInvalidRef;
  }
  if (!checkUsage(index, *resource, use)) return kInvalidRef;
  const bool fresh = !resource->hasContent();
  if (fresh && use == Use::ComputeAtomic) {
    fail(pass() + " uses atomics on " + quoted(resource->name) + ", whose content is undefined; fill it first");
    return kInvalidRef;
  }
  if (load == Load::Clear && !isTarget(use)) {
    fail(pass() + " writes " + quoted(resource->name) + " with Use::" + useRow(use).name + " and Load::Clear; only targets can be cleared");
    return kInvalidRef;
  }
  if (fresh && load == Load::Keep && isTarget(use)) {
    fail(pass() + " draws to " + quoted(resource->name) +
         " with Load::Keep, but its content is undefined; use Load::Clear or Load::Discard");
    return kInvalidRef;
  }
  addAccess(index, {ref.index, ++resource->version, use, true, load == Load::Keep && !fresh});
  return {ref.index, resource->version, epoch};
}

void GraphImpl::addTarget(uint32_t index, ResourceRef ref, Load load, const VkClearValue& clear) {
  PassData& pass = passes[index];
  const ResourceData& image = resources[ref.index];
  const auto reject = [&](const std::string& what) {
    fail("pass '" + std::string(names[pass.name]) + "' draws to " + quoted(image.name) + what);
  };
  const bool isDepth = hasDepth(image.desc.format);
  const Access& access = accesses.back();
  if (isDepth != (access.use == Use::DepthTarget))
    return reject(std::string(" with Use::") + useRow(access.use).name + ", but its format " +
                  (isDepth ? "is a depth format" : "has no depth aspect"));
  for (uint32_t t = pass.targets.first; t < targets.size(); ++t) {
    const ResourceData& other = resources[targets[t].resource];
    if (other.width() != image.width() || other.height() != image.height())
      return reject(" and to " + quoted(other.name) + ", which has a different size");
    if (isDepth && hasDepth(other.desc.format)) return reject(" and to " + quoted(other.name) + ": a pass has at most one depth target");
  }
  if (pass.targets.count == kMaxTargets) return reject(": more than 8 targets");
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
  if (written != kInvalidRef && isTarget(use)) graph_.addTarget(index_, written, load, clear);
  return written;
}
void Pass::sideEffect() { graph_.passes[index_].root = true; }

Kernel Pass::missingPipeline() {
  graph_.fail("pass '" + std::string(graph_.names[graph_.passes[index_].name]) + "' declares a kernel with a null pipeline");
  return {};
}

Kernel Pass::kernel(const ComputePipeline* pipeline, std::span<const ResourceRef> refs) {
  if (!pipeline) return missingPipeline();
  return bindKernel(*pipeline, refs);
}

Kernel Pass::kernel(const GraphicsPipeline* pipeline, std::span<const ResourceRef> refs) {
  if (!pipeline) return missingPipeline();
  if (graph_.error) return {};
  std::span<const VkFormat> colors = pipeline->colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  bool matches = true;
  const Range range = graph_.passes[index_].targets;
  for (uint32_t t = range.first; t < range.first + range.count; ++t) {
    const VkFormat format = graph_.resources[graph_.targets[t].resource].desc.format;
    if (hasDepth(format)) {
      depth = format;
    } else {
      matches = matches && !colors.empty() && colors.front() == format;
      colors = colors.subspan(colors.empty() ? 0 : 1);
    }
  }
  if (!matches || !colors.empty() || depth != pipeline->depth) {
    graph_.fail("pass '" + std::string(graph_.names[graph_.passes[index_].name]) + "', shader '" + pipeline->shader +
                "': its target formats differ from the targets of the pass");
    return {};
  }
  return bindKernel(*pipeline, refs);
}

Kernel Pass::bindKernel(const Pipeline& pipeline, std::span<const ResourceRef> refs) {
  const std::string_view pass = graph_.names[graph_.passes[index_].name];
  const auto reject = [&](std::string message) {
    graph_.fail("pass '" + std::string(pass) + "', shader '" + pipeline.shader + "': " + std::move(message));
    return Kernel{};
  };
  const std::vector<BindingKind>& kinds = pipeline.set->kinds;
  if (refs.size() != kinds.size()) return reject(std::to_string(refs.size()) + " resources; expected " + std::to_string(kinds.size()));
  const uint32_t first = uint32_t(graph_.bindings.size());
  for (size_t i = 0; i < refs.size(); ++i) {
    if (refs[i] == kInvalidRef) return {};
    bool declared = false, matches = false;
    const Range range = graph_.passes[index_].accesses;
    for (uint32_t k = range.first; k < range.first + range.count && !matches; ++k) {
      const Access& access = graph_.accesses[k];
      // A written resource may be bound through the consumed ref or the returned one.
      if (refs[i].epoch != graph_.epoch || access.resource != refs[i].index) continue;
      if (access.version != refs[i].version && !(access.write && access.version == refs[i].version + 1)) continue;
      declared = true;
      matches = kindMatchesUse(kinds[i], graph_.resources[access.resource].isImage, access.use,
                               pipeline.bindPoint == VK_PIPELINE_BIND_POINT_GRAPHICS);
    }
    const auto name = [&] {
      return refs[i].index < graph_.resources.size() ? graph_.quoted(graph_.resources[refs[i].index].name) : "an empty ref";
    };
    if (!declared) return reject("binding " + std::to_string(i) + " is " + name() + " in a version that the pass does not declare");
    if (!matches)
      return reject("binding " + std::to_string(i) + " is " + kindName(kinds[i]) + ", which matches no declared use of " + name());
    graph_.bindings.push_back(refs[i].index);
  }
  graph_.kernels.push_back({&pipeline, {first, uint32_t(refs.size())}, VK_NULL_HANDLE});
  ++graph_.passes[index_].kernels.count;
  return {uint32_t(graph_.kernels.size() - 1)};
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
