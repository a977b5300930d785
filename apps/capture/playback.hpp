#pragma once
#include "capture/options.hpp"

namespace rill::capture {

/// --play: draws particles from files without simulating. Returns the exit code.
int runPlayback(const Options& options);

}  // namespace rill::capture
