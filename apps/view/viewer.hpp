#pragma once
#include "view/options.hpp"

namespace rill::view {

/// Opens the window and runs until it is closed. Returns the exit code.
int runViewer(const Options& options);

}  // namespace rill::view
