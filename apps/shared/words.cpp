#include "shared/words.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace rill::apps {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other, whatever the case.
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

}  // namespace

std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> known) {
  const std::string* best = nullptr;
  size_t least = std::max<size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const size_t distance = editDistance(word, candidate);
    if (distance < least && distance < candidate.size()) least = distance, best = &candidate;
  }
  if (best) return *best;
  // Not a typo; perhaps a beginning.
  for (const std::string& candidate : known)
    if (word.size() >= 3 && candidate.starts_with(word)) return candidate;
  return std::nullopt;
}

std::string didYouMean(std::string_view word, std::span<const std::string> known) {
  const std::optional<std::string> nearest = nearestWord(word, known);
  return nearest ? "; did you mean '" + *nearest + "'?" : "";
}

std::string joined(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace rill::apps
