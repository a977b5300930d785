#include "gpu/vulkan_error.hpp"

#include <cstdio>

namespace rill {

std::string_view resultName(VkResult result) {
  switch (result) {
#define RILL_NAME(name) \
  case name:            \
    return #name;
    RILL_NAME(VK_SUCCESS)
    RILL_NAME(VK_NOT_READY)
    RILL_NAME(VK_TIMEOUT)
    RILL_NAME(VK_INCOMPLETE)
    RILL_NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
    RILL_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    RILL_NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
    RILL_NAME(VK_ERROR_FRAGMENTED_POOL)
    RILL_NAME(VK_ERROR_INITIALIZATION_FAILED)
    RILL_NAME(VK_ERROR_DEVICE_LOST)
    RILL_NAME(VK_ERROR_MEMORY_MAP_FAILED)
    RILL_NAME(VK_ERROR_LAYER_NOT_PRESENT)
    RILL_NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
    RILL_NAME(VK_ERROR_FEATURE_NOT_PRESENT)
    RILL_NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
    RILL_NAME(VK_ERROR_TOO_MANY_OBJECTS)
    RILL_NAME(VK_ERROR_INVALID_SHADER_NV)
#undef RILL_NAME
    default:
      return "an unexpected VkResult";
  }
}

Error vulkanError(VkResult result, std::string_view operation) {
  ErrorKind kind = ErrorKind::Failed;
  std::string_view what = "failed";
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      kind = ErrorKind::OutOfMemory, what = "out of host memory";
      break;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      kind = ErrorKind::OutOfMemory, what = "out of device memory";
      break;
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
      kind = ErrorKind::OutOfMemory, what = "out of descriptor memory";
      break;
    case VK_ERROR_TOO_MANY_OBJECTS:
      kind = ErrorKind::OutOfMemory, what = "too many device objects";
      break;
    case VK_ERROR_DEVICE_LOST:
      kind = ErrorKind::DeviceLost, what = "the device was lost";
      break;
    default:
      break;
  }
  std::string message(operation);
  message.append(": ").append(what).append(" (").append(resultName(result)).append(", ").append(std::to_string(result)).append(")");
  return {kind, std::move(message)};
}

std::string bytesText(uint64_t bytes) {
  char text[32];
  if (bytes >= 1024 * 1024)
    std::snprintf(text, sizeof text, "%.1f MiB", double(bytes) / (1024.0 * 1024.0));
  else
    std::snprintf(text, sizeof text, "%llu bytes", static_cast<unsigned long long>(bytes));
  return text;
}

}  // namespace rill
