#pragma once
// A binary file while it is put together.
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rill::apps {

class FileBytes {
 public:
  void reserve(size_t bytes) { bytes_.reserve(bytes); }
  void text(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }
  /// As it is in memory: little-endian.
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && std::endian::native == std::endian::little);
    add(std::as_bytes(std::span(&value, 1)));
  }
  template <class T>
  void values(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && std::endian::native == std::endian::little);
    add(std::as_bytes(std::span(values)));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void add(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  std::vector<std::byte> bytes_;
};

}  // namespace rill::apps
