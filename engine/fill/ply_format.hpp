#pragma once
// The PLY format: its header, and the numbers of its body in order. ply_reader reads particles from it, scene/mesh_ply.cpp meshes.
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"

namespace rill::ply {

enum class Scalar : uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };
enum class Format : uint8_t { Ascii, Little, Big };

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

struct Header {
  std::filesystem::path file;
  Format format = Format::Ascii;
  std::vector<Element> elements;  ///< in the order of the file
  uint64_t body = 0;              ///< offset of the body, bytes
  uint64_t fileBytes = 0;

  Error badInput(const std::string& why) const { return {ErrorKind::BadInput, file.string() + ": " + why}; }
  /// Whether the rest of the file can hold the elements, so that memory may be allocated by their counts.
  Expected<void> checkCounts() const;
  /// Finds the properties `names` of a vertex, the first three of which are required. `column`: their indices; -1 if missing.
  Expected<void> findColumns(const Element& vertex, std::span<const std::string_view> names, std::span<int> column) const;
  /// Whether x y z, and vx vy vz if given, of a vertex are finite and fit a 32-bit float.
  Expected<void> checkMotion(uint64_t vertex, std::span<const double> values) const;
};

/// Opens a file and parses its header. Elements after the one called `last` are left out.
Expected<Header> readHeader(const std::filesystem::path& file, std::string_view last = {});

/// Reads the elements of a PLY body in order.
class Body {
 public:
  explicit Body(const Header& header);
  bool isOpen() const { return static_cast<bool>(in_); }

  /// Reads element `i`: numbers and the lengths of lists to `row`, and the list `kept`, if any, to list().
  Expected<void> read(const Element& element, uint64_t i, std::vector<double>& row, std::optional<size_t> kept = {});
  const std::vector<double>& list() const { return list_; }

 private:
  /// False at the end of the file, or at a word that is not a number (see word_).
  bool next(Scalar type, double& out);
  bool nextWord(double& out);
  bool fill(size_t wanted);
  bool skip(Scalar type, double count);

  const Header& header_;
  std::ifstream in_;
  bool swap_;
  std::vector<char> buffer_ = std::vector<char>(1 << 16);
  size_t at_ = 0, end_ = 0;
  std::string word_;  // the last one read; empty at the end of the file
  std::vector<double> list_;
};

}  // namespace rill::ply
