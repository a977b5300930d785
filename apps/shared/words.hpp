#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rill::apps {

/// The known word that `word` is most likely a typo of, or none where nothing is near.
std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> known);

/// "; did you mean 'x'?" or nothing.
std::string didYouMean(std::string_view word, std::span<const std::string> known);

/// "a, b, c"
std::string joined(std::span<const std::string> words);

}  // namespace rill::apps
