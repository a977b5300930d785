#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rill {

/// Memory for the callables of one frame. Blocks never move and are reused after rewind().
class RecordArena {
 public:
  void* allocate(size_t bytes, size_t alignment) {
    for (;; ++block_, used_ = 0) {
      if (block_ == blocks_.size()) {
        const size_t size = bytes + alignment > kBlockBytes ? bytes + alignment : kBlockBytes;
        blocks_.push_back({std::make_unique<std::byte[]>(size), size});
      }
      const auto base = reinterpret_cast<uintptr_t>(blocks_[block_].memory.get());
      const size_t begin = size_t(((base + used_ + alignment - 1) & ~uintptr_t(alignment - 1)) - base);
      if (begin + bytes <= blocks_[block_].size) {
        used_ = begin + bytes;
        return blocks_[block_].memory.get() + begin;
      }
    }
  }
  void rewind() { block_ = 0, used_ = 0; }

 private:
  static constexpr size_t kBlockBytes = 32 * 1024;
  struct Block {
    std::unique_ptr<std::byte[]> memory;
    size_t size;
  };
  std::vector<Block> blocks_;
  size_t block_ = 0, used_ = 0;
};

}  // namespace rill
