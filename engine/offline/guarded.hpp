#pragma once
#include <new>
#include <string>

#include "rill/expected.hpp"

namespace rill::offline {

/// Runs `work` and turns std::bad_alloc into an error.
template <class Work>
auto guarded(const char* what, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) { return Error{ErrorKind::OutOfMemory, std::string(what) + ": out of memory"}; }
}

}  // namespace rill::offline
