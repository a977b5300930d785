#include "fill/ply_format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <sstream>

#include "core/numbers.hpp"
#include "core/words.hpp"

namespace rill::ply {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxKeptList = 1 << 20;  // numbers

constexpr std::array<size_t, 8> kScalarBytes{1, 1, 2, 2, 4, 4, 4, 8};

std::optional<Scalar> scalarNamed(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i][0] == name || kNames[i][1] == name) return static_cast<Scalar>(i);
  }
  return {};
}

size_t bytesOf(Scalar type) { return kScalarBytes[static_cast<size_t>(type)]; }

/// Smallest size of an element in the file, in bytes.
uint64_t minBytes(const Element& element, Format format) {
  uint64_t bytes = 0;
  for (const Property& property : element.properties) {
    bytes += format == Format::Ascii ? 2
             : property.count        ? bytesOf(*property.count)
                                     : bytesOf(property.type);  // ASCII: a digit and a separator
  }
  return bytes;
}

template <class T>
double swapped(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

double decode(const char* bytes, Scalar type, bool swap) {
  switch (type) {
    case Scalar::I8:
      return swapped<int8_t>(bytes, swap);
    case Scalar::U8:
      return swapped<uint8_t>(bytes, swap);
    case Scalar::I16:
      return swapped<int16_t>(bytes, swap);
    case Scalar::U16:
      return swapped<uint16_t>(bytes, swap);
    case Scalar::I32:
      return swapped<int32_t>(bytes, swap);
    case Scalar::U32:
      return swapped<uint32_t>(bytes, swap);
    case Scalar::F32:
      return swapped<float>(bytes, swap);
    case Scalar::F64:
      return swapped<double>(bytes, swap);
  }
  return 0;
}

/// Parses the lines of a header, up to and with end_header.
class HeaderParser {
 public:
  HeaderParser(Header& header, std::string_view last) : header_(header), last_(last) {}
  Expected<void> parse(std::ifstream& in);

 private:
  Expected<void> parseLine(const std::string& line);

  Header& header_;
  std::string_view last_;
  bool done_ = false, formatSeen_ = false;
};

Expected<void> HeaderParser::parseLine(const std::string& line) {
  std::istringstream words(line);
  std::string keyword, a, b, c, d;
  words >> keyword >> a >> b >> c >> d;
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return {};
  if (keyword == "format") {
    if (a == "ascii")
      header_.format = Format::Ascii;
    else if (a == "binary_little_endian")
      header_.format = Format::Little;
    else if (a == "binary_big_endian")
      header_.format = Format::Big;
    else
      return header_.badInput("the format is " + inQuotes(a) + "; expected ascii, binary_little_endian or binary_big_endian");
    if (b != "1.0") return header_.badInput("the format's version is " + inQuotes(b) + "; expected 1.0");
    formatSeen_ = true;
    return {};
  }
  if (keyword == "element") {
    done_ = done_ || (!header_.elements.empty() && !last_.empty() && header_.elements.back().name == last_);
    if (done_) return {};
    Element element{a, 0, {}};
    const auto read = std::from_chars(b.data(), b.data() + b.size(), element.count);
    if (a.empty() || b.empty() || read.ec != std::errc() || read.ptr != b.data() + b.size()) {
      return header_.badInput("the header line " + inQuotes(line) + " has no count; expected element NAME COUNT");
    }
    header_.elements.push_back(std::move(element));
    return {};
  }
  if (keyword == "property") {
    if (done_) return {};
    if (header_.elements.empty()) return header_.badInput("the header line " + inQuotes(line) + " comes before any element");
    Property property;
    std::optional<Scalar> type = scalarNamed(a == "list" ? c : a), count;
    if (a == "list") count = scalarNamed(b);
    property.name = a == "list" ? d : b;
    if (!type || (a == "list" && !count) || property.name.empty()) {
      return header_.badInput("the header line " + inQuotes(line) +
                              " is invalid; expected property TYPE NAME with a type such as float or uint");
    }
    property.type = *type;
    property.count = count;
    header_.elements.back().properties.push_back(std::move(property));
    return {};
  }
  return header_.badInput("the header line " + inQuotes(line) + " is invalid; expected format, element, property, comment or end_header");
}

Expected<void> HeaderParser::parse(std::ifstream& in) {
  constexpr size_t kMaxBytes = 1 << 20;  // of a header
  std::string line;
  bool first = true;
  const std::string notPly = "does not begin with \"ply\"; expected a PLY file";  // without the content: it may be any file's
  for (;;) {
    line.clear();
    char c = 0;
    while (in.get(c) && c != '\n' && ++header_.body <= kMaxBytes) line += c;
    ++header_.body;
    if (header_.body > kMaxBytes || !in) return header_.badInput(first ? notPly : "the header has no end; expected a line end_header");
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (first) {
      if (line != "ply") return header_.badInput(notPly);
      first = false;
      continue;
    }
    if (line == "end_header") break;
    if (auto ok = parseLine(line); !ok) return ok;
  }
  if (!formatSeen_)
    return header_.badInput("the header has no format line; expected format ascii, binary_little_endian or binary_big_endian 1.0");
  return {};
}

}  // namespace

Expected<Header> readHeader(const fs::path& file, std::string_view last) {
  Header header;
  header.file = file;
  std::error_code trouble;
  const fs::file_status status = fs::status(file, trouble);
  if (!fs::exists(status)) return header.badInput("no such file");
  if (!fs::is_regular_file(status)) return header.badInput("not a regular file; expected a PLY file");
  header.fileBytes = fs::file_size(file, trouble);
  std::ifstream in(file, std::ios::binary);
  if (!in || trouble) return header.badInput("cannot be opened; expected a readable PLY file");
  if (auto ok = HeaderParser(header, last).parse(in); !ok) return ok.error();
  return header;
}

Expected<void> Header::checkCounts() const {
  uint64_t left = fileBytes - std::min(fileBytes, body);
  if (format == Format::Ascii) ++left;  // the last number needs no separator
  for (const Element& element : elements) {
    const uint64_t each = minBytes(element, format);
    if (each == 0) continue;
    if (element.count > left / each) {
      return badInput("the header declares " + grouped(element.count) + " of " + inQuotes(element.name) + ", at least " + grouped(each) +
                      " bytes each, but only " + grouped(left) + " bytes follow; expected a complete file");
    }
    left -= element.count * each;
  }
  return {};
}

Expected<void> Header::findColumns(const Element& vertex, std::span<const std::string_view> names, std::span<int> column) const {
  std::fill(column.begin(), column.end(), -1);
  for (size_t i = 0; i < vertex.properties.size(); ++i) {
    for (size_t k = 0; k < names.size(); ++k) {
      if (vertex.properties[i].name != names[k]) continue;
      if (vertex.properties[i].count) return badInput("the vertex property " + inQuotes(names[k]) + " is a list; expected a number");
      if (column[k] >= 0) return badInput("the vertex property " + inQuotes(names[k]) + " is declared twice; expected it once");
      column[k] = static_cast<int>(i);
    }
  }
  for (size_t k = 0; k < 3; ++k) {
    if (column[k] < 0) return badInput("the vertices have no property " + inQuotes(names[k]) + "; expected x, y and z");
  }
  return {};
}

Expected<void> Header::checkMotion(uint64_t vertex, std::span<const double> values) const {
  for (size_t k = 0; k < values.size(); ++k)
    if (!fitsFloat(values[k]))
      return badInput("vertex " + grouped(vertex) + ": " + (k < 3 ? "the position" : "the velocity") + " is " + shortestNumber(values[k]) +
                      " along " + "xyz"[k % 3] + "; expected a finite number that a 32-bit float can hold");
  return {};
}

Body::Body(const Header& header)
    : header_(header),
      in_(header.file, std::ios::binary),
      swap_((header.format == Format::Little) != (std::endian::native == std::endian::little)) {
  in_.seekg(static_cast<std::streamoff>(header.body));
}

Expected<void> Body::read(const Element& element, uint64_t i, std::vector<double>& row, std::optional<size_t> kept) {
  row.resize(element.properties.size());
  for (size_t p = 0; p < row.size(); ++p) {
    const Property& property = element.properties[p];
    bool ok = next(property.count.value_or(property.type), row[p]);
    if (ok && property.count) {
      const double length = row[p];
      if (!(length >= 0)) return header_.badInput(element.name + " " + grouped(i) + " has a list of negative length");
      if (kept == p) {
        if (length > kMaxKeptList) {
          return header_.badInput(element.name + " " + grouped(i) + " has a list of " + shortestNumber(length) +
                                  " numbers; expected at most " + shortestNumber(kMaxKeptList));
        }
        list_.clear();
        double number = 0;
        for (double k = 0; k < length && (ok = next(property.type, number)); ++k) list_.push_back(number);
      } else {
        ok = skip(property.type, length);
      }
    }
    if (!ok) {
      return header_.badInput(element.name + " " + grouped(i) + ", property " + inQuotes(property.name) + ": found " +
                              (word_.empty() ? "the end of the file" : inQuotes(word_)) + ", expected a number");
    }
  }
  return {};
}

bool Body::next(Scalar type, double& out) {
  if (header_.format == Format::Ascii) return nextWord(out);
  const size_t size = bytesOf(type);
  if (end_ - at_ < size && !fill(size)) return false;
  out = decode(buffer_.data() + at_, type, swap_);
  at_ += size;
  return true;
}

bool Body::skip(Scalar type, double count) {
  double skipped = 0;
  for (double k = 0; k < count; ++k) {
    if (!next(type, skipped)) return false;
  }
  return true;
}

bool Body::fill(size_t wanted) {
  std::copy(buffer_.begin() + static_cast<ptrdiff_t>(at_), buffer_.begin() + static_cast<ptrdiff_t>(end_), buffer_.begin());
  end_ -= at_;
  at_ = 0;
  in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  end_ += static_cast<size_t>(in_.gcount());
  return end_ >= wanted;
}

bool Body::nextWord(double& out) {
  constexpr size_t kLongest = 512;  // longer words are not numbers
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  word_.clear();
  for (;;) {
    if (at_ == end_ && !fill(1)) break;
    const char c = buffer_[at_];
    if (space(c) && !word_.empty()) break;
    if (word_.size() > kLongest) break;
    if (!space(c)) word_ += c;
    ++at_;
  }
  const std::optional<double> number = parseNumber(word_);
  out = number.value_or(0);
  return number.has_value();
}

}  // namespace rill::ply
