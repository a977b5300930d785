#include "core/mesh_plane.hpp"

#include <algorithm>
#include <cmath>

#include "core/vector_math.hpp"

namespace rill {
namespace {

/// Calls visit(corners) for each triangle.
template <class Visit>
void forEachTriangle(const MeshData& data, const Visit& visit) {
  for (const auto& [a, b, c] : data.triangles) visit(std::array{data.vertices[a], data.vertices[b], data.vertices[c]});
}

/// m^2, along the normal of a triangle.
Double3 areaVector(const std::array<Double3, 3>& t) { return along({}, 0.5, cross(minus(t[1], t[0]), minus(t[2], t[0]))); }

}  // namespace

MeshPlane planeOf(const MeshData& data) {
  MeshPlane plane;
  if (data.triangles.empty()) return plane;
  const Double3 origin = data.vertices[data.triangles[0][0]];
  Double3 low = origin, high = origin, sum, moment;
  double all = 0;
  forEachTriangle(data, [&](const std::array<Double3, 3>& t) {
    const Double3 area = areaVector(t);
    sum = along(sum, 1, area);
    all += length(area);
    for (const Double3& corner : t) {
      moment = along(moment, length(area) / 3, minus(corner, origin));
      for (size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], corner[a]), high[a] = std::max(high[a], corner[a]);
    }
  });
  constexpr double kRounding = 1e-12;
  plane.size = length(minus(high, low));
  plane.center = all > 0 ? along(origin, 1 / all, moment) : origin;
  if (!(all > kRounding * plane.size * plane.size)) return plane;
  plane.total = all;
  plane.area = length(sum);
  if (!(plane.area > kRounding * all)) return plane;
  plane.normal = normalized(sum);
  forEachTriangle(data, [&](const std::array<Double3, 3>& t) {
    for (const Double3& corner : t) {
      const double off = std::abs(dot(minus(corner, plane.center), plane.normal));
      if (off > plane.offPlane) plane.offPlane = off, plane.farthest = corner;
    }
    const double facing = dot(areaVector(t), plane.normal);
    if (facing >= 0) return;
    if (plane.against == 0) plane.firstAgainst = along(along(along({}, 1.0 / 3, t[0]), 1.0 / 3, t[1]), 1.0 / 3, t[2]);
    plane.against -= facing;
  });
  return plane;
}

}  // namespace rill
