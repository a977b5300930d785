#pragma once
// Records of a snapshot, which has them word by word.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace rill {

/// The record that words begin with.
template <class Record>
Record readRecord(std::span<const uint32_t> words) {
  Record r{};
  std::memcpy(&r, words.data(), std::min(words.size_bytes(), sizeof r));
  return r;
}

template <class Record>
std::vector<uint32_t> wordsOf(const Record& r) {
  std::vector<uint32_t> words(sizeof r / 4);
  std::memcpy(words.data(), &r, sizeof r);
  return words;
}

}  // namespace rill
