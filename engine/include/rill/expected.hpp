#pragma once
// Results that may be errors, instead of exceptions.
//
//   rill::Expected<int> result = rill::Error{rill::ErrorKind::BadInput, "count: expected 1 or more, found 0"};
//   if (!result) return fail(result.error().message);
//   return *result;
#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace rill {

/// The category of an error, for callers to branch on. Programs map it to an exit code.
enum class ErrorKind {
  BadInput,     ///< a file, key, option or argument that the caller can correct
  TooLarge,     ///< exceeds the device's memory, detected before any allocation; the message names what and how much
  NoDevice,     ///< no Vulkan device that can run Rill
  DeviceLost,   ///< the driver reported VK_ERROR_DEVICE_LOST
  OutOfMemory,  ///< host or device memory ran out
  Shader,       ///< creation of a shader or a pipeline failed
  Io,           ///< reading or writing a file
  Failed        ///< anything else
};

/// An error with a message for users: the operation, what was found, what was expected.
struct Error {
  ErrorKind kind = ErrorKind::Failed;
  std::string message = {};
};

/// A value or an Error. Rill's public functions return it instead of throwing.
/// Reading the value of a failed result is a programming error (assert).
template <class T>
class [[nodiscard]] Expected {
 public:
  Expected(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Expected(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  bool hasValue() const { return state_.index() == 0; }

  T& operator*() & {
    assert(hasValue());
    return *std::get_if<0>(&state_);
  }
  const T& operator*() const& {
    assert(hasValue());
    return *std::get_if<0>(&state_);
  }
  T&& operator*() && {
    assert(hasValue());
    return std::move(*std::get_if<0>(&state_));
  }
  T* operator->() {
    assert(hasValue());
    return std::get_if<0>(&state_);
  }
  const T* operator->() const {
    assert(hasValue());
    return std::get_if<0>(&state_);
  }

  const Error& error() const {
    assert(!hasValue());
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// Success, or an Error.
template <>
class [[nodiscard]] Expected<void> {
 public:
  Expected() = default;
  Expected(Error error) : error_(std::move(error)), ok_(false) {}

  explicit operator bool() const { return ok_; }
  bool hasValue() const { return ok_; }
  const Error& error() const {
    assert(!ok_);
    return error_;
  }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace rill
