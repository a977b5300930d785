#pragma once
// Pipelines and the device's cache of them. pipeline.cpp: layouts and cache; compute_pipeline.cpp and graphics_pipeline.cpp: the two
// kinds; pipeline_shaders.cpp: their shaders.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"
#include "gpu/shader_library.hpp"
#include "gpu/subgroups.hpp"

namespace rill {

inline constexpr size_t kMaxConstants = 64;  ///< of a pipeline

/// Pipelines with equal kinds share a layout, so that a frame's kernels can share descriptor sets.
struct SetLayout {
  std::vector<BindingKind> kinds;
  VkShaderStageFlags stages = 0;
  VkDescriptorSetLayout handle = VK_NULL_HANDLE;
};

VkDescriptorType descriptorType(BindingKind kind);
/// VK_FORMAT_UNDEFINED if `kind` is not a texel buffer.
VkFormat texelFormat(BindingKind kind);
/// Bytes per texel; 0 if `kind` is not a texel buffer.
uint32_t texelBytes(BindingKind kind);

struct Pipeline {
  std::string shader;  ///< name for messages; for graphics pipelines the vertex shader's
  const SetLayout* set = nullptr;
  std::vector<ShaderBinding> bindings;  ///< as reflected; empty for SPIR-V given by the caller
  uint32_t pushBytes = 0;
  std::vector<uint32_t> constants;
  std::vector<uint32_t> words;  ///< SPIR-V given by the caller; empty: an embedded shader
  VkPipelineBindPoint bindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;
  VkShaderStageFlags stages = VK_SHADER_STAGE_COMPUTE_BIT;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline handle = VK_NULL_HANDLE;  ///< changes when a shader is reloaded
};

struct ComputePipeline : Pipeline {
  SubgroupNeed subgroups;
};

struct GraphicsPipeline : Pipeline {
  std::string fragment;
  std::vector<uint32_t> fragmentWords;
  std::vector<VkFormat> colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkCompareOp depthCompare = VK_COMPARE_OP_ALWAYS;
  bool depthWrite = false;
  Blend blend = Blend::Replace;
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
};

class PipelineStore {
 public:
  Expected<const ComputePipeline*> find(DeviceImpl& device, const ComputePipelineDesc& desc);
  Expected<const GraphicsPipeline*> find(DeviceImpl& device, const GraphicsPipelineDesc& desc);
  /// Rebuilds every pipeline of `shader` from new SPIR-V; on failure the old pipeline is kept.
  Expected<void> replace(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words);
  size_t size() const { return pipelines_.size() + graphics_.size(); }
  void destroy(DeviceImpl& device);

 private:
  Expected<const SetLayout*> setLayout(DeviceImpl& device, std::span<const BindingKind> kinds, VkShaderStageFlags stages,
                                       std::string_view shader);
  /// Creates the layouts and stores the constants. Fails with Shader if a limit is exceeded.
  Expected<void> begin(DeviceImpl& device, Pipeline& pipeline, std::span<const BindingKind> bindings, uint32_t pushBytes,
                       SpecializationConstants constants);
  /// Stores a pipeline with the handle built for it, or destroys its layout if the build failed.
  template <class Made>
  Expected<const Made*> keep(DeviceImpl& device, std::vector<std::unique_ptr<Made>>& all, std::unique_ptr<Made> pipeline,
                             Expected<VkPipeline> handle) {
    if (!handle) {
      destroyLayout(device, *pipeline);
      return handle.error();
    }
    pipeline->handle = *handle;
    all.push_back(std::move(pipeline));
    return all.back().get();
  }
  static void destroyLayout(DeviceImpl& device, const Pipeline& pipeline);
  Expected<VkPipeline> build(DeviceImpl& device, const ComputePipeline& pipeline, std::span<const uint32_t> words);
  Expected<VkPipeline> build(DeviceImpl& device, const GraphicsPipeline& pipeline, std::span<const uint32_t> vertex,
                             std::span<const uint32_t> fragment);
  std::vector<std::unique_ptr<SetLayout>> layouts_;
  std::vector<std::unique_ptr<ComputePipeline>> pipelines_;
  std::vector<std::unique_ptr<GraphicsPipeline>> graphics_;
};

/// The embedded shader of that name, or null.
const EmbeddedShader* embeddedShader(const DeviceImpl& device, std::string_view name);
/// What the stages of a pipeline declare together. Fails with Shader if they disagree, or leave out a binding number.
struct Reflection {
  std::vector<ShaderBinding> bindings;
  std::vector<BindingKind> kinds;
  uint32_t pushConstantBytes = 0;

  /// Completes the description of a pipeline of embedded shaders. Fails with Shader if it gives bindings that the shaders do not have.
  template <class Desc>
  Expected<void> complete(Desc& desc, std::string_view shader) const;
};
Expected<Reflection> reflect(const DeviceImpl& device, std::initializer_list<std::string_view> shaders);
/// SPIR-V of an embedded shader, or its reloaded version; empty if there is no shader of that name.
std::span<const uint32_t> embeddedSpirv(const DeviceImpl& device, std::string_view name);
Error shaderError(std::string_view shader, std::string what);

template <class Desc>
Expected<void> Reflection::complete(Desc& desc, std::string_view shader) const {
  if (!desc.bindings.empty() && !std::ranges::equal(desc.bindings, kinds))
    return shaderError(shader, "the bindings given are not those of the embedded shader; expected none, or its " +
                                   std::to_string(kinds.size()) + " in their order");
  desc.bindings = kinds;
  desc.pushConstantBytes = pushConstantBytes;
  return {};
}

/// The caller's SPIR-V, or an embedded shader's if none was given. Fails with Shader if there is neither or
/// the SPIR-V header is invalid.
Expected<std::span<const uint32_t>> resolveSpirv(const DeviceImpl& device, std::string_view shader, std::span<const uint32_t> spirv);
/// A shader module, alive while a pipeline is created.
class ShaderModule {
 public:
  static Expected<ShaderModule> make(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words);
  ShaderModule(ShaderModule&& other) noexcept : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  ShaderModule& operator=(ShaderModule&&) = delete;
  ~ShaderModule();
  VkShaderModule handle() const { return handle_; }

 private:
  ShaderModule(DeviceImpl& device, VkShaderModule handle) : device_(device), handle_(handle) {}
  DeviceImpl& device_;
  VkShaderModule handle_;
};
/// Specialization constants numbered from 0, for one vkCreate*Pipelines call.
class Constants {
 public:
  explicit Constants(std::span<const uint32_t> values);
  const VkSpecializationInfo* info() const { return info_.mapEntryCount ? &info_ : nullptr; }

 private:
  std::array<VkSpecializationMapEntry, kMaxConstants> entries_;
  VkSpecializationInfo info_;
};
/// An error of vkCreate*Pipelines, with the shader's name.
Error pipelineError(VkResult result, std::string_view shader);

}  // namespace rill
