#include "fluid/room.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "fill/fill_messages.hpp"
#include "gpu/vulkan_error.hpp"
#include "rill/fluid.hpp"
#include "rill/particles.hpp"
#include "sort/dispatches.hpp"

namespace rill {
namespace {

/// Of a buffer of the neighbor list: within the texels of a view where lists may be read through one.
uint64_t maxListBytes(const DeviceInfo& info) {
  constexpr uint64_t kTexelBytes = 4 * kListEntryBytes;
  return info.texelReads ? std::min(info.maxBufferBytes, kTexelBytes * info.maxTexelBufferElements) : info.maxBufferBytes;
}

/// What of the device so many particles exceed; empty: they fit. `available` in bytes.
std::optional<std::string> exceeded(const DeviceInfo& info, uint64_t available, const Scene& scene, uint64_t particles) {
  if (particles > kMaxParticles) return "a fluid has at most " + std::to_string(kMaxParticles) + " on any device";
  const ArrayShape shape = arrayShape(scene, particles);
  for (const ArrayRow& row : arrayTable()) {
    if (row.account == Account::None || row.id == FluidArray::List) continue;  // a list is split over several buffers
    if (const uint64_t bytes = arrayBytes(row.id, shape); bytes > info.maxBufferBytes)
      return "the buffer of " + std::string(row.label) + " would have " + bytesText(bytes) + ", and one has at most " +
             bytesText(info.maxBufferBytes) + " (" + std::string(info.maxBufferName) + ")";
    const uint64_t texels = row.id == FluidArray::NearSolids ? row.length(shape) : 0;  // which may be several a particle
    if (info.texelReads && texels > info.maxTexelBufferElements)
      return "the buffer of " + std::string(row.label) + " would have " + std::to_string(texels) + " texels, and one has at most " +
             std::to_string(info.maxTexelBufferElements);
  }
  if (listChunks(info, shape) > kMaxListChunks)
    return "their neighbor lists would have " + bytesText(arrayBytes(FluidArray::List, shape)) + ", more than " +
           std::to_string(kMaxListChunks) + " buffers of " + bytesText(maxListBytes(info)) +
           " (a smaller fluid.smoothing_ratio makes them shorter)";
  if (const uint64_t needed = memoryOf(shape).total(); needed > available)
    return "they need " + bytesText(needed) + " of device memory, and " + bytesText(available) + " are available";
  return std::nullopt;
}

}  // namespace

uint64_t listChunks(const DeviceInfo& info, const ArrayShape& shape) {
  const uint64_t blocks = divideUp(shape.particles, kListBlock);
  if (shape.listEntries == 0 || blocks == 0) return 1;
  const uint64_t blockBytes = shape.listEntries / blocks * kListEntryBytes;
  return divideUp(blocks, std::max<uint64_t>(maxListBytes(info) / blockBytes, 1));
}

uint32_t maxParticles(const Device& device, const Scene& scene) {
  const uint64_t available = device.availableBytes();
  uint64_t fits = 0, tooMany = kMaxParticles + 1;
  while (tooMany - fits > 1) {
    const uint64_t middle = fits + (tooMany - fits) / 2;
    (exceeded(device.info(), available, scene, middle) ? tooMany : fits) = middle;
  }
  return static_cast<uint32_t>(fits);
}

Expected<void> checkRoom(const Device& device, const Scene& scene, uint64_t particles, std::string_view remedy) {
  const auto limit = exceeded(device.info(), device.availableBytes(), scene, particles);
  if (!limit) return {};
  return Error{ErrorKind::TooLarge, scenePrefix(scene) + std::to_string(particles) + " particles do not fit on \"" + device.info().name +
                                        "\": " + *limit + ". At most " + std::to_string(maxParticles(device, scene)) +
                                        " fit: " + std::string(remedy)};
}

}  // namespace rill
