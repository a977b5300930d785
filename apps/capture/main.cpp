#include "capture/capture.hpp"
#include "capture/options.hpp"
#include "capture/playback.hpp"
#include "shared/program.hpp"

int main(int count, char** arguments) {
  return rill::apps::runProgram(
      "rill-capture", count, arguments, rill::capture::parseCommandLine,
      [](const rill::capture::Options& options) { return options.play ? runPlayback(options) : runCapture(options); });
}
