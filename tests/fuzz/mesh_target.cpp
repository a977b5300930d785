#include <cmath>
#include <string_view>

#include "fuzz/memory_file.hpp"
#include "fuzz/require.hpp"
#include "fuzz/targets.hpp"
#include "scene/mesh_readers.hpp"
#include "shape/contact_points.hpp"
#include "shape/mass.hpp"

namespace rill::test {
namespace {

Expected<MeshData> readAs(char format, const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = "/nonexistent/fuzz";  // what it refers to is missing
  if (format == 'o') return readObj(bytes, file);
  if (format == 's') return readStl(bytes, file);
  if (format == 'g' || format == 'b') return readGltf(bytes, file, format == 'b');
  const MemoryFile memory(data, size);
  return readPlyMesh(memory.path());
}

/// What a body of the mesh needs.
void asBody(const MeshShape& shape) {
  RILL_REQUIRE(massOf(shape, 1000).mass > 0);
  const std::vector<ContactPoint> points = contactPoints(shape);
  RILL_REQUIRE(!points.empty() && points.size() <= kMaxContactPoints);
  for (const ContactPoint& p : points) RILL_REQUIRE(std::isfinite(p.center.x) && std::isfinite(p.center.y) && std::isfinite(p.center.z));
}

}  // namespace

int fuzzMesh(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const auto mesh = guarded("fuzz", [&] { return readAs(static_cast<char>(data[0]), data + 1, size - 1); });
  if (!mesh) {
    RILL_REQUIRE(!mesh.error().message.empty());
    return 0;
  }
  RILL_REQUIRE(!mesh->triangles.empty());
  for (const auto& triangle : mesh->triangles) {
    for (const uint32_t corner : triangle) RILL_REQUIRE(corner < mesh->vertices.size());
  }
  for (const Double3& vertex : mesh->vertices) RILL_REQUIRE(std::isfinite(vertex.x) && std::isfinite(vertex.y) && std::isfinite(vertex.z));
  for (const Float3& normal : mesh->normals) RILL_REQUIRE(std::abs(std::hypot(normal.x, normal.y, normal.z) - 1) < 1e-4F);
  RILL_REQUIRE(mesh->normals.empty() || mesh->normals.size() == 3 * mesh->triangles.size());
  RILL_REQUIRE(mesh->colors.empty() || mesh->colors.size() == mesh->triangles.size());
  constexpr size_t kFew = 2000;  // triangles that are repaired in no time
  for (const bool twoSided : {false, true}) {
    if (mesh->triangles.size() > kFew) break;
    const auto made = Mesh::create(*mesh, twoSided);
    RILL_REQUIRE(made ? twoSided || (*made)->volume() > 0 : !made.error().message.empty());
    if (made && !twoSided) asBody(MeshShape{.mesh = *made});
  }
  return 0;
}

}  // namespace rill::test
