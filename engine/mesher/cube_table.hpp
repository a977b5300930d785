#pragma once
// Marching cubes: the triangles of a cell for each combination of corners inside the fluid, made from a rule instead of a list.
#include <array>
#include <cstdint>
#include <vector>

namespace rill {

/// Corner c of a cell lies at bits 0, 1 and 2 of c along x, y and z. Edge 4 a + k runs along axis a; bits 0 and 1 of k are its places
/// along the two other axes, the lower axis first.
struct CubeEdge {
  uint32_t from = 0;  ///< the corner at its lower end
  uint32_t axis = 0;
};
CubeEdge cubeEdge(uint32_t edge);

/// Edges of the vertices of a cell's triangles, three each, counter-clockwise seen from outside the fluid.
using CubeTriangles = std::vector<std::array<uint8_t, 3>>;

/// Of the 256 cases; bit c: corner c is inside. On each face of a cell the contour depends on the four corners of the face alone (corners
/// inside that meet diagonally are separated), so that the contours of two cells match on their common face. No triangle has a side
/// across a face that is not part of the face's contour. So each side of a triangle belongs to exactly two, in opposite directions.
std::array<CubeTriangles, 256> cubeTriangles();

inline constexpr uint32_t kMaxCubeTriangles = 5;
/// The same in two words a case for shaders: four bits an edge from the lowest on; the four highest bits are the number of triangles.
std::array<uint32_t, 512> packedCubeTriangles();

}  // namespace rill
