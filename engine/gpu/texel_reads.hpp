#pragma once
#include <cstdint>

#include "rill/device.hpp"

namespace rill {

/// Texels that every device has in a buffer's view. A device with only these reads storage buffers.
inline constexpr uint32_t kFewTexels = 65536;

/// Whether kernels read arrays of up to `elements` elements through uniform texel buffers
/// (shaders/shared/arrays.glsl) instead of storage buffers. Devices with only the guaranteed minimum of
/// 65,536 texels use storage buffers: SwiftShader miscompiles the texel variant (shaders/shared/loops.glsl).
inline bool usesTexelReads(const Device& device, uint64_t elements) {
  const uint64_t limit = device.info().maxTexelBufferElements;
  return limit > kFewTexels && elements <= limit;
}

}  // namespace rill
