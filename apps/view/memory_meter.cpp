#include "view/memory_meter.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace rill::view {

DeviceMemory deviceMemory(const VkPhysicalDeviceMemoryProperties& heaps, const VkPhysicalDeviceMemoryBudgetPropertiesEXT* budget) {
  DeviceMemory all;
  if (budget) all.used = all.budget = 0;
  for (uint32_t h = 0; h < heaps.memoryHeapCount; ++h) {
    if (!(heaps.memoryHeaps[h].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)) continue;
    all.size += heaps.memoryHeaps[h].size;
    if (!budget) continue;
    *all.used += budget->heapUsage[h];
    *all.budget += budget->heapBudget[h];
  }
  return all;
}

MemoryMeter::MemoryMeter(const offline::Context& context) : device_(context.physicalDevice()) {
  const auto function = [&](const char* name) { return context.getInstanceProcAddr()(context.instance(), name); };
  query_ = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties2>(function("vkGetPhysicalDeviceMemoryProperties2"));
  const auto list = reinterpret_cast<PFN_vkEnumerateDeviceExtensionProperties>(function("vkEnumerateDeviceExtensionProperties"));
  uint32_t count = 0;
  if (!list || list(device_, nullptr, &count, nullptr) != VK_SUCCESS) return;
  std::vector<VkExtensionProperties> extensions(count);
  if (list(device_, nullptr, &count, extensions.data()) != VK_SUCCESS) return;
  // A query of a physical device needs the extension there, but not enabled.
  reportsBudget_ = std::ranges::any_of(
      extensions, [](const VkExtensionProperties& e) { return std::string_view(e.extensionName) == VK_EXT_MEMORY_BUDGET_EXTENSION_NAME; });
}

const DeviceMemory& MemoryMeter::at(double now_s) {
  constexpr double kInterval = 0.5;  // s
  if (now_s < askAt_s_ || !query_) return last_;
  askAt_s_ = now_s + kInterval;
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
  VkPhysicalDeviceMemoryProperties2 memory{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2, reportsBudget_ ? &budget : nullptr};
  query_(device_, &memory);
  last_ = deviceMemory(memory.memoryProperties, reportsBudget_ ? &budget : nullptr);
  return last_;
}

}  // namespace rill::view
