#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "rill/expected.hpp"

namespace rill::bench {

/// What a command line asks for.
struct Options {
  std::string suite;
  bool quick = false;  ///< under a minute: fewer and smaller cases
  bool quiet = false;
  uint32_t repeat = 3;  ///< samples of each time, of which the median counts
  std::string only;     ///< run only the cases whose names contain this
  std::string device;   ///< part of a name, or an index
  std::optional<std::filesystem::path> json, plot;
  std::string command;  ///< the command line, quoted where a shell needs it
};

/// Options, or text that was asked for in place of a run (--help, --version).
struct CommandLine {
  std::optional<Options> options;
  std::string text;
};

/// BadInput with a message that names the option, what was given and what was expected.
Expected<CommandLine> parseCommandLine(int count, const char* const* arguments);

}  // namespace rill::bench
