#include "shared/program.hpp"
#include "view/options.hpp"
#include "view/viewer.hpp"

int main(int count, char** arguments) {
  return rill::apps::runProgram("rill-view", count, arguments, rill::view::parseCommandLine, rill::view::runViewer);
}
