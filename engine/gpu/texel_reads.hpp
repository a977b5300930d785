#pragma once
#include <cstdint>

#include "rill/device.hpp"

namespace rill {

/// Texels in a view of everything that is read through one, unless a number is given.
inline constexpr uint64_t kReadTexels = uint64_t{1} << 27;

/// Whether kernels read arrays of up to `elements` elements through uniform texel buffers (shaders/shared/arrays.glsl) instead of storage
/// buffers: as the device was borrowed for (HostDevice::reads), where so many fit. Without a number it is the same for all such kernels, so
/// that one variant of each is compiled.
inline bool usesTexelReads(const Device& device, uint64_t elements = kReadTexels) {
  return device.info().texelReads && elements <= device.info().maxTexelBufferElements;
}

}  // namespace rill
