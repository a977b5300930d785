#pragma once
// Stands between Rill and Vulkan: what was looked up, what was made and destroyed and with what. One at a time in a program, since
// Vulkan's functions cannot carry a pointer to it; several threads may call through it.
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "rill/device.hpp"

namespace rill::test {

class Watch {
 public:
  struct Call {
    std::string name;  ///< "vkCreateBuffer"
    bool makes = false;
    const VkAllocationCallbacks* callbacks = nullptr;
    VkPipelineCache cache = VK_NULL_HANDLE;  ///< of pipelines
    std::string during;                      ///< what the guest was doing
  };

  Watch();
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// To be lent in place of the loader's.
  static PFN_vkGetInstanceProcAddr getInstanceProcAddr();

  std::set<std::string> lookedUp();
  std::vector<Call> calls();  ///< that made or destroyed something
  /// Calls of vkCreate* and vkAllocateMemory whose names do not hold `but`.
  size_t made(std::string_view but = "nothing is named so");
  /// Made and not destroyed, by what they are: "Buffer".
  std::map<std::string, int64_t> alive();
  void forget();  ///< the calls so far, not what is alive

  std::atomic<const char*> doing = "";  ///< which of Rill's calls the guest is in
  /// The feature that the physical device is to seem to lack.
  VkBool32 VkPhysicalDeviceVulkan13Features::*lacks = nullptr;
  // What else it is to seem to lack.
  VkSubgroupFeatureFlags lacksSubgroups = 0;
  uint32_t lanes = 0;  ///< that a subgroup seems to have; 0: as many as it has
  VkFormat lacksTexels = VK_FORMAT_UNDEFINED;
  VkQueueFlags lacksQueues = 0;

  // What the functions in between tell.
  void look(const char* name);
  void call(const Call& call, const char* kind, int64_t count);

 private:
  std::mutex mutex_;
  std::set<std::string> lookedUp_;
  std::vector<Call> calls_;
  std::map<std::string, int64_t> alive_;
};

}  // namespace rill::test
