#pragma once
// The options of a command line before their values are checked: names, help, groups.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "capture/options.hpp"

namespace rill::capture {

/// Options as text: numbers are parsed here, so that messages do not depend on the version of CLI11.
struct RawOptions {
  std::string scene, frames, fps, size, out, view, video, stats, particles, device, checkpoint, checkpointEvery, resume, play, orbit,
      exposure, graph, reads, samples, shutter, aperture, focus;
  std::vector<std::string> set, require, exportAs;
  std::string meshFormat, meshCell;
  bool explain = false, noImages = false, noPassTimes = false, quiet = false, exr = false;
};

void declareOptions(CLI::App& app, RawOptions& raw);

/// Checks the options of `app`, which parsed `raw`. BadInput names the option, what was found and what was expected.
Expected<Options> readOptions(const RawOptions& raw, const CLI::App& app);

/// Expands "--set a=1 b=2" to "--set a=1 --set b=2": an argument of the same form is another value of the list.
std::vector<std::string> expandLists(int count, const char* const* arguments);

}  // namespace rill::capture
