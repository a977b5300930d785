#pragma once
// Triangle meshes: the shape of a solid, or of a fill.
//
//   rill::MeshData tetrahedron;
//   tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
//   tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};  // counterclockwise, seen from outside
//   auto mesh = rill::Mesh::create(std::move(tetrahedron));
//   if (!mesh) return fail(mesh.error().message);
//   scene.solids = {rill::Solid{.shape = rill::MeshShape{.mesh = *mesh}, .translation = {0.5, 0, 0.5}}};
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// Triangles as a file or a host has them.
struct MeshData {
  std::vector<Double3> vertices = {};                   ///< m; equal ones are one vertex
  std::vector<std::array<uint32_t, 3>> triangles = {};  ///< indices of vertices, counterclockwise seen from outside
  std::vector<Float3> normals = {};                     ///< of the corners, three a triangle, for shading; empty: from the triangles
  std::vector<Float3> colors = {};                      ///< base color of each triangle, linear RGB, 0 .. 1; empty: the default
};

struct MeshImpl;

/// A checked mesh that solids and fills share. It does not change.
class Mesh {
 public:
  /// Checks and repairs `data`: triangles with fewer than three vertices are dropped, and triangles that face against their
  /// neighbors, or parts that are inside out, are turned. A point is inside where the winding number is not 0: closed parts may
  /// overlap. `twoSided`: a sheet, which may have open edges and encloses nothing.
  /// BadInput, with the number or the place of the triangle, where an index or a coordinate is out of range, where there is no triangle,
  /// and, unless `twoSided`, for an open edge or where no volume is enclosed.
  RILL_API static Expected<std::shared_ptr<const Mesh>> create(MeshData data, bool twoSided = false);
  RILL_API ~Mesh();
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;

  RILL_API const MeshData& data() const;  ///< after the repair
  RILL_API bool twoSided() const;
  RILL_API Double3 min() const;    ///< lowest corner of the bounds, m
  RILL_API Double3 max() const;    ///< highest corner, m
  RILL_API double volume() const;  ///< m^3, of all closed parts: where they overlap it counts twice; 0 if two-sided
  RILL_API const std::vector<std::string>& warnings() const;  ///< what was repaired

 private:
  friend struct ImplAccess;
  explicit Mesh(std::unique_ptr<MeshImpl> impl);
  std::unique_ptr<MeshImpl> impl_;
};

}  // namespace rill
