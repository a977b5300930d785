#pragma once
// What a driver has compiled, kept in a file from one run of a program to the next.
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace rill::offline {

inline constexpr uint64_t kMaxPipelineCacheBytes = uint64_t{256} << 20;  ///< of a file; larger ones are neither read nor written

/// The file that holds the pipelines of a device and driver in `folder`.
std::filesystem::path pipelineCacheFile(const std::filesystem::path& folder, const VkPhysicalDeviceProperties& device);

/// The content of a file for this data: with its length and a checksum.
std::vector<std::byte> encodePipelineCache(std::span<const std::byte> data);
/// The data in the content of a file; empty if it is damaged, or another device or driver made it.
std::span<const std::byte> decodePipelineCache(std::span<const std::byte> content, const VkPhysicalDeviceProperties& device);

/// A VkPipelineCache that starts with what a file in a folder has. No failure is an error: without the file all is compiled anew.
class PipelineCache {
 public:
  struct Functions {
    PFN_vkCreatePipelineCache create = nullptr;
    PFN_vkDestroyPipelineCache destroy = nullptr;
    PFN_vkGetPipelineCacheData data = nullptr;
  };
  /// `folder` is made when there is something to save.
  PipelineCache(const std::filesystem::path& folder, const VkPhysicalDeviceProperties& properties, VkDevice device,
                const Functions& functions);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache handle() const { return handle_; }
  /// Replaces the file, at once for its readers, if anything was added to what it had.
  void save() noexcept;

 private:
  void saveNew();

  std::filesystem::path file_;
  VkDevice device_;
  Functions functions_;
  VkPipelineCache handle_ = VK_NULL_HANDLE;
  std::vector<std::byte> saved_;
};

}  // namespace rill::offline
