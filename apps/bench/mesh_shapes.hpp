#pragma once
// Meshes for benchmarks and tests.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "rill/mesh.hpp"

namespace rill {

/// A box of twelve triangles.
inline MeshData boxMesh(const Double3& low, const Double3& high) {
  MeshData data;
  for (size_t k = 0; k < 8; ++k) data.vertices.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
  for (const auto& [a, b, c, d] :
       {std::array<uint32_t, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    data.triangles.push_back({a, b, c});
    data.triangles.push_back({a, c, d});
  }
  return data;
}

/// A sphere around the origin: an octahedron of which each triangle is divided into four, `times` times.
inline MeshData ballMesh(double radius, int times) {
  MeshData data;
  data.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  data.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int n = 0; n < times; ++n) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [at, fresh] = middles.emplace(std::minmax(a, b), static_cast<uint32_t>(data.vertices.size()));
      if (fresh) {
        const Double3 u = data.vertices[a], v = data.vertices[b];
        data.vertices.push_back({u.x + v.x, u.y + v.y, u.z + v.z});
      }
      return at->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : data.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    data.triangles = std::move(finer);
    for (Double3& v : data.vertices) {
      const double length = std::hypot(v.x, v.y, v.z);
      for (double& x : v) x /= length;
    }
  }
  for (Double3& v : data.vertices)
    for (double& x : v) x *= radius;
  return data;
}

/// `a` and `b` together.
inline MeshData joined(MeshData a, const MeshData& b) {
  const auto first = static_cast<uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

/// An open box whose inside is from `low` to `high`, with walls and a floor of this thickness: five boxes that overlap.
inline MeshData cupMesh(const Double3& low, const Double3& high, double wall) {
  const double w = wall;
  MeshData cup = boxMesh({low.x - w, low.y - w, low.z - w}, {high.x + w, low.y, high.z + w});
  for (const double side : {low.x - w, high.x}) cup = joined(cup, boxMesh({side, low.y - w, low.z - w}, {side + w, high.y, high.z + w}));
  for (const double side : {low.z - w, high.z}) cup = joined(cup, boxMesh({low.x - w, low.y - w, side}, {high.x + w, high.y, side + w}));
  return cup;
}

/// The inside of the cup as a sheet of ten triangles without thickness.
inline MeshData openBox(const Double3& low, const Double3& high) {
  MeshData sheet = boxMesh(low, high);
  sheet.triangles.erase(sheet.triangles.begin() + 6, sheet.triangles.begin() + 8);  // the lid
  return sheet;
}

}  // namespace rill
