#pragma once
// Collects the vertices and polygons that a reader finds.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/numbers.hpp"
#include "core/words.hpp"
#include "rill/mesh.hpp"
#include "scene/mesh_readers.hpp"

namespace rill {

class MeshBuilder {
 public:
  explicit MeshBuilder(std::filesystem::path file) : file_(std::move(file)) {}

  uint64_t vertexCount() const { return mesh_.vertices.size(); }
  /// `where()`: the place in the file, for messages.
  template <class Where>
  Expected<void> addVertex(const Double3& position, const Where& where) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (!fitsFloat(position[axis])) {
        return meshError(file_, where(),
                         "the position is " + shortestNumber(position[axis]) + " along " + "xyz"[axis] +
                             ", expected a finite number that a 32-bit float can hold");
      }
    }
    if (mesh_.vertices.size() >= kMaxElements) return meshError(file_, where(), tooMany("vertices"));
    mesh_.vertices.push_back(position);
    return {};
  }

  /// The color of the triangles that follow; none at first.
  void setColor(std::optional<Float3> color);
  /// `corners`: at least three, indices of vertices. `normals`: one a corner, of any length, or empty.
  template <class Where>
  Expected<void> addPolygon(std::span<const uint32_t> corners, std::span<const Float3> normals, const Where& where) {
    if (!add(corners, normals)) return meshError(file_, where(), tooMany("triangles"));
    return {};
  }

  /// BadInput if there is no triangle.
  Expected<MeshData> finish();

 private:
  static constexpr uint64_t kMaxElements = 100'000'000;  // the nodes of a small file can repeat its meshes many times
  static std::string tooMany(const std::string& of) { return "more than " + grouped(kMaxElements) + " " + of + ", expected at most that"; }
  bool add(std::span<const uint32_t> corners, std::span<const Float3> normals);
  void normalizeNormals();

  std::filesystem::path file_;
  MeshData mesh_;
  std::optional<Float3> color_;
  bool allHaveNormals_ = true;
  std::vector<Double3> polygon_;  // of the last call, like the next
  std::vector<std::array<uint32_t, 3>> parts_;
};

}  // namespace rill
