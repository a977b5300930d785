#pragma once
// Pipelines for passes of a render graph, from SPIR-V that the host provides. The graph allocates their
// descriptor sets.
//
// The Device owns pipelines and caches them by description: the first call creates a pipeline, later calls
// with an equal description find it by a linear search, so keep the pointer. It is valid until ~Device.
//
//   const rill::BindingKind bindings[] = {rill::BindingKind::SampledImage, rill::BindingKind::StorageImage};
//   const uint32_t words[] = {0x07230203};  // and so on: SPIR-V, as glslangValidator --vn writes it
//   auto blur = rill::computePipeline(device, {.shader = "blur", .spirv = words, .bindings = bindings, .pushConstantBytes = 8});
//   if (!blur) return fail(blur.error().message);
#include <cstdint>
#include <span>
#include <string_view>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"

namespace rill {

/// The descriptor type of a binding. All bindings are in set 0, numbered 0, 1, 2 ... in the order given, one
/// descriptor each; Pass::kernel takes the resources in that order. There are no samplers.
enum class BindingKind : uint8_t {
  Storage,       ///< buffer { ... }
  Uniform,       ///< uniform block
  TexelFloat4,   ///< samplerBuffer over R32G32B32A32_SFLOAT
  TexelUint,     ///< usamplerBuffer over R32_UINT
  TexelUint2,    ///< usamplerBuffer over R32G32_UINT
  TexelUint4,    ///< usamplerBuffer over R32G32B32A32_UINT
  StorageImage,  ///< image2D with a format qualifier
  SampledImage   ///< texture2D or utexture2D, read by texelFetch
};

/// 32-bit specialization constants; element k has constant_id k. Floats are converted with std::bit_cast.
using SpecializationConstants = std::span<const uint32_t>;

/// A compute shader with entry point "main". See Commands::dispatch for how it computes its group index.
struct ComputePipelineDesc {
  std::string_view shader;               ///< name for messages; without `spirv`, the name of a built-in shader, which knows its bindings
  std::span<const uint32_t> spirv = {};  ///< SPIR-V module in the byte order of this machine; copied
  std::span<const BindingKind> bindings = {};
  uint32_t pushConstantBytes = 0;          ///< a multiple of 4, at most 128; every dispatch passes exactly this many
  SpecializationConstants constants = {};  ///< at most 32
  uint32_t requiredSubgroupSize = 0;       ///< requires full subgroups of this size; must divide local_size_x. 0: any
  bool fullSubgroups = false;  ///< of any size: no invocation is missing; local_size_x must be a multiple of DeviceInfo::maxSubgroupSize
};

struct ComputePipeline;

/// Creates the pipeline or finds it in the cache. Fails with Shader, naming the shader, if the SPIR-V is
/// invalid, the driver rejects it or a device limit is exceeded, such as that of workgroups; and with OutOfMemory.
RILL_API Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc);

/// Color blending.
enum class Blend : uint8_t {
  Replace,       ///< source
  Premultiplied  ///< source + (1 - source alpha) * destination
};

/// A graphics pipeline for dynamic rendering: no vertex input (shaders read storage buffers), no face
/// culling, dynamic viewport and scissor.
struct GraphicsPipelineDesc {
  std::string_view vertex = {}, fragment = {};  ///< as ComputePipelineDesc::shader; an empty fragment shader draws depth only
  std::span<const uint32_t> vertexSpirv = {}, fragmentSpirv = {};
  std::span<const BindingKind> bindings = {};  ///< visible to both stages
  uint32_t pushConstantBytes = 0;              ///< a multiple of 4, at most 128; visible to both stages
  SpecializationConstants constants = {};      ///< of both stages
  std::span<const VkFormat> colors = {};       ///< formats of the color targets, in the order that the pass declares them
  VkFormat depth = VK_FORMAT_UNDEFINED;        ///< format of the depth target; undefined: no depth target
  VkCompareOp depthCompare = VK_COMPARE_OP_ALWAYS;
  bool depthWrite = false;
  Blend blend = Blend::Replace;  ///< of all color targets
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
};

struct GraphicsPipeline;

/// As computePipeline(). Also fails with BadInput if a format cannot be a target, and with NoDevice if the
/// host's queue family has no graphics.
RILL_API Expected<const GraphicsPipeline*> graphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);

}  // namespace rill
