#pragma once
// Pipelines for passes of a render graph, of shaders that a host brings as SPIR-V. The graph makes their descriptor sets.
//
// A pipeline belongs to the Device. It is made once, the first time that it is described, and found again from then on: asking every frame
// costs a search, so hosts keep the pointer. It stays valid until the Device ends, which destroys it; nobody else does.
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

/// How a shader sees a binding. Set 0 alone is used; bindings are numbered 0, 1, 2 ... in the order given, one descriptor each, and
/// Pass::kernel takes their resources in that order. There are no samplers.
enum class BindingKind : uint8_t {
  Storage,       ///< buffer { ... }
  Uniform,       ///< uniform block
  TexelFloat4,   ///< samplerBuffer over R32G32B32A32_SFLOAT
  TexelUint,     ///< usamplerBuffer over R32_UINT
  TexelUint4,    ///< usamplerBuffer over R32G32B32A32_UINT
  StorageImage,  ///< image2D, with its format in the shader
  SampledImage   ///< texture2D or utexture2D, read by texelFetch
};

/// One 32-bit specialization constant: id k is the k-th of the list; floats by std::bit_cast.
using SpecializationConstants = std::span<const uint32_t>;

/// One compute shader, of entry point "main". How many workgroups it gets, and how it finds its own among them: Commands::dispatch.
struct ComputePipelineDesc {
  std::string_view shader;               ///< what messages call it; where no `spirv` is given, the name of a shader of Rill's own
  std::span<const uint32_t> spirv = {};  ///< a SPIR-V module in the machine's byte order; copied
  std::span<const BindingKind> bindings = {};
  uint32_t pushConstantBytes = 0;          ///< a multiple of 4, at most 128; every dispatch gives as many
  SpecializationConstants constants = {};  ///< at most 32
  uint32_t requiredSubgroupSize = 0;       ///< subgroups are whole then: local_size_x is a multiple of it; 0: the driver's choice
};

struct ComputePipeline;

/// Makes the pipeline or finds it among those made before with an equal description. Shader, naming the shader, where what was given is no
/// SPIR-V, the driver refuses it, or more is asked for than the device has; OutOfMemory.
RILL_API Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc);

/// What a fragment does to the color that is there.
enum class Blend : uint8_t {
  Replace,       ///< replaces it
  Premultiplied  ///< color + (1 - alpha) times it
};

/// A vertex and a fragment shader for dynamic rendering: no vertex buffers (shaders read storage buffers), nothing culled by winding,
/// viewport and scissor dynamic.
struct GraphicsPipelineDesc {
  std::string_view vertex = {}, fragment = {};  ///< as ComputePipelineDesc::shader; without a fragment shader only depth is drawn
  std::span<const uint32_t> vertexSpirv = {}, fragmentSpirv = {};
  std::span<const BindingKind> bindings = {};  ///< seen by both
  uint32_t pushConstantBytes = 0;              ///< at most 128, seen by both
  SpecializationConstants constants = {};      ///< of both
  std::span<const VkFormat> colors = {};       ///< of the color targets, in the order that the pass declares them
  VkFormat depth = VK_FORMAT_UNDEFINED;        ///< of the depth target; undefined: none
  VkCompareOp depthCompare = VK_COMPARE_OP_ALWAYS;
  bool depthWrite = false;
  Blend blend = Blend::Replace;  ///< of all color targets
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
};

struct GraphicsPipeline;

/// As computePipeline(). BadInput for a format that cannot be drawn to, NoDevice where the host's queue cannot draw.
RILL_API Expected<const GraphicsPipeline*> graphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);

}  // namespace rill
