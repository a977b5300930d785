// Emitters whose mouth is a flat mesh.
#include <algorithm>

#include "fluid/flows_fixture.hpp"
#include "support/flat_meshes.hpp"

namespace rill::test {
namespace flows_test {

/// Whether a triangle of the mesh, larger by `slack` (m), has a point of its plane z = 0.
bool isInMesh(const MeshData& data, double x, double y, double slack) {
  return std::ranges::any_of(data.triangles, [&](const auto& t) {
    for (size_t k = 0; k < 3; ++k) {
      const Double3 &a = data.vertices[t[k]], &b = data.vertices[t[(k + 1) % 3]];
      const double side = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
      if (side < -slack * std::hypot(b.x - a.x, b.y - a.y)) return false;
    }
    return true;
  });
}

/// Points in the mesh's own coordinates, of a mouth that is not turned.
std::vector<glm::dvec3> placesOf(const MouthLattice& lattice) {
  std::vector<glm::dvec3> all;
  for (const auto& [a, u] : lattice.points)
    all.push_back(vec(lattice.center) + double{a} * vec(lattice.across) + double{u} * vec(lattice.up));
  return all;
}

MeshData twoPieces() { return joined(rectMesh(0.31, 0.22), moved(ringMesh(0.1, 0.25, 7), 4, 3)); }

TEST_F(FlowsTest, MeshMouthsTakeTheirAreaInsideTheirTriangles) {
  struct Case {
    MeshData data;
    double area;
  };
  for (const auto& [data, area] : {Case{cornerMesh(0.3), 0.27},
                                   {ringMesh(0.2, 0.5, 24), ringArea(0.2, 0.5, 24)},
                                   {moved(rectMesh(0.73, 0.28), 5, -2), 0.73 * 0.28},
                                   {twoPieces(), 0.31 * 0.22 + ringArea(0.1, 0.25, 7)}})
    for (const double d : {0.1, 0.07, 0.031, 0.0083}) {
      const MouthLattice lattice = mouthLattice(mouthOf(data), d);
      const auto count = static_cast<double>(lattice.points.size());
      SCOPED_TRACE(std::to_string(area) + " m^2, spacing " + std::to_string(d) + ", points " + std::to_string(count));
      EXPECT_NEAR(lattice.area, area, 1e-12);
      EXPECT_NEAR(count * d * d * d, area * lattice.thickness, 1e-15);
      EXPECT_NEAR(count * d * d / area, 1, 0.15);
      EXPECT_NEAR(glm::length(vec(lattice.normal) - glm::dvec3(0, 0, 1)), 0, 1e-12);
      EXPECT_NEAR(glm::length(glm::cross(vec(lattice.normal), vec(lattice.up)) - vec(lattice.across)), 0, 1e-12);
      EXPECT_EQ(lattice.shared, 0u);
      const std::vector<glm::dvec3> places = placesOf(lattice);
      double nearest = 1e9;
      for (size_t i = 0; i < places.size(); ++i) {
        EXPECT_TRUE(isInMesh(data, places[i].x, places[i].y, 1e-6)) << places[i].x << ' ' << places[i].y;
        for (size_t k = 0; k < i; ++k) nearest = std::min(nearest, glm::length(places[i] - places[k]));
      }
      EXPECT_NEAR(nearest * nearest * count, area, 1e-4 * area) << "exact but for places as floats";
    }
}

TEST_F(FlowsTest, MeshOfARectangleHasItsPoints) {
  constexpr double d = 0.1;
  for (const auto& [width, height] : {std::pair{0.3, 0.2}, {0.5, 0.5}, {0.4, 0.1}, {1.2, 0.7}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    const MouthLattice mesh = mouthLattice(mouthOf(rectMesh(width, height)), d);
    const MouthLattice rect = mouthLattice(RectMouth{{width / 2, height / 2, 0}, {width, height}, {0, 0, 1}, {0, 1, 0}}, d);
    ASSERT_EQ(mesh.points.size(), rect.points.size());
    EXPECT_NEAR(mesh.thickness, rect.thickness, 1e-12);
    const std::vector<glm::dvec3> all = placesOf(rect);
    for (const glm::dvec3& place : placesOf(mesh))
      EXPECT_TRUE(std::ranges::any_of(all, [&](const glm::dvec3& other) { return glm::length(other - place) < 1e-6; }))
          << place.x << ' ' << place.y;
  }
}

TEST_F(FlowsTest, MeshMouthOfLessThanAParticleHasOnePoint) {
  for (const MeshData& data : {cornerMesh(0.01), ringMesh(0.049, 0.05, 40), rectMesh(1, 0.003), rectMesh(3e-5, 0.01)}) {
    const MouthLattice lattice = mouthLattice(mouthOf(data), 0.1);
    ASSERT_EQ(lattice.points.size(), 1u);
    const glm::dvec3 place = placesOf(lattice)[0];
    EXPECT_TRUE(isInMesh(data, place.x, place.y, 1e-8)) << place.x << ' ' << place.y;
    EXPECT_NEAR(lattice.thickness * lattice.area, 1e-3, 1e-12);
  }
}

// A slot narrower than half a spacing has a row of points, as a rectangle of its size does.
TEST_F(FlowsTest, SlotsHaveARowOfPoints) {
  constexpr double d = 0.1;
  for (const auto& [length, width] : {std::pair{20 * d, 0.4 * d}, {30 * d, 0.3 * d}, {10 * d, 0.4 * d}}) {
    SCOPED_TRACE(std::to_string(length) + " x " + std::to_string(width));
    const MouthLattice slot = mouthLattice(mouthOf(rectMesh(length, width)), d);
    EXPECT_GE(double(slot.points.size()), length / d / 2);
    EXPECT_NEAR(double(slot.points.size()) * d * d * d, slot.thickness * slot.area, 1e-12);
  }
}

// The device searches for points by row and column.
TEST_F(FlowsTest, PointsOfMouthsLieByRows) {
  for (const Mouth& mouth :
       {Mouth{DiscMouth{{0, 0, 0}, 0.37, {1, 2, 3}}}, Mouth{mouthOf(ringMesh(0.2, 0.5, 24))}, Mouth{mouthOf(twoPieces())}}) {
    const auto points = mouthLattice(mouth, 0.04).points;
    EXPECT_TRUE(std::ranges::is_sorted(points, {}, [](const auto& p) { return std::pair{p[1], p[0]}; }));
    EXPECT_EQ(std::ranges::adjacent_find(points), points.end());
  }
}

/// Away from its origin and turned out of its plane.
MeshMouth placed(MeshData data) {
  MeshMouth mouth = mouthOf(moved(std::move(data), 0.2, -0.1));
  mouth.translation = {0.1, 0.2, 0.3};
  mouth.rotation = turn({0.48, 0.6, 0.64}, 1.2);
  return mouth;
}

TEST_F(FlowsTest, ParticlesLeaveMeshesAtTheirOwnTimes) {
  Trial t = space();
  t.scene.emitters = {{.mouth = placed(cornerMesh(0.15)), .speed = 1.5}};
  expectBirthsInEveryWay(t);
}

TEST_F(FlowsTest, ParticlesLeaveMeshesThatMove) {
  Trial t = space();
  t.scene.emitters = {{.mouth = placed(cornerMesh(0.15)), .speed = 1.5, .motion = {{.at = 0}, {.at = 0.5, .translate = {0.6, -0.3, 0.4}}}}};
  expectBirthsInEveryWay(t);
}

// About the mesh's origin, which is not in its middle.
TEST_F(FlowsTest, SingleParticlesLeaveMeshesThatTurn) {
  Trial t = space();
  t.scene.emitters = {{.mouth = placed(cornerMesh(0.02)), .speed = 4}};
  t.scene.emitters[0].motion = {{.at = 0.05, .translate = {0.1, 0, 0}},
                                {.at = 0.15, .translate = {0, 0.2, 0}},
                                {.at = 0.3, .translate = {-0.1, 0, -0.3}, .rotate = turn({0, 0.6, 0.8}, 1.1)}};
  auto run = start(t);
  for (int frame = 0; frame < 8; ++frame) run->advance(0.05);
  expectBirths(t, *run, 2e-3, 2e-3);
}

TEST_F(FlowsTest, FlowOfMeshesIsExactWhateverTheFrames) {
  Trial t = space();
  MeshMouth beside = mouthOf(ringMesh(0.1, 0.3, 16));
  beside.translation = {3, 0, 0};
  t.scene.emitters = {{.mouth = mouthOf(cornerMesh(0.2)), .speed = 2}, {.mouth = beside, .flow = 0.03, .until = 0.31}};
  t.step = 4e-3;
  expectExactFlow(t, {2 * 3 * 0.2 * 0.2, 0.03}, {0.4, 1.0 / 60});
}

// Single particles, of which those in the place of the next layer are pushed along the flow, or away from the rim.
TEST_F(FlowsTest, MeshMouthsPushWhatIsInTheirLayersAlone) {
  Trial t = space();
  const double d = t.d(), side = 4 * d;
  t.scene.emitters = {{.mouth = mouthOf(cornerMesh(side)), .speed = 0.1}};
  const double far = 0.2 * d;
  t.x = {{-side / 2, -side / 2, far},  {side / 2, -side / 2, far},  // in the arms
         {side / 2, side / 2, far},                                 // in the corner between them
         {1.4 * d, 1.4 * d, far},                                   // there, too, near the inner corner
         {side / 2, 0.4 * d, far},                                  // beside an arm, half a spacing from what leaves
         {-side / 2, -side / 2, 3 * d}};                            // ahead
  auto run = start(t);
  run->advance(t.step);
  const Snapshot s = run->snapshot();
  for (size_t i : {0, 1}) EXPECT_NEAR(s.v[i].z, 0.1, 1e-3) << i;
  for (size_t i : {2, 3, 5}) EXPECT_EQ(glm::length(s.v[i]), 0) << i;
  EXPECT_GT(s.x[4].y, 0.4 * d) << "out of the piston, sideways";
  EXPECT_LT(std::abs(s.x[4].x - side / 2), 1e-3 * d);
}

TEST_F(FlowsTest, MeshMouthsPushSubmergedFluidAwayWithoutABang) {
  Trial t = tank();
  t.settle = true;
  t.scene.solver.tolerance = 1e-3;
  MeshMouth mouth = mouthOf(cornerMesh(2 * t.d()));
  mouth.translation = {0.5, 0.25, 0.25};
  mouth.rotation = turn({0, 1, 0}, std::numbers::pi / 2);
  t.scene.emitters = {{.mouth = mouth, .speed = 0.5}};
  t.step = 5e-3;
  auto run = start(t);
  double mean = 0, fastest = 0;
  for (int frame = 0; frame < 60; ++frame) {
    run->advance(1.0 / 60);
    const FluidStats s = run->stats();
    mean += s.densityErrorMean / 60;
    fastest = std::max(fastest, s.maxSpeed);
  }
  EXPECT_LT(mean, 1e-3) << "the tolerance";
  EXPECT_LT(fastest, 3);
}

TEST_F(FlowsTest, MeshMouthGoesOnFromASnapshotBitForBit) {
  Trial t = tank();
  t.scene.emitters = {{.mouth = placed(cornerMesh(0.1)), .speed = 4}};
  t.scene.emitters[0].motion = {{.at = 0.01}, {.at = 0.2, .translate = {0.3, 0, 0}, .rotate = turn({0, 0, 1}, 0.6)}};
  EXPECT_GT(goesOnFromASnapshot(t).emitted, 20u);
}

}  // namespace flows_test
}  // namespace rill::test
