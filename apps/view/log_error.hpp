#pragma once
#include <string>

#include "shared/message.hpp"

namespace rill::view {

/// Writes to standard error, under the program's name.
inline void logError(const std::string& text) { apps::printMessage("rill-view", text); }

}  // namespace rill::view
