#include "gpu/function_table.hpp"

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

}  // namespace rill
