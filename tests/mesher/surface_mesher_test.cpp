// The mesh on the device against the reference in double precision, and what must hold of any mesh.
#include <limits>

#include "mesher/mesher_records.h"
#include "mesher/surface_mesher_rig.hpp"

namespace rill::test {
namespace surface_mesher_test {

/// Compares with the reference: the same vertices, if in another order. Where the field is close to 1/2 at a corner, float and double may
/// find it on different sides, so a few vertices may differ.
void expectLikeReference(const Made& made, const SurfaceMesh& expected) {
  EXPECT_NEAR(double(made.mesh.positions.size()), double(expected.positions.size()), 4 + 0.002 * double(expected.positions.size()));
  EXPECT_NEAR(double(made.mesh.triangles.size()), double(expected.triangles.size()), 8 + 0.002 * double(expected.triangles.size()));
  EXPECT_NEAR(reference::enclosedVolume(made.mesh), reference::enclosedVolume(expected), 1e-3 * reference::enclosedVolume(expected) + 1e-3);
  std::multimap<long, size_t> byX;
  for (size_t i = 0; i < expected.positions.size(); ++i) byX.emplace(std::lround(expected.positions[i].x * 100), i);
  size_t lost = 0, turned = 0;
  double speed = 0;
  for (size_t i = 0; i < made.mesh.positions.size(); ++i) {
    const auto& x = made.mesh.positions[i];
    size_t nearest = SIZE_MAX;
    double least = 0.02;
    const long at = std::lround(x.x * 100);
    for (auto k = byX.lower_bound(at - 3); k != byX.end() && k->first <= at + 3; ++k)
      if (const double far = glm::length(expected.positions[k->second] - x); far < least) least = far, nearest = k->second;
    if (nearest == SIZE_MAX) {
      ++lost;
      continue;
    }
    turned += glm::dot(expected.normals[nearest], made.mesh.normals[i]) < 0.99 ? 1 : 0;  // the kernel's slope has two steps
    speed = std::max(speed, glm::length(expected.velocities[nearest] - made.mesh.velocities[i]));
  }
  EXPECT_LE(lost, 4 + made.mesh.positions.size() / 200);
  EXPECT_LE(turned, 4 + made.mesh.positions.size() / 50);
  EXPECT_LT(speed, 0.05);
}

TEST_F(SurfaceMesherTest, MatchesReferenceOfRandomInput) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(-6, 6), speed(-1, 1);
  for (const double cell : {0.5, 0.4, 1.0, 0.25}) {
    Points points = block(8, 7, 6, 0.25), velocities;
    for (int k = 0; k < 60; ++k) points.push_back({in(random), in(random), in(random)});
    for (const auto& p : points) velocities.push_back({0.1 * p.x, -0.1 * p.y, 0.1 * speed(random)});
    const Made made = make(points, {.cell = cell}, velocities);
    expectClosed(made.mesh);
    expectLikeReference(made, reference::surfaceMesh(points, velocities, cell));
    EXPECT_EQ(made.count(MeshCount::BoundHits), 0u);
  }
}

TEST_F(SurfaceMesherTest, MatchesReferenceOfBulk) {  // where the field is not summed deep inside
  const Points points = block(20, 14, 16, 0.1);
  const Made made = make(points);
  expectClosed(made.mesh);
  const SurfaceMesh expected = reference::surfaceMesh(points, {}, 0.5);
  EXPECT_EQ(made.mesh.velocities.size(), made.mesh.positions.size());
  expectLikeReference(made, expected);
}

// Sums are over lists of bins, or by walks where a bin has too many particles for a list, or all lists together have no room.
TEST_F(SurfaceMesherTest, MatchesReferenceWithoutLists) {
  Points dense = block(5, 5, 4), loose;
  for (auto& p : dense) p = 0.49 + 1e-4 * p;  // all at the center of a bin: they reach each bin around
  dense.push_back({0.8, 0.5, 0.5});           // whose neighbors' mean lies aside, so the bins are near the surface
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-6, 6);
  for (int k = 0; k < 500; ++k) loose.push_back({in(random), in(random), in(random)});
  for (const Points* points : {&dense, &loose}) {
    const Made made = make(*points), again = make(*points);
    const uint32_t listed = made.counts[kMeshListed];
    if (points == &dense)
      EXPECT_EQ(listed, 0u);
    else
      EXPECT_GT(listed, kMeshListedPerParticle * points->size());
    EXPECT_GT(made.counts[kMeshNearBins], 0u);
    EXPECT_TRUE(made.bytes == again.bytes);
    expectClosed(made.mesh);
    expectLikeReference(made, reference::surfaceMesh(*points, {}, 0.5));
  }
}

TEST_F(SurfaceMesherTest, KeepsVolume) {
  const auto expectVolume = [&](const char* name, const Points& points, double error) {
    SCOPED_TRACE(name);
    const Made made = make(points);
    expectClosed(made.mesh);
    EXPECT_NEAR(volumeError(made, points.size()), 0, error);
  };
  expectVolume("block", block(20, 20, 20), 0.01);
  expectVolume("jittered block", block(20, 20, 20, 0.15), 0.01);
  expectVolume("sphere", ball(10), 0.01);
  expectVolume("sheet", block(40, 1, 40), 0.01);
  expectVolume("sheet of two layers", block(30, 2, 30), 0.02);  // its rim is round
  expectVolume("drop", {{0.1, 0.2, 0.3}}, 0.05);
}

TEST_F(SurfaceMesherTest, PlaneLiesHalfASpacingOutside) {
  // A tilted slab; its plane faces away from the axes, so that steps of the grid would show.
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 1, 0.17)), u = glm::normalize(glm::cross(n, glm::dvec3(1, 0, 0))),
                   v = glm::cross(n, u);
  Points points;
  for (int i = -12; i < 12; ++i)
    for (int j = -12; j < 12; ++j)
      for (int k = 0; k < 4; ++k) points.push_back((i + 0.5) * u + (j + 0.5) * v - (k + 0.5) * n);
  const Made made = make(points);
  size_t seen = 0;
  for (size_t i = 0; i < made.mesh.positions.size(); ++i) {
    const auto& x = made.mesh.positions[i];
    if (std::abs(glm::dot(x, u)) > 8 || std::abs(glm::dot(x, v)) > 8 || glm::dot(x, n) < -2) continue;
    ++seen;
    EXPECT_NEAR(glm::dot(x, n), 0, 0.02);
    EXPECT_GT(glm::dot(made.mesh.normals[i], n), std::cos(3.5 / 57.3));
  }
  EXPECT_GT(seen, 500u);
}

TEST_F(SurfaceMesherTest, SameBytesOnEachRun) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> in(-9, 9);
  Points points = block(12, 9, 10, 0.3);
  for (int k = 0; k < 200; ++k) points.push_back({in(random), in(random), in(random)});
  const Made first = make(points), second = make(points), spare = make(points, {.capacity = uint32_t(points.size()) + 100}, {}, 100);
  EXPECT_GT(first.bytes.size(), 1000u);
  EXPECT_TRUE(first.bytes == second.bytes);
  EXPECT_TRUE(first.mesh.triangles == spare.mesh.triangles);
  EXPECT_TRUE(first.mesh.positions == spare.mesh.positions);
}

TEST_F(SurfaceMesherTest, DegenerateInput) {
  const Made none = make({});
  EXPECT_EQ(none.count(MeshCount::Vertices), 0u);
  EXPECT_EQ(none.count(MeshCount::Indices), 0u);
  const auto closed = [&](const Points& points) {
    const Made made = make(points);
    EXPECT_GT(made.mesh.triangles.size(), 0u);
    expectClosed(made.mesh);
    return made;
  };
  closed({{0, 0, 0}});
  closed({{0, 0, 0}, {1, 0, 0}});
  closed({{2.5, 2.5, 2.5}, {2.5, 2.5, 2.5}});
  closed(Points(300, {4, 0, -4}));
  closed({{-300, 200, 400}, {300.5, -200, 0}});
  Points row, wall = block(6, 6, 6);
  for (int i = 0; i < 20; ++i) row.push_back({0.5 * i, 0, 0});
  closed(row);
  for (auto& p : wall) p = 4.0 * glm::floor(p / 4.0) + glm::fract(p);  // on corners of blocks
  closed(wall);
}

TEST_F(SurfaceMesherTest, BoundsAndCountsSumsOverManyParticles) {
  const Made made = make(Points(6000, {1, 2, 3}));
  expectClosed(made.mesh);
  EXPECT_GT(made.count(MeshCount::BoundHits), 0u);
}

TEST_F(SurfaceMesherTest, LeavesOutInactiveAndFarParticles) {
  Points points = block(4, 4, 4);
  const Made alone = make(points);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const glm::dvec3 x : {glm::dvec3(nan, 0, 0), {0, infinite, 0}, {1e11, 1e11, 1e11}, {0, 9000, 0}, {1e7, 0, 0}}) points.push_back(x);
  const Made made = make(points);
  EXPECT_TRUE(made.mesh.positions == alone.mesh.positions);
  EXPECT_TRUE(made.mesh.triangles == alone.mesh.triangles);
  EXPECT_EQ(made.count(MeshCount::TooFar), 2u);
}

TEST_F(SurfaceMesherTest, IsEmptyAndSaysWhatItNeedsWithoutRoom) {
  const Points points = block(12, 12, 12);
  const Made complete = make(points);
  ASSERT_GT(complete.count(MeshCount::Vertices), 0u);
  const SurfaceMesherDesc needed{.maxBlocks = complete.count(MeshCount::NeededBlocks),
                                 .maxVertices = complete.count(MeshCount::NeededVertices),
                                 .maxTriangles = complete.count(MeshCount::NeededTriangles)};
  EXPECT_TRUE(make(points, needed).bytes == complete.bytes);
  for (uint32_t SurfaceMesherDesc::*limit :
       {&SurfaceMesherDesc::maxBlocks, &SurfaceMesherDesc::maxVertices, &SurfaceMesherDesc::maxTriangles}) {
    SurfaceMesherDesc less = needed;
    less.*limit -= 1;
    const Made made = make(points, less);
    EXPECT_EQ(made.count(MeshCount::Vertices), 0u);
    EXPECT_EQ(made.count(MeshCount::Indices), 0u);
    EXPECT_EQ(made.count(MeshCount::NeededBlocks), needed.maxBlocks);
    if (limit != &SurfaceMesherDesc::maxBlocks) {
      EXPECT_EQ(made.count(MeshCount::NeededVertices), needed.maxVertices);
      EXPECT_EQ(made.count(MeshCount::NeededTriangles), needed.maxTriangles);
    }
  }
}

TEST_F(SurfaceMesherTest, RejectsValuesOutOfRange) {
  const auto message = [&](const SurfaceMesherDesc& desc) {
    const auto made = SurfaceMesher::create(device(), desc);
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(message({}), "surface mesher: capacity is 0; expected 1 to 4,194,304 particles");
  EXPECT_EQ(message({.capacity = 10, .cell = 0.1}), "surface mesher: cell is 0.1; expected 0.25 to 1 (spacings)");
  EXPECT_EQ(message({.capacity = 10, .cell = std::numeric_limits<double>::quiet_NaN()}).find("surface mesher: cell is"), 0u);
  const auto large = SurfaceMesher::create(device(), {.capacity = 10, .maxBlocks = UINT32_MAX});
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().kind, ErrorKind::TooLarge);
  const auto many = SurfaceMesher::create(device(), {.capacity = 10, .maxVertices = UINT32_MAX, .maxTriangles = UINT32_MAX});
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().kind, ErrorKind::TooLarge);
}

TEST_F(SurfaceMesherTest, CompileReportsMoreParticlesThanCapacity) {
  auto mesher = SurfaceMesher::create(device(), {.capacity = 3});
  ASSERT_TRUE(mesher);
  Buffer positions = upload("position", std::vector<Float4>(4));
  Graph graph;
  FluidState state;
  state.capacity = 4;
  state.spacing = 1;
  state.position = graph.import("position", importOf(positions));
  (void)mesher->addTo(graph, state);
  const auto compiled = graph.compile();
  ASSERT_FALSE(compiled);
  EXPECT_NE(compiled.error().message.find("FluidState::capacity is 4; expected at most 3"), std::string::npos);
}

}  // namespace surface_mesher_test
}  // namespace rill::test
