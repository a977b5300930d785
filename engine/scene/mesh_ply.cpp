// Meshes in PLY files: vertices with x y z, and nx ny nz if present; faces with a list vertex_indices or vertex_index.
#include <array>
#include <cmath>

#include "fill/ply_format.hpp"
#include "scene/mesh_builder.hpp"

namespace rill {
namespace {

class PlyMesh {
 public:
  explicit PlyMesh(ply::Header header) : header_(std::move(header)), mesh_(header_.file) {}

  Expected<MeshData> read() {
    if (auto ok = findElements(); !ok) return ok.error();
    if (auto ok = header_.checkCounts(); !ok) return ok.error();
    ply::Body body(header_);
    if (!body.isOpen()) return header_.badInput("cannot be read");
    for (const ply::Element& element : header_.elements) {
      if (element.properties.empty()) continue;
      for (uint64_t i = 0; i < element.count; ++i) {
        const bool face = &element == face_;
        if (auto ok = body.read(element, i, row_, face ? std::optional(indices_) : std::nullopt); !ok) return ok.error();
        if (&element == vertex_)
          if (auto ok = addVertex(i); !ok) return ok.error();
        if (!face) continue;
        if (auto ok = addFace(i, body.list()); !ok) return ok.error();
      }
      if (&element == face_) break;
    }
    return mesh_.finish();
  }

 private:
  Expected<void> findElements() {
    constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
    for (const ply::Element& element : header_.elements) {
      if (!vertex_ && element.name == "vertex") vertex_ = &element;
      if (vertex_ && !face_ && element.name == "face") face_ = &element;
    }
    if (!vertex_) return header_.badInput("the header has no vertex element; expected one with x, y and z");
    if (!face_) return header_.badInput("the header has no face element after the vertices; expected one with vertex_indices");
    if (auto ok = header_.findColumns(*vertex_, kNames, column_); !ok) return ok;
    hasNormals_ = column_[3] >= 0 && column_[4] >= 0 && column_[5] >= 0;
    for (size_t p = 0; p < face_->properties.size(); ++p) {
      const ply::Property& property = face_->properties[p];
      if (!property.count || (property.name != "vertex_indices" && property.name != "vertex_index")) continue;
      indices_ = p;
      return {};
    }
    return header_.badInput("the faces have no list property \"vertex_indices\"; expected one");
  }

  Expected<void> addVertex(uint64_t i) {
    const auto at = [&](size_t k) { return row_[static_cast<size_t>(column_[k])]; };
    const auto where = [&] { return "vertex " + grouped(i); };
    if (hasNormals_) {
      for (size_t k = 3; k < 6; ++k) {
        if (!fitsFloat(at(k)))
          return meshError(header_.file, where(), "the normal is " + shortestNumber(at(k)) + ", expected finite numbers");
      }
      normals_.push_back({static_cast<float>(at(3)), static_cast<float>(at(4)), static_cast<float>(at(5))});
    }
    return mesh_.addVertex({at(0), at(1), at(2)}, where);
  }

  Expected<void> addFace(uint64_t i, const std::vector<double>& list) {
    const auto where = [&] { return "face " + grouped(i); };
    if (list.size() < 3) return meshError(header_.file, where(), "found " + grouped(list.size()) + " vertices, expected three or more");
    corners_.clear();
    cornerNormals_.clear();
    for (const double index : list) {
      if (!(index >= 0 && index < static_cast<double>(mesh_.vertexCount())) || index != std::floor(index)) {
        return meshError(header_.file, where(),
                         "found the vertex index " + shortestNumber(index) + ", expected a whole number from 0 and below " +
                             grouped(mesh_.vertexCount()));
      }
      corners_.push_back(static_cast<uint32_t>(index));
      if (hasNormals_) cornerNormals_.push_back(normals_[corners_.back()]);
    }
    return mesh_.addPolygon(corners_, cornerNormals_, where);
  }

  ply::Header header_;
  MeshBuilder mesh_;
  const ply::Element *vertex_ = nullptr, *face_ = nullptr;
  std::array<int, 6> column_{};  // of x y z nx ny nz
  size_t indices_ = 0;           // property of the faces
  bool hasNormals_ = false;
  std::vector<Float3> normals_;  // of the vertices
  std::vector<double> row_;
  std::vector<uint32_t> corners_;
  std::vector<Float3> cornerNormals_;
};

}  // namespace

Expected<MeshData> readPlyMesh(const std::filesystem::path& file) {
  auto header = ply::readHeader(file);
  if (!header) return header.error();
  if (header->fileBytes > kMaxMeshBytes)
    return header->badInput(grouped(header->fileBytes) + " bytes; expected at most " + grouped(kMaxMeshBytes));
  return PlyMesh(std::move(*header)).read();
}

}  // namespace rill
