#pragma once
// Meshes for tests.
#include <utility>

#include "bench/mesh_shapes.hpp"

namespace rill::test {

/// All triangles turned around.
inline MeshData turned(MeshData data) {
  for (auto& t : data.triangles) std::swap(t[1], t[2]);
  return data;
}

/// Of data that has no fault.
inline std::shared_ptr<const Mesh> meshOf(MeshData data, bool twoSided = false) {
  auto mesh = Mesh::create(std::move(data), twoSided);
  return mesh ? *mesh : nullptr;
}

}  // namespace rill::test
