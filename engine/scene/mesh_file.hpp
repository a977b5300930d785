#pragma once
#include <filesystem>

#include "rill/expected.hpp"
#include "rill/mesh.hpp"

namespace rill {

/// Reads .obj, .stl (binary or ASCII), .ply, .gltf and .glb. Polygons become triangles; coordinates are those of the file, with the
/// transforms of its nodes. Normals and colors are left empty unless all triangles have normals, or any has a color.
/// BadInput, with the line or the element, if the file is not a complete mesh; Io if reading fails. Does not throw.
Expected<MeshData> readMesh(const std::filesystem::path& file);

}  // namespace rill
