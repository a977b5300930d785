#pragma once
// What a Mesh holds.
#include "core/impl_of.hpp"
#include "rill/mesh.hpp"
#include "shape/triangle_tree.hpp"

namespace rill {

struct MeshImpl {
  explicit MeshImpl(MeshData repaired, bool sheet) : data(std::move(repaired)), twoSided(sheet), tree(data.vertices, data.triangles) {}

  MeshData data;
  bool twoSided = false;
  TriangleTree tree;
  Double3 low = {}, high = {};  ///< bounds, m
  double radius = 0;            ///< of the sphere around the origin that holds all, m
  double volume = 0;            ///< m^3
  std::vector<std::string> warnings;
};

}  // namespace rill
