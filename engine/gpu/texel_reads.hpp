#pragma once
#include <cstdint>

#include "rill/device.hpp"

namespace rill {

/// Whether kernels read arrays of up to `elements` elements through uniform texel buffers on this device (shaders/shared/arrays.glsl), or
/// through storage buffers. One that allows no more texels than every device must (65,536; Vulkan 1.3, "Required Limits") reads storage
/// buffers, however few its elements are: SwiftShader, which makes mistakes in loops of the other kernels (shaders/shared/loops.glsl).
inline bool readsTexels(const Device& device, uint64_t elements) {
  const uint64_t limit = device.info().maxTexelBufferElements;
  return limit > 65536 && elements <= limit;
}

}  // namespace rill
