// Kernels of passes. Bindings and targets are checked against the accesses that the pass declares.
#include "graph/graph_impl.hpp"

namespace rill {
namespace {

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
      return use == (draws ? Use::DrawTexel : Use::ComputeTexel);
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

}  // namespace

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

}  // namespace rill
