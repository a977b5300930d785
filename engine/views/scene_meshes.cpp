#include "views/scene_meshes.hpp"

#include <cmath>
#include <cstring>
#include <map>

#include "views/mesh_normals.hpp"
#include "views/scenery_mesh_records.h"

namespace rill {
namespace {

struct MeshPush {
  surface::SurfacePush view;
  uint32_t part = 0;
};
static_assert(sizeof(MeshPush) <= 128);

/// As two signed numbers of 16 bits: unpackCorner() of views/scenery_mesh.vert.
uint32_t packCorner(const Float3& n) {
  const float size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  float x = n.x / size, y = n.y / size;
  if (n.z < 0) {
    const float folded = (1 - std::abs(y)) * (x >= 0 ? 1.0f : -1.0f);
    y = (1 - std::abs(x)) * (y >= 0 ? 1.0f : -1.0f);
    x = folded;
  }
  const auto bits = [](float v) { return static_cast<uint32_t>(static_cast<int32_t>(std::lround(v * 32767))) & 0xFFFFu; };
  return bits(x) | bits(y) << 16;
}

float colorValue(float value) { return std::fmin(std::fmax(value, 0.0f), 1.0f); }

void writeTriangles(const MeshData& data, std::byte* to) {
  const std::vector<Float3> normals = cornerNormals(data);
  for (size_t t = 0; t < data.triangles.size(); ++t) {
    MeshTriangle record{};
    for (size_t k = 0; k < 3; ++k) {
      const Double3& v = data.vertices[data.triangles[t][k]];
      for (size_t a = 0; a < 3; ++a) record.corners[3 * k + a] = static_cast<float>(v[a]);
      record.normals[k] = packCorner(normals[3 * t + k]);
    }
    if (!data.colors.empty()) {
      const Float3& c = data.colors[t];
      record.red = colorValue(c.x);
      record.green = colorValue(c.y);
      record.blue = colorValue(c.z);
    }
    std::memcpy(to + t * sizeof record, &record, sizeof record);
  }
}

}  // namespace

Expected<SceneMeshes> SceneMeshes::create(Device& device, const Scene& scene) {
  SceneMeshes out;
  std::map<const Mesh*, uint64_t> first;  // triangle of each mesh
  uint64_t total = 0;
  std::vector<MeshPart> parts;
  for (uint32_t k = 0; k < scene.solids.size(); ++k) {
    const auto* shape = std::get_if<MeshShape>(&scene.solids[k].shape);
    if (!shape || !shape->mesh) continue;
    const Mesh& mesh = *shape->mesh;
    const auto [at, fresh] = first.emplace(&mesh, total);
    if (fresh) total += mesh.data().triangles.size();
    parts.push_back({k, static_cast<uint32_t>(at->second), mesh.twoSided(), !mesh.data().colors.empty()});
    out.vertices_.push_back(static_cast<uint32_t>(3 * mesh.data().triangles.size()));
  }
  if (parts.empty()) return out;
  auto triangles = createBuffer(device, "view: triangles of meshes", total * sizeof(MeshTriangle), MemoryKind::Upload);
  if (!triangles) return triangles.error();
  for (const auto& [mesh, at] : first)
    writeTriangles(mesh->data(), static_cast<std::byte*>(triangles->mapped()) + at * sizeof(MeshTriangle));
  auto records = createBuffer(device, "view: meshes", parts.size() * sizeof(MeshPart), MemoryKind::Upload);
  if (!records) return records.error();
  std::memcpy(records->mapped(), parts.data(), parts.size() * sizeof(MeshPart));
  out.triangles_ = *std::move(triangles);
  out.parts_ = *std::move(records);
  return out;
}

SceneMeshes::Refs SceneMeshes::addTo(Graph& graph) const {
  return {graph.import("view meshes", {parts_.handle(), 0, parts_.size(), Use::Nothing, Use::Nothing}),
          graph.import("view triangles", {triangles_.handle(), 0, triangles_.size(), Use::Nothing, Use::Nothing})};
}

void SceneMeshes::draw(Commands& commands, Kernel kernel, const surface::SurfacePush& push) const {
  for (uint32_t part = 0; part < vertices_.size(); ++part) commands.draw(kernel, vertices_[part], 1, MeshPush{push, part});
}

}  // namespace rill
