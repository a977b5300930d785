#pragma once
// Device memory and pipelines, owned by the engine's modules and retired by the host's frame clock.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rill/device.hpp"

namespace rill {

enum class MemoryKind : uint8_t {
  Device,   ///< device-local
  Upload,   ///< mapped, written by the host
  Readback  ///< mapped, cached where there is such memory, read by the host
};

/// A buffer with memory of its own. Moving is cheap; the destructor hands the handles to the device, which frees them
/// when the frame that was recording then has completed. Usable as storage, texel, uniform, indirect and copy source or target.
class Buffer {
 public:
  Buffer() = default;
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  VkBuffer handle() const { return handle_; }
  uint64_t size() const { return size_; }        ///< bytes asked for
  std::byte* mapped() const { return mapped_; }  ///< null for MemoryKind::Device; host-coherent
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  friend class DeviceImpl;
  DeviceImpl* device_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
  uint64_t size_ = 0;
};

/// `size` bytes (1 .. 128 MiB; larger or 0 is BadInput), content undefined. OutOfMemory names `name` and the size.
Expected<Buffer> createBuffer(Device& device, std::string_view name, uint64_t size, MemoryKind kind = MemoryKind::Device);

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
Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc);

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
Expected<const GraphicsPipeline*> graphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);

/// How many pipelines the device holds (a test bounds it).
size_t pipelineCount(const Device& device);

}  // namespace rill
