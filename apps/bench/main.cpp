#include "bench/bench.hpp"
#include "shared/program.hpp"

int main(int count, char** arguments) {
  return rill::apps::runProgram("rill-bench", count, arguments, rill::bench::parseCommandLine, rill::bench::runBench);
}
