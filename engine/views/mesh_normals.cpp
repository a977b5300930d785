#include "views/mesh_normals.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/disjoint_sets.hpp"
#include "shape/mesh_edges.hpp"

namespace rill {
namespace {
namespace mesh_normals {

constexpr double kSmoothCosine = 0.766;  // of 40 degrees

glm::dvec3 point(const MeshData& data, uint32_t vertex) {
  const Double3& v = data.vertices[vertex];
  return {v.x, v.y, v.z};
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

Float3 stored(const glm::dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

std::vector<glm::dvec3> faceNormals(const MeshData& data) {
  std::vector<glm::dvec3> faces;
  faces.reserve(data.triangles.size());
  for (const auto& [a, b, c] : data.triangles) {
    const glm::dvec3 u = unitOrZero(point(data, b) - point(data, a)), v = unitOrZero(point(data, c) - point(data, a));
    faces.push_back(unitOrZero(glm::cross(u, v)));
  }
  return faces;
}

/// Joins the corners on both sides of an edge that is smooth.
void joinAcross(const MeshEdge& a, const MeshEdge& b, const std::vector<Triangle>& triangles, DisjointSets& sets) {
  for (const uint32_t k : {a.corner, (a.corner + 1) % 3})
    for (const uint32_t n : {b.corner, (b.corner + 1) % 3})
      if (triangles[a.triangle][k] == triangles[b.triangle][n]) sets.join(3 * a.triangle + k, 3 * b.triangle + n);
}

double angleAt(const MeshData& data, const Triangle& triangle, size_t corner) {
  const glm::dvec3 at = point(data, triangle[corner]);
  const glm::dvec3 u = unitOrZero(point(data, triangle[(corner + 1) % 3]) - at),
                   v = unitOrZero(point(data, triangle[(corner + 2) % 3]) - at);
  return std::acos(std::clamp(glm::dot(u, v), -1.0, 1.0));
}

}  // namespace mesh_normals
}  // namespace

std::vector<Float3> cornerNormals(const MeshData& data) {
  using namespace mesh_normals;
  const std::vector<glm::dvec3> faces = faceNormals(data);
  DisjointSets sets(3 * faces.size());
  forEachGroup(sortedEdges(data.triangles), [&](std::span<const MeshEdge> group) {
    const MeshEdge &a = group.front(), &b = group.back();
    if (group.size() == 2 && glm::dot(faces[a.triangle], faces[b.triangle]) > kSmoothCosine) joinAcross(a, b, data.triangles, sets);
    return true;
  });
  std::vector<glm::dvec3> sums(3 * faces.size(), glm::dvec3(0));
  for (uint32_t corner = 0; corner < sums.size(); ++corner)
    sums[sets.root(corner)] += angleAt(data, data.triangles[corner / 3], corner % 3) * faces[corner / 3];
  std::vector<Float3> normals(sums.size());
  for (uint32_t corner = 0; corner < sums.size(); ++corner) {
    glm::dvec3 normal = unitOrZero(sums[sets.root(corner)]);
    if (!data.normals.empty()) {
      const Float3& own = data.normals[corner];
      const double length = glm::length(glm::dvec3(own.x, own.y, own.z));
      if (length > 0 && std::isfinite(length)) normal = glm::dvec3(own.x, own.y, own.z) / length;
    }
    if (normal == glm::dvec3(0)) normal = faces[corner / 3];
    normals[corner] = stored(normal == glm::dvec3(0) ? glm::dvec3(0, 1, 0) : normal);
  }
  return normals;
}

}  // namespace rill
