#include "shape/thin_parts.hpp"

#include "core/vector_math.hpp"
#include "shape/mesh_impl.hpp"

namespace rill {

std::optional<ThinPart> thinnestPart(const Mesh& mesh, double limit) {
  if (mesh.twoSided()) return std::nullopt;
  const MeshData& data = mesh.data();
  const TriangleTree& tree = implOf(mesh).tree;
  const double aside = 1e-3 * limit;
  ThinPart thin{.thickness = limit};
  for (const auto& [a, b, c] : data.triangles) {
    const Double3 &u = data.vertices[a], &v = data.vertices[b], &w = data.vertices[c];
    const Double3 twiceArea = cross(minus(w, u), minus(v, u));  // inward
    const double area = length(twiceArea);
    if (!(area > 0)) continue;
    const Double3 inward = along({}, 1 / area, twiceArea), middle = along(along(along({}, 1.0 / 3, u), 1.0 / 3, v), 1.0 / 3, w);
    const auto behind = tree.firstHit(along(middle, aside, inward), inward);
    if (!behind || *behind + aside >= limit) continue;
    // Faces inside of another part of the mesh are no surface.
    const double thickness = *behind + aside;
    if (tree.winding(along(middle, -aside, inward)) != 0 || tree.winding(along(middle, thickness + aside, inward)) != 0) continue;
    ++thin.triangles;
    if (thickness < thin.thickness) thin.place = middle, thin.thickness = thickness;
  }
  return thin.triangles > 0 ? std::optional(thin) : std::nullopt;
}

}  // namespace rill
