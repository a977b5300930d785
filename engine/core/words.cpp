#include "core/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

namespace rill {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lowered(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), lower);
  return out;
}

/// Edit distance between a and b, with adjacent transpositions (optimal string alignment).
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

}  // namespace

std::string_view nearestWord(std::string_view word, std::span<const std::string_view> known) {
  constexpr size_t kMaxWordLength = 64;  // bounds the quadratic cost of the distance
  if (word.empty() || word.size() > kMaxWordLength) return {};
  const std::string wanted = lowered(word);
  std::string_view best;
  size_t best_distance = kMaxWordLength;
  for (const std::string_view candidate : known) {
    const std::string other = lowered(candidate);
    size_t distance = editDistance(wanted, other);
    const size_t shorter = std::min(wanted.size(), other.size());
    if (shorter >= 3 && wanted.compare(0, shorter, other, 0, shorter) == 0) distance = std::min<size_t>(distance, 1);
    const size_t allowed = std::max<size_t>(1, std::max(wanted.size(), other.size()) / 3);
    if (shorter < 2 && distance > 0) continue;
    if (distance <= allowed && distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string inQuotes(std::string_view text) {
  constexpr size_t kMaxBytes = 60;
  std::string out = "\"";
  size_t end = text.size();
  if (end > kMaxBytes) {
    end = kMaxBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  }
  for (const char c : text.substr(0, end)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04x", byte);
      out += escape.data();
    } else {
      out += c;
    }
  }
  if (end < text.size()) out += "...";
  return out + "\"";
}

std::string grouped(uint64_t number) {
  std::string digits = std::to_string(number);
  for (size_t at = digits.size(); at > 3;) {
    at -= 3;
    digits.insert(at, 1, ',');
  }
  return digits;
}

std::string shortestNumber(double number) {
  std::array<char, 32> text{};
  const double size = std::abs(number);
  const bool plain = number == 0 || (size >= 1e-5 && size < 1e15);
  const auto end = plain ? std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr
                         : std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

std::string roundedNumber(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", number);
  return text.data();
}

std::string roundedPlace(const Double3& place) {
  return "[" + roundedNumber(place.x) + ", " + roundedNumber(place.y) + ", " + roundedNumber(place.z) + "]";
}

std::string quotedList(std::span<const std::string_view> words) {
  std::string out;
  for (const std::string_view word : words) {
    if (!out.empty()) out += ", ";
    out += inQuotes(word);
  }
  return out;
}

std::string memberPath(std::string_view path, std::string_view key) {
  const bool plain = !key.empty() && key.size() <= 60 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '$';
  });
  std::string out(path);
  if (!out.empty()) out += '.';
  return out + (plain ? std::string(key) : inQuotes(key));
}

std::string elementPath(std::string_view path, size_t index) { return std::string(path) + "[" + std::to_string(index) + "]"; }

}  // namespace rill
