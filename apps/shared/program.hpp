#pragma once
#include <unistd.h>

#include <exception>
#include <optional>
#include <string>

#include "rill/expected.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/message.hpp"
#include "shared/signals.hpp"

namespace rill::apps {

/// The options of a run, or the text of --help or --version.
template <class Options>
struct CommandLine {
  std::optional<Options> options;
  std::string text;
};

/// The main function of a program: parses the command line, then runs it or prints the text; returns the exit code.
///   parse(count, arguments) -> Expected<CommandLine<Options>>,  run(options) -> int
template <class Parse, class Run>
int runProgram(const char* name, int count, char** arguments, Parse&& parse, Run&& run) {
  reserveStandardStreams();
  installSignals();
  // Only the standard library throws, where memory runs out.
  try {
    const auto line = parse(count, arguments);
    if (!line) {
      printMessage(name, line.error().message);
      return kBadInput;
    }
    if (line->options) return run(*line->options);
    const auto written = writeStream(STDOUT_FILENO, line->text);
    if (!written) printMessage(name, written.error().message);
    return written ? kDone : kFailed;
  } catch (const std::exception& error) {
    printMessage(name, error.what());
    return kFailed;
  }
}

}  // namespace rill::apps
