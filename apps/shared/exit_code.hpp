#pragma once
#include "rill/expected.hpp"

namespace rill::apps {

/// Exit codes of the programs; 128 + the signal's number after a signal.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,         ///< an error while running
  kBadInput = 2,       ///< bad usage or bad input; nothing was simulated
  kRequireFailed = 3,  ///< a --require did not hold
  kNoDevice = 4        ///< no usable Vulkan device
};

/// The exit code of an error before the run begins: a scene too large for the device counts as bad input.
inline int exitCodeBeforeRun(const Error& error) {
  switch (error.kind) {
    case ErrorKind::BadInput:
    case ErrorKind::TooLarge:
      return kBadInput;
    case ErrorKind::NoDevice:
      return kNoDevice;
    default:
      return kFailed;
  }
}

}  // namespace rill::apps
