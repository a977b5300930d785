#pragma once
// How much device memory the program uses, and how much it may.
#include <optional>

#include "offline/context.hpp"

namespace rill::view {

/// Of the device-local heaps together, bytes.
struct DeviceMemory {
  uint64_t size = 0;               ///< of the heaps
  std::optional<uint64_t> used;    ///< by this program; none without VK_EXT_memory_budget
  std::optional<uint64_t> budget;  ///< that the driver grants this program now, with what it uses; likewise
};

/// `budget`: null without the extension.
DeviceMemory deviceMemory(const VkPhysicalDeviceMemoryProperties& heaps, const VkPhysicalDeviceMemoryBudgetPropertiesEXT* budget);

/// Asks the driver at most twice a second.
class MemoryMeter {
 public:
  /// The context outlives it.
  explicit MemoryMeter(const offline::Context& context);
  /// `now_s`: real time.
  const DeviceMemory& at(double now_s);

 private:
  const DeviceImpl* device_;
  double askAt_s_ = 0;
  DeviceMemory last_;
};

}  // namespace rill::view
