#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "rill/expected.hpp"
#include "shared/device_option.hpp"
#include "shared/program.hpp"

namespace rill::bench {

/// Parsed command line.
struct Options {
  std::string suite;
  bool quick = false;  ///< fewer and smaller cases, about a minute
  bool quiet = false;
  uint32_t repeat = 3;  ///< samples per time; the median is reported
  std::string only;     ///< runs only cases whose name contains this
  apps::DeviceOption device;
  std::optional<std::filesystem::path> json, plot, report;
  double budget_s = 480;  ///< of the suite device, 10 to 3,600
  std::string command;    ///< the command line, quoted for a shell where necessary
};

/// Fails with BadInput; the message names the option, the value found and the expected one.
Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments);

}  // namespace rill::bench
