#pragma once
#include <string>

#include "rill/vectors.hpp"

namespace rill::view {

/// A number that is being dragged; it is applied to the scene when the drag ends.
struct HeldEdit {
  std::string key;
  Double3 value{};
};

}  // namespace rill::view
