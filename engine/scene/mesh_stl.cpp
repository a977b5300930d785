// STL, binary (by its size) or ASCII.
#include <array>
#include <bit>
#include <optional>

#include "scene/mesh_builder.hpp"
#include "scene/text_lines.hpp"

namespace rill {
namespace {

constexpr uint64_t kStlHeader = 80, kStlTriangle = 50, kStlStart = kStlHeader + 4;  // bytes

uint32_t littleEndianWord(std::string_view bytes, uint64_t at) {
  uint32_t word = 0;
  for (uint64_t k = 4; k-- > 0;) word = word << 8U | static_cast<uint8_t>(bytes[at + k]);
  return word;
}

Expected<MeshData> readBinaryStl(std::string_view bytes, const std::filesystem::path& file) {
  MeshBuilder mesh(file);
  const uint64_t count = littleEndianWord(bytes, kStlHeader);
  for (uint64_t i = 0; i < count; ++i) {
    const auto where = [&] { return "triangle " + grouped(i); };
    const auto first = static_cast<uint32_t>(3 * i);
    for (uint64_t corner = 0; corner < 3; ++corner) {
      const uint64_t at = kStlStart + kStlTriangle * i + 12 + 12 * corner;  // after the normal
      Double3 position;
      for (uint64_t axis = 0; axis < 3; ++axis) position[axis] = std::bit_cast<float>(littleEndianWord(bytes, at + 4 * axis));
      if (auto ok = mesh.addVertex(position, where); !ok) return ok.error();
    }
    if (auto ok = mesh.addPolygon(std::array{first, first + 1, first + 2}, {}, where); !ok) return ok.error();
  }
  return mesh.finish();
}

/// solid NAME { facet normal X Y Z  outer loop  { vertex X Y Z } three times  endloop  endfacet } endsolid NAME, any number of times.
class AsciiStl {
 public:
  AsciiStl(std::string_view bytes, const std::filesystem::path& file) : file_(file), mesh_(file), lines_(bytes) {}

  Expected<MeshData> read() {
    while (auto word = next()) {
      if (!is(*word, "solid")) return unexpected(*word, "solid, or the end of the file");
      line_ = {};  // the name
      if (auto ok = readSolid(); !ok) return ok.error();
    }
    return mesh_.finish();
  }

 private:
  Expected<void> readSolid() {
    for (;;) {
      const std::string_view word = next().value_or("");
      if (is(word, "endsolid")) break;
      if (!is(word, "facet")) return unexpected(word, "facet or endsolid");
      if (auto ok = readFacet(); !ok) return ok;
    }
    line_ = {};
    return {};
  }

  Expected<void> readFacet() {
    Double3 normal;
    if (auto ok = expect("normal"); !ok) return ok;
    if (auto ok = numbers(normal); !ok) return ok;
    if (auto ok = expect("outer"); !ok) return ok;
    if (auto ok = expect("loop"); !ok) return ok;
    const auto first = static_cast<uint32_t>(mesh_.vertexCount());
    const auto where = [&] { return here(); };
    for (int corner = 0; corner < 3; ++corner) {
      Double3 position;
      if (auto ok = expect("vertex"); !ok) return ok;
      if (auto ok = numbers(position); !ok) return ok;
      if (auto ok = mesh_.addVertex(position, where); !ok) return ok;
    }
    if (auto ok = expect("endloop"); !ok) return ok;
    if (auto ok = expect("endfacet"); !ok) return ok;
    return mesh_.addPolygon(std::array{first, first + 1, first + 2}, {}, where);
  }

  std::optional<std::string_view> next() {
    for (;;) {
      const std::string_view word = takeWord(line_);
      if (!word.empty()) return word;
      if (!lines_.next(line_)) return {};
    }
  }
  Expected<void> expect(std::string_view keyword) {
    const std::string_view word = next().value_or("");
    if (!is(word, keyword)) return unexpected(word, std::string(keyword));
    return {};
  }
  Expected<void> numbers(Double3& out) {
    for (double& number : out) {
      const std::string_view word = next().value_or("");
      const auto parsed = parseNumber(word);
      if (!parsed) return unexpected(word, "a number");
      number = *parsed;
    }
    return {};
  }
  static bool is(std::string_view word, std::string_view keyword) {  // in any case
    return word.size() == keyword.size() &&
           std::equal(word.begin(), word.end(), keyword.begin(), [](char a, char b) { return (a | 32) == b; });
  }
  std::string here() const { return "line " + grouped(lines_.number()); }
  Error unexpected(std::string_view word, const std::string& expected) const {
    return meshError(file_, here(), "found " + (word.empty() ? "the end of the file" : inQuotes(word)) + ", expected " + expected);
  }

  const std::filesystem::path& file_;
  MeshBuilder mesh_;
  TextLines lines_;
  std::string_view line_;
};

}  // namespace

Expected<MeshData> readStl(std::string_view bytes, const std::filesystem::path& file) {
  const uint64_t needed = bytes.size() < kStlStart ? 0 : kStlStart + kStlTriangle * littleEndianWord(bytes, kStlHeader);
  if (needed > 0 && bytes.size() == needed) return readBinaryStl(bytes, file);
  std::string_view start = bytes.substr(0, std::min<size_t>(bytes.size(), 256));
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  if (start.starts_with("solid") || start.starts_with("SOLID")) return AsciiStl(bytes, file).read();
  if (needed == 0)
    return meshError(file, "header", "found " + grouped(bytes.size()) + " bytes, expected \"solid\" or a binary STL file of at least 84");
  if (bytes.size() < needed) {
    return meshError(file, "header",
                     "declares " + grouped(littleEndianWord(bytes, kStlHeader)) + " triangles, found " + grouped(bytes.size()) +
                         " bytes, expected " + grouped(needed));
  }
  return readBinaryStl(bytes, file);  // bytes after the triangles are ignored
}

}  // namespace rill
