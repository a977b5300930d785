#pragma once
// What the command lines share. Needs CLI11.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

#include "rill/expected.hpp"

namespace rill::apps {

/// Calls `parse`, which has `app` parse. Empty, or the text that --help or --version asks for; BadInput with the library's own message, and
/// the nearest option for one that it does not know. `version`: "rill-capture 0.1.0".
Expected<std::string> parsed(CLI::App& app, const std::string& version, const std::function<void()>& parse);

/// The command as one would type it in a shell.
std::string commandText(std::string_view program, int count, const char* const* arguments);

}  // namespace rill::apps
