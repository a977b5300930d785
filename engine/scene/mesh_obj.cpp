// Wavefront OBJ by tinyobjloader, which skips what it does not understand: the lines are checked before.
#include <algorithm>
#include <array>
#include <charconv>
#include <istream>
#include <limits>
#include <sstream>
#include <streambuf>

#include "scene/json_text.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/sibling_file.hpp"
#include "scene/text_lines.hpp"

// A host may have the library, too: it gets a namespace of its own here.
#define tinyobj rill_tinyobj
#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

namespace rill {
namespace {

enum ObjIndex : size_t { kObjPosition, kObjTexture, kObjNormal };
constexpr std::array<std::string_view, 3> kObjKeywords{"v", "vt", "vn"};

/// Checks the numbers of "v" and "vn" and the indices of "f".
class ObjCheck {
 public:
  ObjCheck(std::string_view bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {}

  Expected<void> run() {
    TextLines lines(bytes_);
    for (std::string_view line; lines.next(line);) {
      line_ = lines.number();
      if (line.find('\0') != std::string_view::npos) return fault("found a zero byte, expected text");
      const std::string_view keyword = takeWord(line);
      Expected<void> ok;
      if (keyword == "v" || keyword == "vn") ok = checkNumbers(line);
      if (keyword == "f") ok = checkFace(line);
      if (!ok) return ok;
      for (size_t kind = 0; kind < 3; ++kind) count_[kind] += keyword == kObjKeywords[kind];
    }
    return {};
  }

 private:
  Expected<void> checkNumbers(std::string_view line) const {
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = takeWord(line);
      const auto number = parseNumber(word);
      if (!number || !fitsFloat(*number))
        return fault("found " + (word.empty() ? "the end of the line" : inQuotes(word)) +
                     ", expected a finite number that a 32-bit float can hold");
    }
    return {};
  }

  Expected<void> checkFace(std::string_view line) const {
    size_t corners = 0;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line), ++corners) {
      std::string_view rest = word;
      for (size_t kind = 0; kind < 3; ++kind) {
        const std::string_view part = rest.substr(0, rest.find('/'));
        const bool omitted = kind == kObjTexture && part.empty() && rest.size() > 1;  // "1//3"
        if (!omitted && !isIndex(part, kind)) return fault(badCorner(word, kind));
        if (part.size() == rest.size()) break;
        if (kind == kObjNormal) return fault("found " + inQuotes(word) + ", expected a corner such as 1, 1/2, 1//3 or 1/2/3");
        rest.remove_prefix(part.size() + 1);
      }
    }
    if (corners < 3) return fault("found a face of " + grouped(corners) + " vertices, expected three or more");
    return {};
  }

  /// From 1, or from -1 back, of the lines so far; within an int, which tinyobjloader reads.
  bool isIndex(std::string_view part, size_t kind) const {
    int64_t index = 0;
    const auto read = std::from_chars(part.data(), part.data() + part.size(), index);
    if (read.ec != std::errc() || read.ptr != part.data() + part.size()) return false;
    const auto count = static_cast<int64_t>(std::min<uint64_t>(count_[kind], std::numeric_limits<int>::max()));
    return index != 0 && index <= count && index >= -count;
  }

  std::string badCorner(std::string_view word, size_t kind) const {
    return "found the corner " + inQuotes(word) + ", expected indices of the " + grouped(count_[kind]) + " lines " +
           inQuotes(kObjKeywords[kind]) + " before it, from 1";
  }
  Error fault(const std::string& what) const { return meshError(file_, "line " + grouped(line_), what); }

  std::string_view bytes_;
  const std::filesystem::path& file_;
  uint64_t line_ = 0;
  std::array<uint64_t, 3> count_{};  // lines of each keyword so far
};

/// Input from bytes that are not copied.
class ByteBuffer : public std::streambuf {
 public:
  explicit ByteBuffer(std::string_view bytes) {
    char* begin = const_cast<char*>(bytes.data());  // setg() wants it; nothing is written
    setg(begin, begin, begin + bytes.size());
  }
};

/// Reads materials from files beside the mesh; a missing one means no colors.
class ObjMaterials : public tinyobj::MaterialReader {
 public:
  explicit ObjMaterials(const std::filesystem::path& file) : file_(file) {}
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* indices,
                  std::string* warning, std::string* error) override {
    const auto text = readSibling(file_, name, kMaxSceneBytes);
    if (!text || text->find('\0') != std::string::npos) return false;
    std::istringstream in(*text);
    tinyobj::LoadMtl(indices, materials, &in, warning, error);
    return true;
  }

 private:
  const std::filesystem::path& file_;
};

/// Receives what tinyobjloader reads. Indices are valid: they have been checked.
class ObjMesh {
 public:
  explicit ObjMesh(const std::filesystem::path& file) : mesh_(file) {}

  static tinyobj::callback_t callbacks() {
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* mesh, double x, double y, double z, double) { of(mesh).addVertex({x, y, z}); };
    calls.normal_cb = [](void* mesh, double x, double y, double z) {
      of(mesh).normals_.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    };
    calls.index_cb = [](void* mesh, tinyobj::index_t* corners, int count) { of(mesh).addFace({corners, static_cast<size_t>(count)}); };
    calls.usemtl_cb = [](void* mesh, const char*, int material) { of(mesh).useMaterial(material); };
    calls.mtllib_cb = [](void* mesh, const tinyobj::material_t* materials, int count) {
      of(mesh).setMaterials({materials, static_cast<size_t>(count)});
    };
    return calls;
  }
  Expected<MeshData> finish() { return result_ ? mesh_.finish() : result_.error(); }

 private:
  static ObjMesh& of(void* mesh) { return *static_cast<ObjMesh*>(mesh); }

  void addVertex(const Double3& position) {
    if (result_) result_ = mesh_.addVertex(position, [&] { return "vertex " + grouped(mesh_.vertexCount() + 1); });
  }
  void addFace(std::span<const tinyobj::index_t> face) {
    corners_.clear();
    cornerNormals_.clear();
    for (const tinyobj::index_t& corner : face) {
      corners_.push_back(place(corner.vertex_index, mesh_.vertexCount()));
      if (corner.normal_index != 0) cornerNormals_.push_back(normals_[place(corner.normal_index, normals_.size())]);
    }
    if (cornerNormals_.size() != corners_.size()) cornerNormals_.clear();
    ++faces_;
    if (result_) result_ = mesh_.addPolygon(corners_, cornerNormals_, [&] { return "face " + grouped(faces_); });
  }
  void useMaterial(int material) {
    if (material >= 0 && static_cast<size_t>(material) < diffuse_.size())
      mesh_.setColor(diffuse_[static_cast<size_t>(material)]);
    else
      mesh_.setColor({});
  }
  void setMaterials(std::span<const tinyobj::material_t> materials) {
    diffuse_.clear();
    for (const tinyobj::material_t& material : materials) {
      const auto& d = material.diffuse;
      diffuse_.push_back({static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])});
    }
  }
  /// Indices start at 1, or go back from the end.
  static uint32_t place(int index, uint64_t count) {
    return index > 0 ? static_cast<uint32_t>(index - 1) : static_cast<uint32_t>(count + static_cast<uint64_t>(int64_t{index}));
  }

  MeshBuilder mesh_;
  std::vector<Float3> normals_, diffuse_;  // diffuse_: of the materials
  std::vector<uint32_t> corners_;          // of the last face, like the next
  std::vector<Float3> cornerNormals_;
  uint64_t faces_ = 0;
  Expected<void> result_;
};

}  // namespace

Expected<MeshData> readObj(std::string_view bytes, const std::filesystem::path& file) {
  if (auto ok = ObjCheck(bytes, file).run(); !ok) return ok.error();
  ByteBuffer buffer(bytes);
  std::istream in(&buffer);
  ObjMaterials materials(file);
  ObjMesh mesh(file);
  std::string warnings, errors;
  tinyobj::LoadObjWithCallback(in, ObjMesh::callbacks(), &mesh, &materials, &warnings, &errors);
  return mesh.finish();
}

}  // namespace rill
