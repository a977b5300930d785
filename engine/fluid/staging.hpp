#pragma once
// First contents of device buffers on their way there: laid out in upload memory, in buffers of at most 128 MiB each, unless one content is
// larger.
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"

namespace rill {

/// Writes the bytes of `values`, which it keeps.
template <class T>
std::function<void(std::byte*)> bytesOf(std::vector<T> values) {
  return [values = std::move(values)](std::byte* to) { std::memcpy(to, values.data(), values.size() * sizeof(T)); };
}

/// Targets are numbers that the owner gives to its buffers.
class Staging {
 public:
  struct Copy {
    size_t target;
    uint32_t source;     ///< of sources()
    uint64_t at, bytes;  ///< from there, to the target's begin
  };

  /// `write` fills `bytes` bytes when make() is called. Nothing for 0 bytes.
  void add(size_t target, uint64_t bytes, std::function<void(std::byte*)> write);
  /// `data` outlives make().
  void add(size_t target, const void* data, uint64_t bytes);
  template <class T>
  void add(size_t target, std::vector<T> values) {
    const uint64_t bytes = values.size() * sizeof(T);
    add(target, bytes, bytesOf(std::move(values)));
  }
  /// The same bytes as were added for `other`.
  void addSame(size_t target, size_t other);
  void clear(size_t target) { cleared_.push_back(target); }

  /// OutOfMemory.
  Expected<void> make(Device& device);

  const std::vector<Buffer>& sources() const { return sources_; }
  const std::vector<Copy>& copies() const { return copies_; }
  const std::vector<size_t>& cleared() const { return cleared_; }  ///< to be filled with zeros

 private:
  std::vector<Copy> copies_;
  std::vector<std::function<void(std::byte*)>> writers_;  ///< one a copy; empty: it shares the bytes of the copy `shared_`
  std::vector<size_t> shared_;
  std::vector<size_t> cleared_;
  std::vector<Buffer> sources_;
};

}  // namespace rill
