#pragma once
// What the command lines share. Needs CLI11.
#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace rill::apps {

/// The library's own message, with the nearest option for one that it does not know.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error);

/// An argument as one would type it in a shell.
std::string shellQuoted(std::string_view argument);

}  // namespace rill::apps
