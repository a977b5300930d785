#pragma once
#include <algorithm>
#include <cstdint>
#include <string_view>

namespace rill {

/// The lines of a text, whichever of LF, CR LF and CR ends them.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  /// False after the last line.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(rest_.size(), end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1)));
    ++number_;
    return true;
  }
  uint64_t number() const { return number_; }  ///< of the line that was read last, from 1

 private:
  std::string_view rest_;
  uint64_t number_ = 0;
};

/// Removes the first word from a line and returns it; empty at the end.
inline std::string_view takeWord(std::string_view& line) {
  constexpr std::string_view kSpace = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

}  // namespace rill
