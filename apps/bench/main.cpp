#include <unistd.h>

#include <cstdio>
#include <exception>

#include "bench/bench.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/signals.hpp"

namespace {

int run(int count, char** arguments) {
  using namespace rill;
  const auto line = bench::parseCommandLine(count, arguments);
  if (!line) {
    std::fprintf(stderr, "rill-bench: %s\n", line.error().message.c_str());
    return apps::kBadInput;
  }
  if (line->options) return bench::runBench(*line->options);
  const auto shown = apps::writeAll(STDOUT_FILENO, "standard output", line->text);
  if (!shown) std::fprintf(stderr, "rill-bench: %s\n", shown.error().message.c_str());
  return shown ? apps::kDone : apps::kFailed;
}

}  // namespace

int main(int count, char** arguments) {
  rill::apps::installSignals();
  // Nothing of ours throws; the standard library does when memory runs out.
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rill-bench: %s\n", error.what());
    return rill::apps::kFailed;
  }
}
