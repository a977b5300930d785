#include "scene/json_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/words.hpp"

namespace rill {
namespace {

namespace fs = std::filesystem;

std::string_view kindOf(const fs::file_status& status) {
  switch (status.type()) {
    case fs::file_type::directory:
      return "a directory";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    default:
      return "a special file";
  }
}

/// "line:column" of a byte in `text`, both from 1. The column counts characters.
std::string lineAndColumn(std::string_view text, size_t at) {
  size_t line = 1, column = 1;
  for (size_t i = 0; i < std::min(at, text.size()); ++i) {
    if (text[i] == '\n') {
      ++line;
      column = 1;
    } else if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) {
      ++column;
    }
  }
  return std::to_string(line) + ":" + std::to_string(column);
}

/// The name of an encoding other than UTF-8, by its BOM or by the zero bytes around an ASCII first character; else empty.
std::string_view foreignEncoding(std::string_view text) {
  const auto starts = [&](std::string_view bytes) { return text.substr(0, bytes.size()) == bytes; };
  using namespace std::string_view_literals;
  if (starts("\xFF\xFE\0\0"sv)) return "UTF-32, little-endian";
  if (starts("\0\0\xFE\xFF"sv)) return "UTF-32, big-endian";
  if (starts("\xFF\xFE"sv)) return "UTF-16, little-endian";
  if (starts("\xFE\xFF"sv)) return "UTF-16, big-endian";
  if (text.size() < 4) return {};
  const bool zero[4] = {text[0] == 0, text[1] == 0, text[2] == 0, text[3] == 0};
  if (!zero[0] && zero[1] && zero[2] && zero[3]) return "UTF-32, little-endian";
  if (zero[0] && zero[1] && zero[2] && !zero[3]) return "UTF-32, big-endian";
  if (!zero[0] && zero[1] && !zero[2] && zero[3]) return "UTF-16, little-endian";
  if (zero[0] && !zero[1] && zero[2] && !zero[3]) return "UTF-16, big-endian";
  return {};
}

/// Offset of the first byte that is not valid UTF-8; text.size() if all are.
size_t firstInvalidUtf8(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  for (size_t i = 0; i < text.size();) {
    const unsigned first = byte(i);
    const size_t length = first < 0x80                    ? 1
                          : first >= 0xC2 && first < 0xE0 ? 2
                          : (first & 0xF0U) == 0xE0       ? 3
                          : first >= 0xF0 && first < 0xF5 ? 4
                                                          : 0;
    if (length == 0) return i;
    for (size_t k = 1; k < length; ++k) {
      if ((byte(i + k) & 0xC0U) != 0x80U) return i;
    }
    const unsigned second = byte(i + 1);  // overlong forms, surrogates, beyond U+10FFFF
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) ||
        (first == 0xF4 && second > 0x8F))
      return i;
    i += length;
  }
  return text.size();
}

/// Input iterator for nlohmann's lexer that publishes its position.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  Cursor& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  Cursor operator++(int) {
    Cursor before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const Cursor& a, const Cursor& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  const char** reached_;
};

/// Builds the value from the parser's events and stops at the first error.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  const char* reached = nullptr;  ///< position of the lexer
  Json root;
  std::string message;  ///< empty without an error

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    const auto [entry, fresh] = open_.back()->emplace(key, nullptr);
    if (!fresh) return fail(startOfString(), "duplicate key " + inQuotes(key) + "; expected each key once in an object");
    slot_ = &*entry;
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    const size_t at = startOfToken(std::min(position > 0 ? position - 1 : 0, text_.size()));
    constexpr int kOutOfRange = 406;
    if (error.id == kOutOfRange)
      return fail(at, (open_.empty() ? "the number" : "the number " + clipped(std::string(text_.substr(at, position - at)))) +
                          " is out of range; expected a number that fits a 32-bit float");
    std::string what = error.what();
    const size_t column = what.find("column ");
    const size_t colon = column == std::string::npos ? column : what.find(": ", column);
    if (colon != std::string::npos) what.erase(0, colon + 2);
    constexpr std::string_view kPrefix = "syntax error ";
    if (what.starts_with(kPrefix)) what.erase(0, kPrefix.size());
    constexpr std::string_view kRead = "; last read: '";  // repeats most of the line
    if (const size_t read = what.find(kRead); read != std::string::npos) {
      const size_t expected = what.rfind("'; expected ");
      what.erase(read, expected == std::string::npos || expected < read ? std::string::npos : expected + 1 - read);
    }
    if (trailingComma(at)) what = std::string("trailing comma before ") + text_[at];
    return fail(at, "invalid JSON: " + clipped(what));
  }

 private:
  bool fail(size_t at, const std::string& text) {
    if (message.empty()) message = std::string(name_) + ":" + lineAndColumn(text_, at) + ": " + text;
    return false;
  }

  Json* place(Json&& value) {
    if (open_.empty()) {
      root = std::move(value);
      return &root;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return &open_.back()->back();
    }
    *slot_ = std::move(value);
    return slot_;
  }
  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json container) {
    if (open_.size() >= kMaxJsonDepth) return fail(offset() - 1, "nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
    open_.push_back(place(std::move(container)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  size_t offset() const { return static_cast<size_t>(reached - text_.data()); }

  /// Start of the word or number that contains `at`; `at` itself outside of one.
  size_t startOfToken(size_t at) const {
    const auto part = [&](size_t i) {
      const char c = text_[i];
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    };
    if (at >= text_.size() || !part(at)) return at;
    while (at > 0 && part(at - 1)) --at;
    return at;
  }

  /// The opening quote of the string that the lexer has just read.
  size_t startOfString() const {
    size_t at = offset() - 1;  // its closing quote
    while (at > 0) {
      --at;
      if (text_[at] != '"') continue;
      size_t slashes = 0;
      while (slashes < at && text_[at - 1 - slashes] == '\\') ++slashes;
      if (slashes % 2 == 0) break;
    }
    return at;
  }

  bool trailingComma(size_t at) const {
    if (at >= text_.size() || (text_[at] != ']' && text_[at] != '}')) return false;
    const size_t before = at == 0 ? std::string_view::npos : text_.find_last_not_of(" \t\r\n", at - 1);
    return before != std::string_view::npos && text_[before] == ',';
  }

  static std::string clipped(const std::string& text) {
    constexpr size_t kMaxLength = 200, kKept = 90;
    if (text.size() <= kMaxLength) return text;
    const auto continues = [&](size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U; };
    size_t head = kKept, tail = text.size() - kKept;
    while (head > 0 && continues(head)) --head;
    while (tail < text.size() && continues(tail)) ++tail;
    return text.substr(0, head) + " ... " + text.substr(tail);
  }

  std::string_view text_, name_;
  std::vector<Json*> open_;  // open containers, outermost first
  Json* slot_ = nullptr;     // value of the last key
};

}  // namespace

Expected<std::string> readWholeFile(const fs::path& file, uint64_t maxBytes) {
  const auto badInput = [&](const std::string& why) { return Error{ErrorKind::BadInput, file.string() + ": " + why}; };
  std::error_code trouble;
  const fs::file_status status = fs::status(file, trouble);
  if (status.type() == fs::file_type::not_found) return badInput("no such file");
  if (status.type() == fs::file_type::none) return badInput("cannot be read: " + trouble.message());
  if (!fs::is_regular_file(status)) return badInput("found " + std::string(kindOf(status)) + ", expected a regular file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return badInput(std::string("cannot be opened: ") + std::strerror(errno));
  const uint64_t size = fs::file_size(file, trouble);
  if (!trouble && size > maxBytes) return badInput(grouped(size) + " bytes; expected at most " + grouped(maxBytes));
  std::string text;
  text.reserve(trouble ? 0 : size);
  char block[1 << 14];
  while (in.read(block, sizeof block), in.gcount() > 0) {
    text.append(block, static_cast<size_t>(in.gcount()));
    if (text.size() > maxBytes) return badInput("more than " + grouped(maxBytes) + " bytes; expected at most that");
  }
  if (in.bad()) return Error{ErrorKind::Io, file.string() + ": reading failed: " + std::strerror(errno)};
  return text;
}

Expected<Json> parseJsonText(std::string_view text, std::string_view name) {
  const auto badInput = [&](const std::string& why) { return Error{ErrorKind::BadInput, std::string(name) + ": " + why}; };
  if (const std::string_view encoding = foreignEncoding(text); !encoding.empty())
    return badInput("the encoding is " + std::string(encoding) + "; expected UTF-8");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (const size_t at = firstInvalidUtf8(text); at < text.size()) {
    char byte[8];
    std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned char>(text[at]));
    return Error{ErrorKind::BadInput,
                 std::string(name) + ":" + lineAndColumn(text, at) + ": the byte " + byte + " is not valid UTF-8; expected UTF-8"};
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return badInput("empty file; expected a JSON object");
  Builder builder(text, name);
  builder.reached = text.data();
  const Cursor begin(text.data(), &builder.reached), end(text.data() + text.size(), &builder.reached);
  if (!Json::sax_parse(begin, end, &builder, Json::input_format_t::json, true, true)) return Error{ErrorKind::BadInput, builder.message};
  return std::move(builder.root);
}

}  // namespace rill
