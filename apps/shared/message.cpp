#include "shared/message.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace rill::apps {
namespace {

/// Bytes of the UTF-8 sequence that `text` begins with, and its code point; 0 bytes where it is not one.
size_t decode(std::string_view text, uint32_t& code) {
  const auto byte = [&](size_t k) { return static_cast<uint32_t>(static_cast<unsigned char>(text[k])); };
  code = byte(0);
  if (code < 0x80) return 1;
  const size_t length = code >= 0xF0 ? 4 : code >= 0xE0 ? 3 : 2;
  if (code < 0xC2 || code > 0xF4 || text.size() < length) return 0;
  code &= 0x7FU >> length;
  for (size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return 0;
    code = code << 6 | (byte(k) & 0x3FU);
  }
  constexpr uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kSmallest[length] || code > 0x10FFFF || surrogate ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    uint32_t code = 0;
    const size_t length = decode(text, code);
    const bool control = (code < 0x20 && code != '\n') || (code >= 0x7F && code < 0xA0);
    char escape[16];
    if (length == 0) {
      std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned char>(text[0]));
      out += escape;
    } else if (control) {
      std::snprintf(escape, sizeof escape, "\\u%04x", code);
      out += escape;
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return out;
}

void printMessage(std::string_view program, std::string_view text) {
  const std::string line = std::string(program) + ": " + printable(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace rill::apps
