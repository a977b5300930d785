#include "offline/device_list.hpp"

#include <gtest/gtest.h>

namespace rill::offline {
namespace {

ListedDevice listed(size_t index, VkPhysicalDeviceType type, std::string unusable = {}) {
  return {index, "card " + std::to_string(index), "driver 1.0", type, uint64_t{8192} << 20, std::move(unusable)};
}

TEST(DeviceList, DiscreteFirstIntegratedLateCpuLast) {
  std::vector<ListedDevice> devices{listed(0, VK_PHYSICAL_DEVICE_TYPE_CPU),         listed(1, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
                                    listed(2, VK_PHYSICAL_DEVICE_TYPE_OTHER),       listed(3, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
                                    listed(4, VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU), listed(5, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)};
  sortDevices(devices);
  std::vector<size_t> order;
  for (const ListedDevice& device : devices) order.push_back(device.index);
  EXPECT_EQ(order, (std::vector<size_t>{3, 5, 4, 2, 1, 0}));
}

TEST(DeviceList, TableGivesIndexKindMemoryAndReason) {
  const std::vector<ListedDevice> devices{listed(3, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
                                          listed(1, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, "no queue supports compute")};
  EXPECT_EQ(deviceTable(devices),
            "index  kind            memory  device\n"
            "    3  discrete     8,192 MiB  card 3, driver 1.0\n"
            "    1  integrated   8,192 MiB  card 1, driver 1.0\n"
            "       cannot be used: no queue supports compute\n");
}

}  // namespace
}  // namespace rill::offline
