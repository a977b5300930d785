// Read-backs: buffers that the host reads once the frame has completed.
#include <algorithm>
#include <bit>

#include "graph/graph_impl.hpp"

namespace rill {

Expected<void> GraphImpl::placeReadbacks(DeviceImpl& d, FrameSlot& target) {
  uint32_t buffer = 0;
  uint64_t bytes = 0;
  const auto finish = [&]() -> Expected<void> {
    if (target.readbacks.size() <= buffer) target.readbacks.resize(buffer + 1);
    if (bytes <= target.readbacks[buffer].size()) return {};
    auto made = d.createBuffer("read-back", std::max(bytes, std::bit_ceil(std::min(bytes, kSharedBufferBytes / 2))), MemoryKind::Readback);
    if (!made) return made.error();
    target.readbacks[buffer] = std::move(*made);
    return {};
  };
  for (Readback& readback : readbacks) {
    const uint64_t size = (readback.size + 15) & ~15ull;
    if (bytes + size > kSharedBufferBytes && bytes > 0) {
      if (auto ok = finish(); !ok) return ok;
      ++buffer;
      bytes = 0;
    }
    readback.buffer = buffer;
    readback.offset = bytes;
    bytes += size;
    target.pendingReadbacks.push_back({readback.ticket, buffer, readback.offset, readback.size});
  }
  return bytes > 0 ? finish() : Expected<void>{};
}

std::span<const std::byte> GraphImpl::data(Ticket ticket) {
  for (const auto& s : slots)
    for (FrameSlot::PendingReadback& pending : s->pendingReadbacks)
      if (pending.ticket == ticket.id) {
        if (s->frame > device->clock.completed || device->abandoned(s->frame)) return {};
        pending.returned = true;
        return {s->readbacks[pending.buffer].mapped() + pending.offset, pending.size};
      }
  return {};
}

}  // namespace rill
