#pragma once
#include "capture/options.hpp"

namespace rill::capture {

/// Runs the scene and writes what was asked for. Returns the program's exit code; messages are on standard error by then.
int runCapture(const Options& options);

/// Frames that a scene's duration takes, its start and its last instant included: 2 s at 50 fps are 101. Not bounded by kMaxFrames.
double frameCount(double duration_s, double fps);

}  // namespace rill::capture
