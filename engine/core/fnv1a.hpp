#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace rill {

/// 64-bit FNV-1a. Changing any single byte changes the hash.
class Fnv1a {
 public:
  void add(std::byte byte) { hash_ = (hash_ ^ std::to_integer<uint64_t>(byte)) * 0x100000001b3ull; }
  void add(std::span<const std::byte> bytes) {
    for (std::byte byte : bytes) add(byte);
  }
  /// Least significant byte first, independent of the machine's byte order.
  void add(uint32_t bits) {
    for (int k = 0; k < 4; ++k) add(static_cast<std::byte>(bits >> 8 * k));
  }
  void add(uint64_t bits) {
    for (int k = 0; k < 8; ++k) add(static_cast<std::byte>(bits >> 8 * k));
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace rill
