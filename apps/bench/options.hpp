#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "rill/expected.hpp"
#include "shared/program.hpp"

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

/// BadInput with a message that names the option, what was given and what was expected.
Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments);

}  // namespace rill::bench
