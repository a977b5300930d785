#pragma once
// Normals that a mesh is shaded with.
#include <vector>

#include "rill/mesh.hpp"

namespace rill {

/// Unit normals of the corners, three a triangle: the mesh's own where it has them. Else faces that share an edge and meet at less than 40
/// degrees are shaded as one smooth surface, and others are flat.
std::vector<Float3> cornerNormals(const MeshData& data);

}  // namespace rill
