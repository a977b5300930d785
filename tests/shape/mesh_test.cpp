// Checks and repairs of meshes, and their inside.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "core/vector_math.hpp"
#include "shape/mesh_impl.hpp"
#include "shape/shape.hpp"
#include "shape/thin_parts.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace mesh_test {

constexpr Double3 kLow = {0, 0, 0}, kHigh = {1, 2, 3};

bool isInside(const Mesh& mesh, const Double3& at) { return implOf(mesh).tree.winding(at) != 0; }

TEST(Mesh, RejectsWhatIsNoBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto box = [](const auto& change) {
    MeshData data = boxMesh(kLow, kHigh);
    change(data);
    return data;
  };
  const std::pair<MeshData, std::string> cases[] = {
      {MeshData{}, "found no triangles, expected a mesh"},
      {box([&](MeshData& m) { m.vertices[3].y = nan; }), "vertex 3: found the coordinate nan, expected a 32-bit float"},
      {box([](MeshData& m) { m.vertices[2].x = 1e39; }), "vertex 2: found the coordinate 1e+39, expected a 32-bit float"},
      {box([](MeshData& m) { m.triangles[5][1] = 8; }), "triangle 5: found the vertex 8, expected an index below 8"},
      {box([](MeshData& m) { m.triangles.pop_back(); }),
       "the mesh is not closed: found 3 open edges, the first from [0, 0, 3] to [0, 2, 3]; expected a closed mesh, or \"two_sided\": true "
       "for "
       "a sheet"},
      {box([](MeshData& m) {
         m.triangles = {{0, 0, 1}};
       }),
       "found no triangle with three corners, expected a mesh"},
      {box([](MeshData& m) {
         for (Double3& v : m.vertices) v.z = 0;
       }),
       "the mesh encloses 0 m^3; expected a volume, or \"two_sided\": true for a sheet"},
      {box([](MeshData& m) { m.normals.resize(7); }), "found 7 normals, expected three a triangle, or none"},
      {box([](MeshData& m) { m.colors.resize(13); }), "found 13 colors, expected one a triangle, or none"}};
  for (const auto& [data, message] : cases) {
    const auto mesh = Mesh::create(data);
    ASSERT_FALSE(mesh) << message;
    EXPECT_EQ(mesh.error().message, message);
    EXPECT_EQ(mesh.error().kind, ErrorKind::BadInput);
  }
}

// A Klein bottle: closed, but with one side alone.
TEST(Mesh, RejectsWhatHasNoInside) {
  MeshData bottle;
  constexpr uint32_t kAround = 12, kAcross = 8;
  for (uint32_t i = 0; i < kAround; ++i)
    for (uint32_t j = 0; j < kAcross; ++j) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * j / kAcross;
      const double r = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      bottle.vertices.push_back({r * std::cos(u), std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v), r * std::sin(u)});
    }
  // After a turn it meets itself upside down.
  const auto at = [](uint32_t i, uint32_t j) { return i < kAround ? i * kAcross + j % kAcross : (kAcross - j % kAcross) % kAcross; };
  for (uint32_t i = 0; i < kAround; ++i)
    for (uint32_t j = 0; j < kAcross; ++j) {
      bottle.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      bottle.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const auto mesh = Mesh::create(bottle);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("the triangles face in contradictory directions, first at the edge from ["), std::string::npos)
      << mesh.error().message;
  EXPECT_TRUE(Mesh::create(bottle, true)) << "as a sheet it is fine";
}

TEST(Mesh, TurnsPartsThatAreInsideOut) {
  const MeshData one = boxMesh({0, 0, 0}, {2, 1, 1});
  for (const double from : {3.0, 1.0}) {  // apart, overlapping
    const auto mesh = meshOf(joined(one, turned(boxMesh({from, 0, 0}, {from + 2, 1, 1}))));
    ASSERT_TRUE(mesh) << from;
    EXPECT_TRUE(isInside(*mesh, {0.5, 0.5, 0.5}));
    EXPECT_TRUE(isInside(*mesh, {1.5, 0.5, 0.5})) << "where they overlap";
    EXPECT_TRUE(isInside(*mesh, {from + 1.5, 0.5, 0.5}));
    ASSERT_EQ(mesh->warnings().size(), 1U);
    EXPECT_EQ(mesh->warnings()[0], "parts of the mesh were inside out: 12 triangles turned");
  }
}

TEST(Mesh, NormalsFollowTurnedTriangles) {
  MeshData box = turned(boxMesh(kLow, kHigh));
  for (const auto& [a, b, c] : box.triangles) {  // normals that point inward, as the triangles do
    const Double3 n = cross(minus(box.vertices[b], box.vertices[a]), minus(box.vertices[c], box.vertices[a]));
    const auto length_ = static_cast<float>(length(n));
    for (int k = 0; k < 3; ++k) box.normals.push_back({float(n.x) / length_, float(n.y) / length_, float(n.z) / length_});
  }
  const auto mesh = meshOf(box);
  ASSERT_TRUE(mesh);
  const MeshData& data = mesh->data();
  for (size_t t = 0; t < data.triangles.size(); ++t) {
    const auto& [a, b, c] = data.triangles[t];
    const Double3 face = cross(minus(data.vertices[b], data.vertices[a]), minus(data.vertices[c], data.vertices[a]));
    for (size_t k = 0; k < 3; ++k) {
      const Float3& n = data.normals[3 * t + k];
      EXPECT_GT(face.x * n.x + face.y * n.y + face.z * n.z, 0);
    }
  }
}

TEST(Mesh, RepairsWhatCanBeRepaired) {
  const auto warningOf = [](const MeshData& data) {
    const auto mesh = meshOf(data);
    EXPECT_TRUE(mesh);
    if (!mesh) return std::string();
    EXPECT_NEAR(mesh->volume(), 6, 1e-12);
    EXPECT_TRUE(isInside(*mesh, {0.5, 1, 1.5}));
    EXPECT_FALSE(isInside(*mesh, {0.5, 1, 3.5}));
    EXPECT_GT(surfaceAt(MeshShape{.mesh = mesh}, {0.5, 1, 3.5}).normal.z, 0.999);
    return mesh->warnings().empty() ? std::string() : mesh->warnings()[0];
  };
  const MeshData box = boxMesh(kLow, kHigh);
  EXPECT_EQ(warningOf(box), "");
  EXPECT_EQ(warningOf(turned(box)), "the mesh was inside out: all triangles turned");
  MeshData one = box;
  std::swap(one.triangles[4][0], one.triangles[4][1]);
  EXPECT_EQ(warningOf(one), "1 triangle turned to face as their neighbors do");
  MeshData soup;  // as an STL has it: each triangle with its own vertices
  for (const auto& t : box.triangles) {
    const auto first = static_cast<uint32_t>(soup.vertices.size());
    for (uint32_t corner : t) soup.vertices.push_back(box.vertices[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(warningOf(soup), "");
  MeshData thin = box;
  thin.triangles.push_back({2, 2, 5});
  EXPECT_EQ(warningOf(thin), "1 triangle with coinciding corners dropped");
}

TEST(Mesh, OverlappingPartsAreOneBody) {
  const MeshData two = joined(boxMesh({0, 0, 0}, {2, 1, 1}), boxMesh({1, 0, 0}, {3, 1, 1}));
  const auto mesh = meshOf(two);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(isInside(*mesh, {1.5, 0.5, 0.5})) << "wound twice";
  EXPECT_TRUE(isInside(*mesh, {2.5, 0.5, 0.5}));
  EXPECT_FALSE(isInside(*mesh, {3.5, 0.5, 0.5}));
  const auto hollow = meshOf(joined(boxMesh({0, 0, 0}, {3, 3, 3}), turned(boxMesh({1, 1, 1}, {2, 2, 2}))));
  ASSERT_TRUE(hollow);
  EXPECT_NEAR(hollow->volume(), 26, 1e-12);
  EXPECT_FALSE(isInside(*hollow, {1.5, 1.5, 1.5}));
  EXPECT_TRUE(isInside(*hollow, {0.5, 1.5, 1.5}));
}

TEST(Mesh, FindsPartsThinnerThanALimit) {
  const auto plate = meshOf(boxMesh({0, 0, 0}, {1, 0.01, 1}));
  const auto thin = thinnestPart(*plate, 0.02);
  ASSERT_TRUE(thin);
  EXPECT_NEAR(thin->thickness, 0.01, 1e-12);
  EXPECT_EQ(thin->triangles, 4u);
  EXPECT_NEAR(thin->place.y * (thin->place.y - 0.01), 0, 1e-12) << "on one of its faces";
  EXPECT_FALSE(thinnestPart(*plate, 0.005));
  EXPECT_FALSE(thinnestPart(*meshOf(ballMesh(1, 4)), 0.1));
  // Faces of boxes that overlap lie inside the cup, near its surface.
  EXPECT_FALSE(thinnestPart(*meshOf(cupMesh({0, 0, 0}, {1, 1, 1}, 0.1)), 0.09));
  EXPECT_TRUE(thinnestPart(*meshOf(cupMesh({0, 0, 0}, {1, 1, 1}, 0.1)), 0.11));
  EXPECT_FALSE(thinnestPart(*meshOf(openBox({0, 0, 0}, {1, 1, 1}), true), 0.1));
}

// Rows of points that run exactly along edges and through vertices.
TEST(Mesh, InsideIsExactAlongEdges) {
  MeshData grid = boxMesh({-1, -1, -1}, {1, 1, 1});
  for (int n = 0; n < 3; ++n) {  // more vertices on the faces
    MeshData finer = grid;
    finer.triangles.clear();
    for (const auto& [a, b, c] : grid.triangles) {
      const auto middle = static_cast<uint32_t>(finer.vertices.size());
      const Double3 &u = grid.vertices[a], &v = grid.vertices[b], &w = grid.vertices[c];
      finer.vertices.push_back({(u.x + v.x + 2 * w.x) / 4, (u.y + v.y + 2 * w.y) / 4, (u.z + v.z + 2 * w.z) / 4});
      finer.triangles.insert(finer.triangles.end(), {{a, b, middle}, {b, c, middle}, {c, a, middle}});
    }
    grid = std::move(finer);
  }
  const auto mesh = meshOf(grid);
  ASSERT_TRUE(mesh);
  for (double y = -1.25; y <= 1.25; y += 0.125)
    for (double z = -1.25; z <= 1.25; z += 0.125) {
      const bool within = std::abs(y) < 1 && std::abs(z) < 1, border = std::abs(y) == 1 || std::abs(z) == 1;
      if (border) continue;
      for (double x : {-1.5, -0.75, 0.0, 0.5, 1.5})
        EXPECT_EQ(implOf(*mesh).tree.winding({x, y, z}), within && std::abs(x) < 1 ? 1 : 0) << x << " " << y << " " << z;
    }
}

TEST(Mesh, NearestPointIsThatOfAllTriangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-2, 2);
  MeshData soup;
  for (uint32_t t = 0; t < 300; ++t) {
    const Double3 at{place(random), place(random), place(random)};
    for (int k = 0; k < 3; ++k) soup.vertices.push_back({at.x + place(random) / 4, at.y + place(random) / 4, at.z + place(random) / 4});
    if (t % 10 == 0) soup.vertices.back() = soup.vertices[soup.vertices.size() - 2];  // no area
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleTree tree(soup.vertices, soup.triangles);
  for (int n = 0; n < 300; ++n) {
    const Double3 x{place(random), place(random), place(random)};
    double least = 1e300;
    for (const auto& t : soup.triangles) {
      const TriangleTree one(soup.vertices, {t});
      least = std::min(least, one.nearest(x).squared);
      for (int k = 0; k < 30; ++k) {  // no point of it is nearer
        const double u = (place(random) + 2) / 4, v = (place(random) + 2) / 4 * (1 - u);
        double square = 0;
        for (size_t a = 0; a < 3; ++a)
          square += std::pow((1 - u - v) * soup.vertices[t[0]][a] + u * soup.vertices[t[1]][a] + v * soup.vertices[t[2]][a] - x[a], 2);
        ASSERT_LE(one.nearest(x).squared, square + 1e-12);
      }
    }
    EXPECT_DOUBLE_EQ(tree.nearest(x, static_cast<uint32_t>(n)).squared, least);
  }
}

}  // namespace mesh_test
}  // namespace rill::test
