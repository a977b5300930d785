#pragma once
// How many particles of a scene a device has room for.
#include <cstdint>
#include <string_view>

#include "fluid/arrays.hpp"
#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/scene.hpp"

namespace rill {

constexpr uint32_t kMaxListChunks = 16;

/// Buffers that the neighbor list is split over, at least 1.
uint64_t listChunks(const DeviceInfo& info, const ArrayShape& shape);

/// TooLarge, with the limit that is exceeded and the number that fits, if the device has no room for a fluid of so many particles.
/// `remedy`: what to change then.
Expected<void> checkRoom(const Device& device, const Scene& scene, uint64_t particles, std::string_view remedy);

}  // namespace rill
