#include "capture/capture.hpp"
#include "capture/options.hpp"
#include "shared/program.hpp"

int main(int count, char** arguments) {
  return rill::apps::runProgram("rill-capture", count, arguments, rill::capture::parseCommandLine, rill::capture::runCapture);
}
