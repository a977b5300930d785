#pragma once
// Converts a VkResult to an Error that names the failed operation.
#include <cstdint>
#include <string>
#include <string_view>

#include "rill/device.hpp"
#include "rill/expected.hpp"

namespace rill {

std::string_view resultName(VkResult result);

/// "allocating 12.0 MiB for 'positions': out of device memory (VK_ERROR_OUT_OF_DEVICE_MEMORY)".
Error vulkanError(VkResult result, std::string_view operation);

/// "12.0 MiB"
std::string bytesText(uint64_t bytes);

}  // namespace rill
