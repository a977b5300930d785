#pragma once
// The Vulkan devices of this machine, for a user to choose from.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "offline/context.hpp"

namespace rill::offline {

struct ListedDevice {
  size_t index = 0;  ///< which ContextDesc::device takes
  std::string name, driver;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  uint64_t localBytes = 0;  ///< of its largest device-local heap
  std::string unusable;     ///< why Context::create would refuse it; empty: it would not
};

/// Those of an instance as `desc` describes it. Discrete ones first, integrated ones last but for CPUs; by index where they are of one
/// kind. NoDevice without a Vulkan loader or driver; no device is an empty list.
Expected<std::vector<ListedDevice>> findDevices(const ContextDesc& desc = {});

/// Sort key: lower ranks are listed first, and preferred where ContextDesc::device is empty.
int deviceRank(VkPhysicalDeviceType type);
/// Sorts as findDevices() does.
void sortDevices(std::vector<ListedDevice>& devices);

/// "discrete", "virtual", "other", "integrated" or "CPU".
std::string_view deviceKind(VkPhysicalDeviceType type);

/// A line with index, kind, memory, name and driver for each, and one with the reason where it is unusable.
std::string deviceTable(std::span<const ListedDevice> devices);

}  // namespace rill::offline
