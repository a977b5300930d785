#pragma once
// First contents of device buffers on their way there: laid out in upload memory, in buffers of at most 128 MiB each.
#include <functional>
#include <vector>

#include "gpu/resources.hpp"

namespace rill {

class Staging {
 public:
  struct Copy {
    const Buffer* target;
    uint32_t source;     ///< of sources()
    uint64_t at, bytes;  ///< from there, to the target's begin
  };

  /// `write` fills `bytes` bytes when make() is called. Nothing for 0 bytes. The target stays where it is until the copies have run.
  void add(const Buffer& target, uint64_t bytes, std::function<void(std::byte*)> write);
  /// `data` outlives make().
  void add(const Buffer& target, const void* data, uint64_t bytes);
  /// The same bytes as were added for `other`.
  void addSame(const Buffer& target, const Buffer& other);
  void clear(const Buffer& target) { cleared_.push_back(&target); }

  /// OutOfMemory.
  Expected<void> make(Device& device);

  const std::vector<Buffer>& sources() const { return sources_; }
  const std::vector<Copy>& copies() const { return copies_; }
  const std::vector<const Buffer*>& cleared() const { return cleared_; }  ///< to be filled with zeros

 private:
  std::vector<Copy> copies_;
  std::vector<std::function<void(std::byte*)>> writers_;  ///< one a copy; empty: it shares the bytes of the copy `shared_`
  std::vector<size_t> shared_;
  std::vector<const Buffer*> cleared_;
  std::vector<Buffer> sources_;
};

}  // namespace rill
