#include "gpu/function_table.hpp"

#include <algorithm>
#include <vector>

namespace rill {

#define RILL_LOAD(name)                                          \
  name = reinterpret_cast<PFN_vk##name>(get(owner, "vk" #name)); \
  if (!name) return "vk" #name;

const char* InstanceTable::load(PFN_vkGetInstanceProcAddr get, VkInstance owner) {
  RILL_INSTANCE_FUNCTIONS(RILL_LOAD)
  return nullptr;
}

const char* DeviceTable::load(PFN_vkGetDeviceProcAddr get, VkDevice owner) {
  RILL_DEVICE_FUNCTIONS(RILL_LOAD)
  return nullptr;
}

bool hasExtension(PFN_vkEnumerateDeviceExtensionProperties enumerate, VkPhysicalDevice device, std::string_view name) {
  uint32_t count = 0;
  if (enumerate(device, nullptr, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> all(count);
  if (enumerate(device, nullptr, &count, all.data()) != VK_SUCCESS) return false;
  all.resize(count);
  return std::ranges::any_of(all, [&](const VkExtensionProperties& one) { return one.extensionName == name; });
}

}  // namespace rill
