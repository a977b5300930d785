#include "offline/device_list.hpp"

#include <algorithm>
#include <cstdio>

#include "core/words.hpp"
#include "offline/context_impl.hpp"

namespace rill::offline {

int deviceRank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 4;
    default:
      return 2;
  }
}

std::string_view deviceKind(VkPhysicalDeviceType type) {
  constexpr std::string_view kKinds[] = {"discrete", "virtual", "other", "integrated", "CPU"};
  return kKinds[deviceRank(type)];
}

void sortDevices(std::vector<ListedDevice>& devices) {
  std::ranges::sort(devices, {}, [](const ListedDevice& device) { return std::pair(deviceRank(device.type), device.index); });
}

Expected<std::vector<ListedDevice>> findDevices(const ContextDesc& desc) {
  ContextImpl impl;
  if (auto ok = impl.openLoader(); !ok) return ok.error();
  if (auto ok = impl.makeInstance(desc); !ok) return ok.error();
  const auto properties2 = reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(impl.get(impl.instance, "vkGetPhysicalDeviceProperties2"));
  const auto memory2 =
      reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(impl.get(impl.instance, "vkGetPhysicalDeviceMemoryProperties"));
  if (!properties2 || !memory2) return Error{ErrorKind::NoDevice, "the Vulkan instance lacks vkGetPhysicalDeviceProperties2"};
  const auto handles = impl.physicalDevices();
  if (!handles) return handles.error();
  std::vector<ListedDevice> devices;
  for (const VkPhysicalDevice handle : *handles) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
    properties2(handle, &properties);
    VkPhysicalDeviceMemoryProperties memory{};
    memory2(handle, &memory);
    ListedDevice listed;
    listed.index = devices.size();
    listed.name = properties.properties.deviceName;
    listed.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    listed.type = properties.properties.deviceType;
    for (uint32_t h = 0; h < memory.memoryHeapCount; ++h)
      if (memory.memoryHeaps[h].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
        listed.localBytes = std::max<uint64_t>(listed.localBytes, memory.memoryHeaps[h].size);
    if (auto able = impl.usable(handle, desc); !able) listed.unusable = able.error().message;
    devices.push_back(std::move(listed));
  }
  sortDevices(devices);
  return devices;
}

std::string deviceTable(std::span<const ListedDevice> devices) {
  std::string text = "index  kind            memory  device\n";
  for (const ListedDevice& device : devices) {
    char head[64];
    std::snprintf(head, sizeof head, "%5zu  %-10s %7s MiB  ", device.index, std::string(deviceKind(device.type)).c_str(),
                  grouped(device.localBytes >> 20).c_str());
    text += head + device.name + ", " + device.driver + "\n";
    if (!device.unusable.empty()) text += "       cannot be used: " + device.unusable + "\n";
  }
  return text;
}

}  // namespace rill::offline
