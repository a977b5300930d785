#pragma once
// Flat meshes for mouths of emitters, in the plane z = 0, facing +z.
#include <cmath>
#include <numbers>

#include "rill/scene.hpp"
#include "support/meshes.hpp"

namespace rill::test {

inline MeshData rectMesh(double width, double height) {
  return {.vertices = {{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

/// Three squares of a side (m); the corner between its arms is at the origin.
inline MeshData cornerMesh(double side) {
  return {.vertices = {{-side, -side, 0}, {side, -side, 0}, {side, 0, 0}, {0, 0, 0}, {0, side, 0}, {-side, side, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
}

/// Between two polygons of `parts` corners.
inline MeshData ringMesh(double inner, double outer, uint32_t parts) {
  MeshData ring;
  for (uint32_t k = 0; k < parts; ++k) {
    const double angle = 2 * std::numbers::pi * k / parts, c = std::cos(angle), s = std::sin(angle);
    ring.vertices.push_back({inner * c, inner * s, 0});
    ring.vertices.push_back({outer * c, outer * s, 0});
    const uint32_t a = 2 * k, b = 2 * ((k + 1) % parts);
    ring.triangles.push_back({a, a + 1, b + 1});
    ring.triangles.push_back({a, b + 1, b});
  }
  return ring;
}
inline double ringArea(double inner, double outer, uint32_t parts) {
  return parts / 2.0 * std::sin(2 * std::numbers::pi / parts) * (outer * outer - inner * inner);
}

/// The same, moved along x and y.
inline MeshData moved(MeshData data, double x, double y) {
  for (Double3& v : data.vertices) v = {v.x + x, v.y + y, v.z};
  return data;
}

inline MeshMouth mouthOf(MeshData data) { return {.mesh = meshOf(std::move(data), true)}; }

}  // namespace rill::test
