#pragma once
// What a compute pipeline is made of, and the device's store of them.
#include <memory>
#include <string>
#include <vector>

#include "gpu/resources.hpp"

namespace rill {

/// Pipelines with equal kinds share a layout, so that a frame's kernels can share descriptor sets.
struct SetLayout {
  std::vector<BindingKind> kinds;
  VkDescriptorSetLayout handle = VK_NULL_HANDLE;
};

VkDescriptorType descriptorType(BindingKind kind);
/// VK_FORMAT_UNDEFINED for what is not a texel buffer.
VkFormat texelFormat(BindingKind kind);
/// Bytes of a texel; 0 for what is not a texel buffer.
uint32_t texelBytes(BindingKind kind);

struct ComputePipeline {
  std::string shader;
  const SetLayout* set = nullptr;
  uint32_t pushBytes = 0;
  std::vector<uint32_t> constants;
  std::vector<uint32_t> words;  ///< SPIR-V of a caller's own; empty: the embedded library's
  uint32_t requiredSubgroupSize = 0;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline handle = VK_NULL_HANDLE;  ///< changes when a shader is reloaded
};

class PipelineStore {
 public:
  Expected<const ComputePipeline*> find(DeviceImpl& device, const ComputePipelineDesc& desc);
  /// Makes every pipeline of `shader` from new SPIR-V; the old one is kept where that fails.
  Expected<void> replace(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words);
  size_t size() const { return pipelines_.size(); }
  void destroy(DeviceImpl& device);

 private:
  Expected<const SetLayout*> setLayout(DeviceImpl& device, std::span<const BindingKind> kinds, std::string_view shader);
  Expected<VkPipeline> build(DeviceImpl& device, const ComputePipeline& pipeline, std::span<const uint32_t> words);
  std::vector<std::unique_ptr<SetLayout>> layouts_;
  std::vector<std::unique_ptr<ComputePipeline>> pipelines_;
};

}  // namespace rill
