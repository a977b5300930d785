#pragma once
#include "view/options.hpp"

namespace rill::view {

/// Opens the window and shows it until it is closed; the exit code.
int runViewer(const Options& options);

}  // namespace rill::view
