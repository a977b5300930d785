#pragma once
// Intercepts Rill's Vulkan calls: records lookups and the creation and destruction of objects. One instance
// at a time, since Vulkan functions carry no user pointer. Thread safe.
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "rill/device.hpp"

namespace rill::test {

class Interceptor {
 public:
  struct Call {
    std::string name;  ///< "vkCreateBuffer"
    bool makes = false;
    const VkAllocationCallbacks* callbacks = nullptr;
    VkPipelineCache cache = VK_NULL_HANDLE;  ///< of pipelines
    std::string during;                      ///< `currentCall` at that time
  };

  Interceptor();
  ~Interceptor();
  Interceptor(const Interceptor&) = delete;
  Interceptor& operator=(const Interceptor&) = delete;

  /// Replaces the loader's vkGetInstanceProcAddr.
  static PFN_vkGetInstanceProcAddr getInstanceProcAddr();

  std::set<std::string> lookedUp();
  std::vector<Call> calls();  ///< calls that created or destroyed an object
  /// The number of vkCreate* and vkAllocateMemory calls whose names do not contain `but`.
  size_t createCount(std::string_view but = "nothing is named so");
  /// The number of live objects by type, such as "Buffer".
  std::map<std::string, int64_t> liveObjects();
  void clearCalls();  ///< clears calls(), not liveObjects()

  std::atomic<const char*> currentCall = "";  ///< the Rill call that the client is in
  /// A feature that the physical device reports as unsupported.
  VkBool32 VkPhysicalDeviceVulkan13Features::*missingFeature = nullptr;
  // Other capabilities to report as unsupported.
  VkSubgroupFeatureFlags missingSubgroupOperations = 0;
  uint32_t subgroupSize = 0;  ///< reported subgroup size; 0: the real one
  VkFormat missingTexelFormat = VK_FORMAT_UNDEFINED;
  VkQueueFlags missingQueueFlags = 0;

  // Called by the intercepted functions.
  void onLookup(const char* name);
  void onCall(const Call& call, const char* kind, int64_t count);

 private:
  std::mutex mutex_;
  std::set<std::string> lookedUp_;
  std::vector<Call> calls_;
  std::map<std::string, int64_t> liveObjects_;
};

}  // namespace rill::test
