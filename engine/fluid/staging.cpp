#include "fluid/staging.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace rill {
namespace {

constexpr uint64_t kMaxBytes = uint64_t{128} << 20;  // of a buffer with several contents

}  // namespace

void Staging::add(size_t target, uint64_t bytes, std::function<void(std::byte*)> write) {
  if (bytes == 0) return;
  copies_.push_back({target, 0, 0, bytes});
  writers_.push_back(std::move(write));
  shared_.push_back(copies_.size() - 1);
}

void Staging::add(size_t target, const void* data, uint64_t bytes) {
  add(target, bytes, [=](std::byte* to) { std::memcpy(to, data, bytes); });
}

void Staging::addSame(size_t target, size_t other) {
  const auto found = std::find_if(copies_.begin(), copies_.end(), [&](const Copy& copy) { return copy.target == other; });
  assert(found != copies_.end());
  const auto index = static_cast<size_t>(found - copies_.begin());
  copies_.push_back({target, 0, 0, found->bytes});
  writers_.emplace_back();
  shared_.push_back(index);
}

Expected<void> Staging::make(Device& device) {
  std::vector<uint64_t> sizes;
  for (size_t k = 0; k < copies_.size(); ++k) {
    Copy& copy = copies_[k];
    if (!writers_[k]) {
      copy.source = copies_[shared_[k]].source;
      copy.at = copies_[shared_[k]].at;
      continue;
    }
    const uint64_t bytes = (copy.bytes + 15) / 16 * 16;
    if (sizes.empty() || (sizes.back() > 0 && sizes.back() + bytes > kMaxBytes)) sizes.push_back(0);
    copy.source = static_cast<uint32_t>(sizes.size() - 1);
    copy.at = sizes.back();
    sizes.back() += bytes;
  }
  for (uint64_t bytes : sizes) {
    auto buffer = createBuffer(device, "start state", bytes, MemoryKind::Upload);
    if (!buffer) return buffer.error();
    sources_.push_back(std::move(*buffer));
  }
  for (size_t k = 0; k < copies_.size(); ++k)
    if (writers_[k]) writers_[k](sources_[copies_[k].source].mapped() + copies_[k].at);
  writers_.clear();
  return {};
}

}  // namespace rill
