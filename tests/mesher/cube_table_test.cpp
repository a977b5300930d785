#include "mesher/cube_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace rill::test {
namespace {

bool crosses(uint32_t inside, uint32_t edge) {
  const CubeEdge e = cubeEdge(edge);
  return ((inside >> e.from ^ inside >> (e.from | 1u << e.axis)) & 1) != 0;
}

/// Whether an edge lies in the face at the lower (0) or upper (1) end of an axis.
bool liesIn(uint32_t edge, uint32_t axis, uint32_t end) {
  const CubeEdge e = cubeEdge(edge);
  return e.axis != axis && (e.from >> axis & 1) == end;
}

/// Sides of triangles that are not shared within the cell, with direction.
std::set<std::pair<uint32_t, uint32_t>> openSides(const CubeTriangles& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (const auto& t : triangles)
    for (size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  std::set<std::pair<uint32_t, uint32_t>> open;
  for (const auto& [side, times] : sides) {
    EXPECT_EQ(times, 1);
    if (!sides.contains({side.second, side.first})) open.insert(side);
  }
  return open;
}

TEST(CubeTable, UsesExactlyTheCrossedEdges) {
  const auto table = cubeTriangles();
  for (uint32_t inside = 0; inside < 256; ++inside) {
    std::set<uint32_t> used, crossed;
    for (const auto& t : table[inside]) used.insert(t.begin(), t.end());
    for (uint32_t edge = 0; edge < 12; ++edge)
      if (crosses(inside, edge)) crossed.insert(edge);
    EXPECT_EQ(used, crossed) << inside;
    EXPECT_LE(table[inside].size(), kMaxCubeTriangles);
  }
}

TEST(CubeTable, ContoursOfNeighborsMatch) {
  const auto table = cubeTriangles();
  // Two cells that share a face along an axis, for all corners of both.
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t bit = 1u << axis;
    for (uint32_t a = 0; a < 256; ++a)
      for (uint32_t b = 0; b < 256; ++b) {
        bool same = true;
        for (uint32_t c = 0; c < 8; ++c)
          if ((c & bit) == 0) same = same && (a >> (c | bit) & 1) == (b >> c & 1);
        if (!same) continue;
        // Edges of b's lower face as edges of a's upper one.
        const auto inA = [&](uint32_t edge) {
          for (uint32_t other = 0; other < 12; ++other)
            if (cubeEdge(other).axis == cubeEdge(edge).axis && cubeEdge(other).from == (cubeEdge(edge).from | bit)) return other;
          return 12u;
        };
        std::set<std::pair<uint32_t, uint32_t>> upper, lower;
        for (const auto& [from, to] : openSides(table[a]))
          if (liesIn(from, axis, 1) && liesIn(to, axis, 1)) upper.insert({from, to});
        for (const auto& [from, to] : openSides(table[b]))
          if (liesIn(from, axis, 0) && liesIn(to, axis, 0)) lower.insert({inA(to), inA(from)});
        ASSERT_EQ(upper, lower) << "axis " << axis << ", cells " << a << " and " << b;
      }
  }
}

TEST(CubeTable, InnerSidesCrossNoFace) {
  for (const CubeTriangles& triangles : cubeTriangles()) {
    const auto open = openSides(triangles);
    for (const auto& t : triangles)
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t from = t[k], to = t[(k + 1) % 3];
        bool onFace = false;
        for (uint32_t face = 0; face < 6; ++face) onFace = onFace || (liesIn(from, face % 3, face / 3) && liesIn(to, face % 3, face / 3));
        EXPECT_EQ(onFace, open.contains({from, to}));
      }
  }
}

TEST(CubeTable, PacksTrianglesForShaders) {
  const auto words = packedCubeTriangles();
  const auto table = cubeTriangles();
  for (uint32_t inside = 0; inside < 256; ++inside) {
    const uint64_t packed = words[2 * inside] | uint64_t{words[2 * inside + 1]} << 32;
    ASSERT_EQ(packed >> 60, table[inside].size());
    for (size_t k = 0; k < 3 * table[inside].size(); ++k) ASSERT_EQ(packed >> 4 * k & 15, table[inside][k / 3][k % 3]);
  }
}

}  // namespace
}  // namespace rill::test
