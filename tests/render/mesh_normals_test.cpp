#include "views/mesh_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/meshes.hpp"

namespace rill::test {
namespace {

double cosine(const Float3& a, const Double3& b) { return (a.x * b.x + a.y * b.y + a.z * b.z) / std::hypot(b.x, b.y, b.z); }

/// Two triangles that meet at this angle along the edge from 0 to 1.
MeshData hinge(double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  MeshData data;
  data.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {-std::cos(angle), std::sin(angle), 0.5}};
  data.triangles = {{0, 1, 2}, {1, 0, 3}};
  return data;
}

TEST(MeshNormals, BoxIsFlat) {
  const MeshData box = boxMesh({-1, -2, -3}, {1, 2, 3});
  const auto normals = cornerNormals(box);
  ASSERT_EQ(normals.size(), 36u);
  for (size_t corner = 0; corner < normals.size(); ++corner) {
    const Float3& n = normals[corner];
    EXPECT_FLOAT_EQ(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1) << corner;
    EXPECT_EQ(n, normals[corner / 3 * 3]) << "all of a triangle are equal";
    EXPECT_GT(cosine(n, box.vertices[box.triangles[corner / 3][corner % 3]]), 0) << corner;
  }
}

TEST(MeshNormals, BallIsSmooth) {
  const MeshData ball = ballMesh(0.3, 3);
  const auto normals = cornerNormals(ball);
  for (size_t corner = 0; corner < normals.size(); ++corner)
    EXPECT_GT(cosine(normals[corner], ball.vertices[ball.triangles[corner / 3][corner % 3]]), 0.999) << corner;
}

TEST(MeshNormals, SmoothBelowFortyDegrees) {
  for (const double angle : {0.0, 20.0, 39.0, 41.0, 90.0, 170.0}) {
    const auto normals = cornerNormals(hinge(angle));
    EXPECT_EQ(normals[0] == normals[4], angle < 40) << angle;  // both at vertex 0
    EXPECT_EQ(normals[1] == normals[3], angle < 40) << angle;
    if (angle > 0 && angle < 40) { EXPECT_NE(normals[0], normals[2]) << "the far corner is flat"; }
  }
}

TEST(MeshNormals, OwnNormalsWin) {
  MeshData data = hinge(10);
  data.normals.assign(6, Float3{0, 0, 2});
  data.normals[5] = {0, 0, 0};
  data.normals[4] = {std::numeric_limits<float>::quiet_NaN(), 0, 1};
  const auto normals = cornerNormals(data);
  for (size_t corner = 0; corner < 4; ++corner) EXPECT_EQ(normals[corner], (Float3{0, 0, 1}));
  for (size_t corner : {4u, 5u}) EXPECT_GT(normals[corner].y, 0.9f) << "a normal of zero length is replaced";
}

TEST(MeshNormals, TriangleWithoutAreaHasAUnitNormal) {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  data.triangles = {{0, 1, 2}};
  for (const Float3& n : cornerNormals(data)) EXPECT_FLOAT_EQ(std::hypot(n.x, n.y, n.z), 1);
}

}  // namespace
}  // namespace rill::test
