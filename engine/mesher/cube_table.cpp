#include "mesher/cube_table.hpp"

#include <cassert>
#include <cstddef>

namespace rill {
namespace {

constexpr uint32_t kNoEdge = 12;

/// The edge between two corners that differ in one bit.
uint32_t edgeBetween(uint32_t a, uint32_t b) {
  for (uint32_t edge = 0; edge < 12; ++edge) {
    const CubeEdge found = cubeEdge(edge);
    if (found.from == (a & b) && (found.from | 1u << found.axis) == (a | b)) return edge;
  }
  return kNoEdge;
}

/// Corners of a face, counter-clockwise seen from outside the cell. `face`: axis, and 3 more for the far side.
std::array<uint32_t, 4> faceCorners(uint32_t face) {
  const uint32_t axis = face % 3, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, far = face >= 3 ? 1u << axis : 0;
  if (face >= 3) return {far, far | u, far | u | v, far | v};
  return {0, v, u | v, u};
}

/// A bit for each of the two faces that an edge lies in.
uint32_t facesOf(uint32_t edge) {
  const CubeEdge e = cubeEdge(edge);
  uint32_t faces = 0;
  for (uint32_t axis = 0; axis < 3; ++axis)
    if (axis != e.axis) faces |= 1u << (axis + ((e.from >> axis & 1) != 0 ? 3 : 0));
  return faces;
}

/// The next vertex of the contour after each crossed edge, so that its polygon is counter-clockwise seen from outside the fluid.
std::array<uint32_t, 12> contour(uint32_t inside) {
  std::array<uint32_t, 12> next;
  next.fill(kNoEdge);
  const auto isInside = [&](uint32_t corner) { return (inside >> corner & 1) != 0; };
  for (uint32_t face = 0; face < 6; ++face) {
    const auto corners = faceCorners(face);
    for (uint32_t k = 0; k < 4; ++k) {
      if (isInside(corners[k]) || !isInside(corners[(k + 1) % 4])) continue;
      uint32_t last = k + 1;  // of the run of corners inside that begins here
      while (isInside(corners[(last + 1) % 4])) ++last;
      const uint32_t entered = edgeBetween(corners[k], corners[(k + 1) % 4]);
      const uint32_t left = edgeBetween(corners[last % 4], corners[(last + 1) % 4]);
      next[entered] = left;
    }
  }
  return next;
}

/// Divides the part of a polygon from vertex `first` to `last` into triangles, without a side across a face; false where none does.
bool divide(const std::vector<uint32_t>& polygon, size_t first, size_t last, CubeTriangles& triangles) {
  if (last - first < 2) return true;
  const auto allowed = [&](size_t a, size_t b) { return b - a < 2 || (facesOf(polygon[a]) & facesOf(polygon[b])) == 0; };
  for (size_t middle = first + 1; middle < last; ++middle) {
    if (!allowed(first, middle) || !allowed(middle, last)) continue;
    const size_t before = triangles.size();
    triangles.push_back({static_cast<uint8_t>(polygon[first]), static_cast<uint8_t>(polygon[middle]), static_cast<uint8_t>(polygon[last])});
    if (divide(polygon, first, middle, triangles) && divide(polygon, middle, last, triangles)) return true;
    triangles.resize(before);
  }
  return false;
}

CubeTriangles trianglesOf(uint32_t inside) {
  auto next = contour(inside);
  CubeTriangles triangles;
  for (uint32_t edge = 0; edge < 12; ++edge) {
    std::vector<uint32_t> polygon;
    for (uint32_t at = edge; next[at] != kNoEdge;) {
      polygon.push_back(at);
      const uint32_t to = next[at];
      next[at] = kNoEdge;
      at = to;
    }
    [[maybe_unused]] const bool divided = polygon.empty() || divide(polygon, 0, polygon.size() - 1, triangles);
    assert(divided);
  }
  return triangles;
}

}  // namespace

CubeEdge cubeEdge(uint32_t edge) {
  const uint32_t axis = edge / 4, lower = axis == 0 ? 1 : 0, higher = axis == 2 ? 1 : 2;
  return {(edge & 1) << lower | (edge >> 1 & 1) << higher, axis};
}

std::array<CubeTriangles, 256> cubeTriangles() {
  std::array<CubeTriangles, 256> table;
  for (uint32_t inside = 0; inside < 256; ++inside) table[inside] = trianglesOf(inside);
  return table;
}

std::array<uint32_t, 512> packedCubeTriangles() {
  std::array<uint32_t, 512> words{};
  for (uint32_t inside = 0; inside < 256; ++inside) {
    const CubeTriangles triangles = trianglesOf(inside);
    uint64_t packed = uint64_t{triangles.size()} << 60;
    uint32_t shift = 0;
    for (const auto& triangle : triangles)
      for (const uint8_t edge : triangle) {
        packed |= uint64_t{edge} << shift;
        shift += 4;
      }
    words[2 * inside] = static_cast<uint32_t>(packed);
    words[2 * inside + 1] = static_cast<uint32_t>(packed >> 32);
  }
  return words;
}

}  // namespace rill
