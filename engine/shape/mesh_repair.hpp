#pragma once
// Checks and repairs of a mesh's triangles.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rill/mesh.hpp"

namespace rill {

/// BadInput for an index or coordinate out of range, for colors or normals of another number, and where there is no triangle.
Expected<void> checkMeshData(const MeshData& data);

/// Makes equal vertices one, and drops triangles that then have fewer than three.
void weld(MeshData& data, std::vector<std::string>& warnings);

/// Turns triangles, so that two neighbors use their edge in opposite directions. BadInput for an edge that is open, with its place.
Expected<void> orient(MeshData& data, std::vector<std::string>& warnings);

/// Turns the parts that face inward and border on the outside: all that are not cavities of others.
void turnInvertedParts(MeshData& data, std::vector<std::string>& warnings);

/// Sum over triangles of the volume that each spans with a corner of the first, m^3: negative where closed ones face inward.
double signedVolume(const MeshData& data, std::span<const uint32_t> triangles);

}  // namespace rill
