#pragma once
#include "capture/options.hpp"

namespace rill::capture {

/// --play: pictures of particles from files, without simulating; the program's exit code.
int runPlayback(const Options& options);

}  // namespace rill::capture
