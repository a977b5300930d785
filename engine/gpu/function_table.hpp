#pragma once
// The Vulkan functions that Rill calls, as private tables. The library neither defines nor imports vk*
// symbols, so it works with hosts that use the loader's prototypes, volk or their own tables.
#include <string_view>

#include "rill/device.hpp"

#define RILL_INSTANCE_FUNCTIONS(X)      \
  X(EnumerateDeviceExtensionProperties) \
  X(GetDeviceProcAddr)                  \
  X(GetPhysicalDeviceFeatures2)         \
  X(GetPhysicalDeviceFormatProperties)  \
  X(GetPhysicalDeviceMemoryProperties)  \
  X(GetPhysicalDeviceMemoryProperties2) \
  X(GetPhysicalDeviceProperties2)       \
  X(GetPhysicalDeviceQueueFamilyProperties)

#define RILL_DEVICE_FUNCTIONS(X)      \
  X(AllocateDescriptorSets)           \
  X(AllocateMemory)                   \
  X(BindBufferMemory)                 \
  X(BindImageMemory)                  \
  X(CmdBeginRendering)                \
  X(CmdBindDescriptorSets)            \
  X(CmdBindPipeline)                  \
  X(CmdClearColorImage)               \
  X(CmdCopyBuffer)                    \
  X(CmdCopyBufferToImage)             \
  X(CmdCopyImage)                     \
  X(CmdCopyImageToBuffer)             \
  X(CmdDispatch)                      \
  X(CmdDispatchIndirect)              \
  X(CmdDraw)                          \
  X(CmdDrawIndirect)                  \
  X(CmdEndRendering)                  \
  X(CmdFillBuffer)                    \
  X(CmdPipelineBarrier2)              \
  X(CmdPushConstants)                 \
  X(CmdResetQueryPool)                \
  X(CmdSetScissor)                    \
  X(CmdSetViewport)                   \
  X(CmdUpdateBuffer)                  \
  X(CmdWriteTimestamp2)               \
  X(CreateBuffer)                     \
  X(CreateBufferView)                 \
  X(CreateComputePipelines)           \
  X(CreateDescriptorPool)             \
  X(CreateDescriptorSetLayout)        \
  X(CreateGraphicsPipelines)          \
  X(CreateImage)                      \
  X(CreateImageView)                  \
  X(CreatePipelineLayout)             \
  X(CreateQueryPool)                  \
  X(CreateShaderModule)               \
  X(DestroyBuffer)                    \
  X(DestroyBufferView)                \
  X(DestroyDescriptorPool)            \
  X(DestroyDescriptorSetLayout)       \
  X(DestroyImage)                     \
  X(DestroyImageView)                 \
  X(DestroyPipeline)                  \
  X(DestroyPipelineLayout)            \
  X(DestroyQueryPool)                 \
  X(DestroyShaderModule)              \
  X(FreeMemory)                       \
  X(GetBufferMemoryRequirements)      \
  X(GetDeviceImageMemoryRequirements) \
  X(GetQueryPoolResults)              \
  X(MapMemory)                        \
  X(ResetDescriptorPool)              \
  X(UpdateDescriptorSets)

namespace rill {

#define RILL_DECLARE(name) PFN_vk##name name = nullptr;
struct InstanceTable {
  RILL_INSTANCE_FUNCTIONS(RILL_DECLARE)
  /// Null on success, else the name of a function that the loader does not provide.
  const char* load(PFN_vkGetInstanceProcAddr get, VkInstance instance);
};
struct DeviceTable {
  RILL_DEVICE_FUNCTIONS(RILL_DECLARE)
  /// Null on success, else the name of a function that the driver does not provide.
  const char* load(PFN_vkGetDeviceProcAddr get, VkDevice device);
};
#undef RILL_DECLARE

/// Whether a device has the extension; false where the driver cannot say.
bool hasExtension(PFN_vkEnumerateDeviceExtensionProperties enumerate, VkPhysicalDevice device, std::string_view name);

}  // namespace rill
