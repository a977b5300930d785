#pragma once
#include <span>
#include <string>
#include <string_view>

namespace rill::apps {

/// "; did you mean "x"?" with the known word that `word` is most likely a typo of; empty where none is near.
std::string didYouMean(std::string_view word, std::span<const std::string> known);

/// "a, b, c"
std::string joined(std::span<const std::string> words);

/// One argument of a shell command: the text itself where it has no special characters, else in single quotes.
std::string shellQuoted(std::string_view argument);

}  // namespace rill::apps
