#pragma once
#include <string>
#include <string_view>

namespace rill::apps {

/// `text` for a terminal: control characters except line feeds, and bytes that are not UTF-8, are escaped as \u001b or \xff.
std::string printable(std::string_view text);

/// Writes "PROGRAM: TEXT" and a line feed to standard error, as printable text. A failure to write is ignored.
void printMessage(std::string_view program, std::string_view text);

}  // namespace rill::apps
