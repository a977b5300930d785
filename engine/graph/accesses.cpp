// What passes read, write and draw to. Refs and uses are checked where they are declared.
#include <cassert>

#include "graph/graph_impl.hpp"

namespace rill {

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

}  // namespace rill
