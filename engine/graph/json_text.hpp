#pragma once
// A minimal JSON writer, so that the engine library does not depend on nlohmann_json.
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace rill {

class JsonText {
 public:
  JsonText& begin(char bracket) {
    separate();
    out_ += bracket;
    first_ = true;
    return *this;
  }
  JsonText& end(char bracket) {
    out_ += bracket;
    first_ = false;
    return *this;
  }
  JsonText& key(std::string_view name) {
    text(name);
    out_ += ':';
    first_ = true;  // what follows is its value
    return *this;
  }
  JsonText& text(std::string_view value) {
    separate();
    out_ += '"';
    for (const char c : value) {
      constexpr char kDigits[] = "0123456789abcdef";
      if (const auto byte = static_cast<unsigned char>(c); byte < 0x20) {
        out_ += "\\u00";
        out_ += kDigits[byte >> 4];
        out_ += kDigits[byte & 15];
        continue;
      }
      if (c == '"' || c == '\\') out_ += '\\';
      out_ += c;
    }
    out_ += '"';
    return *this;
  }
  JsonText& number(uint64_t value) { return word(std::to_string(value)); }
  JsonText& boolean(bool value) { return word(value ? "true" : "false"); }
  JsonText& null() { return word("null"); }
  std::string take() { return std::move(out_); }

 private:
  JsonText& word(std::string_view value) {
    separate();
    out_ += value;
    return *this;
  }
  void separate() {
    if (!std::exchange(first_, false)) out_ += ',';
  }
  std::string out_;
  bool first_ = true;
};

}  // namespace rill
