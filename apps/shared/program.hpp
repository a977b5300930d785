#pragma once
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "rill/expected.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/signals.hpp"

namespace rill::apps {

/// Options, or text that was asked for in place of a run (--help, --version).
template <class Options>
struct CommandLine {
  std::optional<Options> options;
  std::string text;
};

/// A program's main: reads its command line, runs it or shows the text that was asked for; the exit code.
///   parse(count, arguments) -> Expected<CommandLine<Options>>,  run(options) -> int
template <class Parse, class Run>
int runProgram(const char* name, int count, char** arguments, Parse&& parse, Run&& run) {
  installSignals();
  const auto say = [name](const std::string& text) { std::fprintf(stderr, "%s: %s\n", name, text.c_str()); };
  // Nothing of ours throws; the standard library does when memory runs out.
  try {
    const auto line = parse(count, arguments);
    if (!line) {
      say(line.error().message);
      return kBadInput;
    }
    if (line->options) return run(*line->options);
    const auto shown = writeAll(STDOUT_FILENO, "standard output", line->text);
    if (!shown) say(shown.error().message);
    return shown ? kDone : kFailed;
  } catch (const std::exception& error) {
    say(error.what());
    return kFailed;
  }
}

}  // namespace rill::apps
