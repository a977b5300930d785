#pragma once
// Whether lanes of a subgroup that took different paths come together again: core SPIR-V guarantees it only for whole workgroups.
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

#ifndef VK_KHR_shader_maximal_reconvergence  // newer than the oldest headers that Rill builds with
#define VK_KHR_shader_maximal_reconvergence 1
#define VK_KHR_SHADER_MAXIMAL_RECONVERGENCE_EXTENSION_NAME "VK_KHR_shader_maximal_reconvergence"
inline constexpr auto VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_MAXIMAL_RECONVERGENCE_FEATURES_KHR = VkStructureType(1000434000);
struct VkPhysicalDeviceShaderMaximalReconvergenceFeaturesKHR {
  VkStructureType sType;
  void* pNext;
  VkBool32 shaderMaximalReconvergence;
};
#endif

namespace rill {

enum class Reconvergence {
  Workgroup,  ///< at the end of a construct that all invocations of the workgroup entered together
  Subgroup,   ///< likewise of the subgroup: VK_KHR_shader_subgroup_uniform_control_flow
  Maximal,    ///< of any invocations: VK_KHR_shader_maximal_reconvergence
};

/// The strongest guarantee among the enabled features.
Reconvergence reconvergenceOf(const VkPhysicalDeviceFeatures2& enabled);

/// The module with the execution mode for `wanted` on all entry points; unchanged for Workgroup.
std::vector<uint32_t> withReconvergence(std::span<const uint32_t> words, Reconvergence wanted);

}  // namespace rill
