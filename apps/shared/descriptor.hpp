#pragma once
#include <unistd.h>

#include <utility>

namespace rill::apps {

/// Owns a file descriptor; -1: none.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  int get() const { return value_; }
  /// The result of close(2); 0 where none was open.
  int close() {
    const int value = std::exchange(value_, -1);
    return value >= 0 ? ::close(value) : 0;
  }

 private:
  int value_;
};

}  // namespace rill::apps
