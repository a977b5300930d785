#pragma once
// Sets of numbers that are joined two at a time: a forest, where each number has a parent and roots have themselves.
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace rill {

class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  /// The same number for all of a set.
  uint32_t root(uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void join(uint32_t a, uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace rill
