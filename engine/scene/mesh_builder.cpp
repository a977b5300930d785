#include "scene/mesh_builder.hpp"

#include <algorithm>
#include <cmath>

#include "scene/polygon.hpp"

namespace rill {
namespace {

constexpr Float3 kUncolored{1, 1, 1};  // glTF's default, for triangles of a mesh that has colors elsewhere

/// Of unit length; zero if it has no direction.
Float3 unitVector(double x, double y, double z) {
  const double length = std::hypot(x, y, z);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

Float3 triangleNormal(const Double3& a, const Double3& b, const Double3& c) {
  const Double3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
  return unitVector(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
}

}  // namespace

void MeshBuilder::setColor(std::optional<Float3> color) {
  color_ = color;
  if (!color_) return;
  for (float& channel : *color_) channel = std::clamp(channel, 0.0F, 1.0F);
}

bool MeshBuilder::add(std::span<const uint32_t> corners, std::span<const Float3> normals) {
  if (mesh_.triangles.size() + corners.size() - 2 > kMaxElements) return false;
  polygon_.clear();
  for (const uint32_t corner : corners) polygon_.push_back(mesh_.vertices[corner]);
  triangulate(polygon_, parts_);
  if (color_ && mesh_.colors.empty()) mesh_.colors.assign(mesh_.triangles.size(), kUncolored);
  allHaveNormals_ = allHaveNormals_ && !normals.empty();
  for (const auto& part : parts_) {
    mesh_.triangles.push_back({corners[part[0]], corners[part[1]], corners[part[2]]});
    if (color_ || !mesh_.colors.empty()) mesh_.colors.push_back(color_.value_or(kUncolored));
    if (!allHaveNormals_) continue;
    for (const uint32_t corner : part) mesh_.normals.push_back(normals[corner]);
  }
  return true;
}

void MeshBuilder::normalizeNormals() {
  for (size_t k = 0; k < mesh_.normals.size(); ++k) {
    Float3& normal = mesh_.normals[k];
    normal = unitVector(normal.x, normal.y, normal.z);
    if (normal != Float3{}) continue;
    const auto& triangle = mesh_.triangles[k / 3];
    normal = triangleNormal(mesh_.vertices[triangle[0]], mesh_.vertices[triangle[1]], mesh_.vertices[triangle[2]]);
    if (normal == Float3{}) normal = {0, 0, 1};  // of a triangle without area
  }
}

Expected<MeshData> MeshBuilder::finish() {
  if (mesh_.triangles.empty()) return Error{ErrorKind::BadInput, file_.string() + ": found no triangle, expected at least one"};
  if (!allHaveNormals_) mesh_.normals.clear();
  normalizeNormals();
  return std::move(mesh_);
}

}  // namespace rill
