#pragma once
#include "capture/options.hpp"

namespace rill::capture {

/// Runs the scene, writes the outputs, prints messages to standard error. Returns the exit code.
int runCapture(const Options& options);

/// Frames of a duration, including its first and its last instant: 101 for 2 s at 50 frames/s. Not limited to kMaxFrames.
double frameCount(double duration_s, double fps);

}  // namespace rill::capture
