#pragma once
// Command line parsing with CLI11, for all programs.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

#include "rill/expected.hpp"

namespace rill::apps {

/// Calls `parse`, which runs `app`. Returns the text of --help or --version, or an empty string. BadInput with the
/// library's message, or the nearest option name where an option is unknown. `version`: "rill-capture 0.1.0".
Expected<std::string> parsed(CLI::App& app, const std::string& version, const std::function<void()>& parse);

/// The command line, quoted for a shell.
std::string commandText(std::string_view program, int count, const char* const* arguments);

}  // namespace rill::apps
