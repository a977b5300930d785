#pragma once
// Pipelines for passes of a render graph, of shaders that a host brings as SPIR-V.
#include <cstdint>
#include <span>
#include <string_view>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"

namespace rill {

/// How a shader sees a binding. Set 0 alone is used; bindings are numbered 0, 1, 2 ... in the order given.
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

struct ComputePipelineDesc {
  std::string_view shader;  ///< name in the embedded library, e.g. "fluid/density"
  std::span<const BindingKind> bindings;
  uint32_t pushConstantBytes = 0;  ///< at most 128
  SpecializationConstants constants = {};
  uint32_t requiredSubgroupSize = 0;     ///< subgroups are whole then: local_size_x is a multiple of it; 0: the driver's choice
  std::span<const uint32_t> words = {};  ///< SPIR-V to use in place of the library's; `shader` then only names it
};

struct ComputePipeline;  // layout and handle; owned by the device, alive as long as it

/// Makes the pipeline or finds it among those made before with the same description. Shader, naming the shader, on failure.
RILL_API Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc);

/// What a fragment does to the colour that is there.
enum class Blend : uint8_t {
  None,          ///< replaces it
  Premultiplied  ///< colour + (1 - alpha) times it
};

/// A vertex and a fragment shader for dynamic rendering: no vertex buffers (shaders read storage buffers), nothing culled by winding,
/// viewport and scissor dynamic.
struct GraphicsPipelineDesc {
  std::string_view vertex, fragment;       ///< names in the embedded library, e.g. "render/scene_vertex"; fragment may be empty
  std::span<const BindingKind> bindings;   ///< seen by both
  uint32_t pushConstantBytes = 0;          ///< at most 128, seen by both
  SpecializationConstants constants = {};  ///< of both
  std::span<const VkFormat> colours = {};  ///< of the colour targets, in the order that the pass declares them
  VkFormat depth = VK_FORMAT_UNDEFINED;    ///< of the depth target; undefined: none
  VkCompareOp depthCompare = VK_COMPARE_OP_ALWAYS;
  bool depthWrite = false;
  Blend blend = Blend::None;  ///< of all colour targets
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  std::span<const uint32_t> vertexWords = {}, fragmentWords = {};  ///< SPIR-V to use in place of the library's
};

struct GraphicsPipeline;

/// As computePipeline(). Shader, naming the shaders, on failure.
RILL_API Expected<const GraphicsPipeline*> graphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);

}  // namespace rill
