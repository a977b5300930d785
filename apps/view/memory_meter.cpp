#include "view/memory_meter.hpp"

#include "gpu/device_impl.hpp"

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

MemoryMeter::MemoryMeter(const offline::Context& context) : device_(&implOf(context.device())) {}

const DeviceMemory& MemoryMeter::at(double now_s) {
  constexpr double kInterval = 0.5;  // s
  if (now_s < askAt_s_) return last_;
  askAt_s_ = now_s + kInterval;
  const bool hasBudget = device_->hasMemoryBudget;
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
  VkPhysicalDeviceMemoryProperties2 memory{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2, hasBudget ? &budget : nullptr};
  device_->instance.GetPhysicalDeviceMemoryProperties2(device_->physical, &memory);
  last_ = deviceMemory(memory.memoryProperties, hasBudget ? &budget : nullptr);
  return last_;
}

}  // namespace rill::view
