#pragma once
// How the engine and its tests reach the implementation behind a public handle, which hosts cannot.
#include <type_traits>
#include <utility>

namespace rill {

/// Every handle declares it a friend.
struct ImplAccess {
  template <class Handle>
  static auto& implOf(Handle& handle) {
    if constexpr (std::is_const_v<Handle>)
      return std::as_const(*handle.impl_);
    else
      return *handle.impl_;
  }
};

/// The implementation of a handle (a GraphImpl of a Graph); const of a const handle.
template <class Handle>
auto& implOf(Handle& handle) {
  return ImplAccess::implOf(handle);
}

}  // namespace rill
