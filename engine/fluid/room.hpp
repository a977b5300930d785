#pragma once
// How many particles of a scene a device has room for.
#include <cstdint>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/scene.hpp"

namespace rill {

/// TooLarge, with the limit that is exceeded and the number that fits, if the device has no room for a fluid of so many particles.
Expected<void> checkRoom(const Device& device, const Scene& scene, uint64_t particles);

}  // namespace rill
