#include "view/memory_meter.hpp"

#include <gtest/gtest.h>

namespace rill::view {
namespace {

constexpr uint64_t kMiB = 1 << 20;

TEST(MemoryMeter, AddsDeviceLocalHeapsUp) {
  VkPhysicalDeviceMemoryProperties heaps{};
  heaps.memoryHeapCount = 3;
  heaps.memoryHeaps[0] = {8192 * kMiB, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  heaps.memoryHeaps[1] = {32768 * kMiB, 0};
  heaps.memoryHeaps[2] = {256 * kMiB, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
  for (const auto& [heap, used, granted] : {std::tuple{0, 100, 7000}, {1, 5000, 20000}, {2, 20, 200}}) {
    budget.heapUsage[heap] = used * kMiB;
    budget.heapBudget[heap] = granted * kMiB;
  }
  const DeviceMemory all = deviceMemory(heaps, &budget);
  EXPECT_EQ(all.size, 8448 * kMiB);
  EXPECT_EQ(all.used, 120 * kMiB);
  EXPECT_EQ(all.budget, 7200 * kMiB);
}

TEST(MemoryMeter, KnowsSizeAloneWithoutTheExtension) {
  VkPhysicalDeviceMemoryProperties heaps{};
  heaps.memoryHeapCount = 1;
  heaps.memoryHeaps[0] = {2048 * kMiB, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  const DeviceMemory all = deviceMemory(heaps, nullptr);
  EXPECT_EQ(all.size, 2048 * kMiB);
  EXPECT_FALSE(all.used || all.budget);
}

}  // namespace
}  // namespace rill::view
