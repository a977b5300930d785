#include "fill/ply_reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "core/words.hpp"

namespace rill {

/// Contents of a PLY header.
namespace ply {

enum class Scalar : uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };

struct Property {
  std::string name;
  Scalar type = Scalar::F32;
  std::optional<Scalar> count;  ///< type of the length, for lists
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format : uint8_t { Ascii, Little, Big };

}  // namespace ply

namespace {

namespace fs = std::filesystem;
using ply::Element, ply::Format, ply::Property, ply::Scalar;

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

/// Reads the numbers of a PLY body in order.
class Body {
 public:
  Body(std::ifstream& in, Format format)
      : in_(in), format_(format), swap_((format == Format::Little) != (std::endian::native == std::endian::little)) {}

  /// False at the end of the file, or at a word that is not a number (see word()).
  bool next(Scalar type, double& out) {
    if (format_ == Format::Ascii) return nextWord(out);
    const size_t size = bytesOf(type);
    if (end_ - at_ < size && !fill(size)) return false;
    out = decode(buffer_.data() + at_, type, swap_);
    at_ += size;
    return true;
  }
  /// The last word read; empty at the end of the file.
  const std::string& word() const { return word_; }

 private:
  bool fill(size_t wanted) {
    std::copy(buffer_.begin() + static_cast<ptrdiff_t>(at_), buffer_.begin() + static_cast<ptrdiff_t>(end_), buffer_.begin());
    end_ -= at_;
    at_ = 0;
    in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
    end_ += static_cast<size_t>(in_.gcount());
    return end_ >= wanted;
  }
  bool nextWord(double& out) {
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
    const char* begin = word_.data() + (word_.starts_with('+') ? 1 : 0);
    const char* end = word_.data() + word_.size();
    const auto read = std::from_chars(begin, end, out);
    if (read.ec == std::errc::result_out_of_range) out = std::numeric_limits<double>::infinity();
    return !word_.empty() && read.ec != std::errc::invalid_argument && read.ptr == end;
  }

  std::ifstream& in_;
  Format format_;
  bool swap_;
  std::vector<char> buffer_ = std::vector<char>(1 << 16);
  size_t at_ = 0, end_ = 0;
  std::string word_;
};

bool fitsFloat(double v) { return std::abs(v) <= std::numeric_limits<float>::max(); }  // false for NaN

}  // namespace

struct PlyFile::Header {
  fs::path file;
  Format format = Format::Ascii;
  std::vector<Element> elements;                      ///< up to and with "vertex"
  uint64_t body = 0;                                  ///< offset of the body, bytes
  std::array<int, 6> column{-1, -1, -1, -1, -1, -1};  ///< index of x y z vx vy vz among the properties of a vertex; -1: missing

  bool hasVelocity() const { return column[3] >= 0 && column[4] >= 0 && column[5] >= 0; }
  Error badInput(const std::string& why) const { return {ErrorKind::BadInput, file.string() + ": " + why}; }
  Expected<void> parse(std::ifstream& in);
  Expected<void> parseLine(const std::string& line, bool& vertex_done, bool& format_seen);
  Expected<void> validate(uint64_t fileBytes);
};

Expected<void> PlyFile::Header::parseLine(const std::string& line, bool& vertex_done, bool& format_seen) {
  std::istringstream words(line);
  std::string keyword, a, b, c, d;
  words >> keyword >> a >> b >> c >> d;
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return {};
  if (keyword == "format") {
    if (a == "ascii")
      format = Format::Ascii;
    else if (a == "binary_little_endian")
      format = Format::Little;
    else if (a == "binary_big_endian")
      format = Format::Big;
    else
      return badInput("the format is " + inQuotes(a) + "; expected ascii, binary_little_endian or binary_big_endian");
    if (b != "1.0") return badInput("the format's version is " + inQuotes(b) + "; expected 1.0");
    format_seen = true;
    return {};
  }
  if (keyword == "element") {
    vertex_done = !elements.empty() && elements.back().name == "vertex";
    if (vertex_done) return {};
    Element element{a, 0, {}};
    const auto read = std::from_chars(b.data(), b.data() + b.size(), element.count);
    if (a.empty() || b.empty() || read.ec != std::errc() || read.ptr != b.data() + b.size()) {
      return badInput("the header line " + inQuotes(line) + " has no count; expected element NAME COUNT");
    }
    elements.push_back(std::move(element));
    return {};
  }
  if (keyword == "property") {
    if (vertex_done) return {};
    if (elements.empty()) return badInput("the header line " + inQuotes(line) + " comes before any element");
    Property property;
    std::optional<Scalar> type = scalarNamed(a == "list" ? c : a), count;
    if (a == "list") count = scalarNamed(b);
    property.name = a == "list" ? d : b;
    if (!type || (a == "list" && !count) || property.name.empty()) {
      return badInput("the header line " + inQuotes(line) + " is invalid; expected property TYPE NAME with a type such as float or uint");
    }
    property.type = *type;
    property.count = count;
    elements.back().properties.push_back(std::move(property));
    return {};
  }
  return badInput("the header line " + inQuotes(line) + " is invalid; expected format, element, property, comment or end_header");
}

Expected<void> PlyFile::Header::parse(std::ifstream& in) {
  constexpr size_t kMaxBytes = 1 << 20;  // of a header
  std::string line;
  bool vertex_done = false, format_seen = false, first = true;
  const std::string notPly = "does not begin with \"ply\"; expected a PLY file";  // without the content: it may be any file's
  for (;;) {
    line.clear();
    char c = 0;
    while (in.get(c) && c != '\n' && ++body <= kMaxBytes) line += c;
    ++body;
    if (body > kMaxBytes || !in) return badInput(first ? notPly : "the header has no end; expected a line end_header");
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (first) {
      if (line != "ply") return badInput(notPly);
      first = false;
      continue;
    }
    if (line == "end_header") break;
    if (auto ok = parseLine(line, vertex_done, format_seen); !ok) return ok;
  }
  if (!format_seen) return badInput("the header has no format line; expected format ascii, binary_little_endian or binary_big_endian 1.0");
  return {};
}

Expected<void> PlyFile::Header::validate(uint64_t fileBytes) {
  if (elements.empty() || elements.back().name != "vertex")
    return badInput("the header has no vertex element; expected one with x, y and z");
  constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "vx", "vy", "vz"};
  const Element& vertex = elements.back();
  for (size_t i = 0; i < vertex.properties.size(); ++i) {
    for (size_t k = 0; k < kNames.size(); ++k) {
      if (vertex.properties[i].name != kNames[k]) continue;
      if (vertex.properties[i].count) return badInput("the vertex property " + inQuotes(kNames[k]) + " is a list; expected a number");
      if (column[k] >= 0) return badInput("the vertex property " + inQuotes(kNames[k]) + " is declared twice; expected it once");
      column[k] = static_cast<int>(i);
    }
  }
  for (size_t k = 0; k < 3; ++k) {
    if (column[k] < 0) return badInput("the vertices have no property " + inQuotes(kNames[k]) + "; expected x, y and z");
  }
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

PlyFile::PlyFile(std::unique_ptr<Header> header) : header_(std::move(header)) {}
PlyFile::PlyFile(PlyFile&&) noexcept = default;
PlyFile& PlyFile::operator=(PlyFile&&) noexcept = default;
PlyFile::~PlyFile() = default;

uint64_t PlyFile::count() const { return header_->elements.back().count; }

Expected<PlyFile> PlyFile::open(const fs::path& file) {
  auto header = std::make_unique<Header>();
  header->file = file;
  std::error_code trouble;
  const fs::file_status status = fs::status(file, trouble);
  if (!fs::exists(status)) return header->badInput("no such file");
  if (!fs::is_regular_file(status)) return header->badInput("not a regular file; expected a PLY file");
  const uint64_t size = fs::file_size(file, trouble);
  std::ifstream in(file, std::ios::binary);
  if (!in || trouble) return header->badInput("cannot be opened; expected a readable PLY file");
  if (auto ok = header->parse(in); !ok) return ok.error();
  if (auto ok = header->validate(size); !ok) return ok.error();
  return PlyFile(std::move(header));
}

Expected<PlyParticles> PlyFile::read() const {
  const Header& header = *header_;
  std::ifstream in(header.file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(header.body));
  if (!in) return header.badInput("cannot be read");
  Body body(in, header.format);
  PlyParticles out;
  std::vector<double> row;
  for (const Element& element : header.elements) {
    const bool vertex = element.name == "vertex";
    if (element.properties.empty()) continue;
    row.assign(element.properties.size(), 0.0);
    if (vertex) out.positions.reserve(element.count);
    if (vertex && header.hasVelocity()) out.velocities.reserve(element.count);
    for (uint64_t i = 0; i < element.count; ++i) {
      for (size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        bool ok = body.next(property.count.value_or(property.type), row[p]);
        if (ok && property.count) {
          const double length = row[p];
          if (!(length >= 0)) return header.badInput(element.name + " " + grouped(i) + " has a list of negative length");
          double skipped = 0;
          for (double k = 0; ok && k < length; ++k) ok = body.next(property.type, skipped);
        }
        if (!ok) {
          return header.badInput(element.name + " " + grouped(i) + ", property " + inQuotes(property.name) + ": found " +
                                 (body.word().empty() ? "the end of the file" : inQuotes(body.word())) + ", expected a number");
        }
      }
      if (!vertex) continue;
      const auto at = [&](size_t k) { return row[static_cast<size_t>(header.column[k])]; };
      for (size_t k = 0; k < (header.hasVelocity() ? 6U : 3U); ++k) {
        if (!fitsFloat(at(k))) {
          return header.badInput("vertex " + grouped(i) + ": " + (k < 3 ? "the position" : "the velocity") + " is " +
                                 shortestNumber(at(k)) + " along " + "xyz"[k % 3] +
                                 "; expected a finite number that a 32-bit float can hold");
        }
      }
      out.positions.push_back({at(0), at(1), at(2)});
      if (header.hasVelocity()) out.velocities.push_back({static_cast<float>(at(3)), static_cast<float>(at(4)), static_cast<float>(at(5))});
    }
  }
  return out;
}

}  // namespace rill
