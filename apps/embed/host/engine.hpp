#pragma once
// A small engine that does not know Rill: a device, three frames in flight, images, buffers, an image file. It calls Vulkan
// through volk with HOST_VOLK, else through the loader. Errors are printed and end the program.
#ifdef HOST_VOLK
#include <volk.h>
#else
#include <vulkan/vulkan.h>
#endif

#include <cstdint>
#include <functional>

namespace host {

struct Image {
  VkImage handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0, height = 0;
};

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
  uint64_t size = 0;
};

struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  uint64_t number = 0;     ///< number of this frame, from 1
  uint64_t completed = 0;  ///< the last frame that the device has finished
};

class Engine {
 public:
  /// `features(instance, physicalDevice)` returns the chain for VkDeviceCreateInfo::pNext: the features that the game's modules need.
  explicit Engine(const std::function<const void*(VkInstance, VkPhysicalDevice)>& features);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  Frame begin();           ///< waits for a free command buffer (of three) and begins it
  void end(const Frame&);  ///< submits it
  void wait();             ///< for all submitted frames

  Image createImage(VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage);
  Buffer createBuffer(uint64_t size, VkBufferUsageFlags usage);  ///< mapped
  void destroy(Image& image);
  void destroy(Buffer& buffer);

  /// Records clears of both images, which end in the layouts COLOR_ATTACHMENT_OPTIMAL and DEPTH_STENCIL_ATTACHMENT_OPTIMAL.
  void clear(const Frame& frame, const Image& color, const VkClearColorValue& sky, const Image& depth, float farthest);
  /// Records a full barrier with a layout transition.
  void change(const Frame& frame, const Image& image, VkImageLayout from, VkImageLayout to);
  /// Writes an R8G8B8A8 image, which is in `layout`, to a PPM file. Waits for the device.
  void save(const Image& image, VkImageLayout layout, const char* file);

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;

 private:
  static constexpr uint32_t kFrames = 3;
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted);
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_[kFrames] = {};
  VkSemaphore timeline_ = VK_NULL_HANDLE;  ///< counts finished frames
  uint64_t submitted_ = 0;
};

[[noreturn]] void fail(const char* what);
void check(VkResult result, const char* what);

}  // namespace host
