// Meshes as solids: on the device as in the reference, beside analytic solids, and thin ones that hold water.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "fluid/rig.hpp"
#include "shape/shape.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace mesh_test {

Solid meshSolid(MeshData data, Double3 at = {}, bool twoSided = false) {
  return {.shape = MeshShape{.two_sided = twoSided, .mesh = meshOf(std::move(data), twoSided)}, .translation = at};
}

/// Fluid that falls onto a ball with a bar through it.
Trial falling() {
  Trial t = trial();
  setWalls(t, {1, 1, 1});
  t.scene.solids = {meshSolid(joined(ballMesh(0.2, 3), boxMesh({-0.35, -0.05, -0.08}, {0.35, 0.05, 0.08})), {0.5, 0.3, 0.5})};
  const MeshShape& shape = std::get<MeshShape>(t.scene.solids[0].shape);
  for (const glm::dvec3& x : block({14, 10, 14}, t.d(), {0.0625, 0.0625, 0.0625}, 0.05))
    if (surfaceAt(shape, {x.x - 0.5, x.y - 0.3, x.z - 0.5}).distance > 0.5 * t.d()) t.x.push_back(x);
  return t;
}

class MeshTest : public FluidTest {
 protected:
  /// Frame by frame, so that no time is dropped.
  template <class Run>
  static void shake(Run& run, int seconds) {
    for (int frame = 0; frame < 60 * seconds; ++frame) run.advance(1.0 / 60);
    EXPECT_NEAR(run.progress().time_s, seconds, 1e-3);
  }
  /// Distance of a particle from the middle of a cup's opening beyond which it is spilt or through, over all particles: spacings.
  static size_t beyond(const Snapshot& s, const glm::dvec3& low, const glm::dvec3& high) {
    size_t count = 0;
    for (const glm::dvec3& x : s.x) count += x.y < high.y && (x.x < low.x || x.x > high.x || x.y < low.y || x.z < low.z || x.z > high.z);
    return count;
  }
};

TEST_F(MeshTest, MatchesReference) {
  // The device finds a substep's start from velocities, which are bounded: see docs/notes/walls-and-solids.md.
  constexpr double kOne = 1.5e-4, kTen = 1.5e-3;
  Trial t = falling();
  expectEqual(t, 1, kOne, 2e-3);
  expectEqual(t, 10, kTen, 3e-2);
  t.scene.solids[0].friction = 0.4;
  t.scene.solids[0].restitution = 0.5;
  for (int k = 0; k <= 4; ++k)
    t.scene.solids[0].motion.push_back({0.1 * k, {0, 0.05 * k, 0}, {0, std::sin(0.2 * k), 0, std::cos(0.2 * k)}});
  expectEqual(t, 1, kOne, 2e-3);
  expectEqual(t, 10, kTen, 3e-2);
}

// Far from edges a mesh is the box that it describes.
TEST_F(MeshTest, SlabOfTrianglesActsAsBox) {
  Trial box = trial(), mesh = trial();
  box.scene.solids = {slab({-2, -0.5, -2}, {2, 0, 2})};
  mesh.scene.solids = {meshSolid(boxMesh({-2, -0.5, -2}, {2, 0, 2}))};
  box.x = mesh.x = block({7, 5, 7}, box.d(), {0, 0, 0}, 0.05);
  auto a = start(box), b = start(mesh);
  a->substeps(50);
  b->substeps(50);
  const Snapshot one = a->snapshot(), other = b->snapshot();
  double most = 0;
  for (size_t i = 0; i < one.x.size(); ++i) most = std::max(most, glm::length(one.x[i] - other.x[i]) / box.d());
  EXPECT_LT(most, 0.01);
}

// Gravity that turns shakes a cup: no particle goes through its walls, which are as thick as a particle, or a sheet.
TEST_F(MeshTest, ThinWallsHoldShakenWater) {
  Trial t = trial();
  const double d = t.d(), inside = 8 * d;
  const glm::dvec3 low{0, 0, 0}, high{inside, 12 * d, inside};
  t.x = block({7, 6, 7}, d, {0.5 * d, 0.5 * d, 0.5 * d});
  for (int k = 1; k < 30; ++k) t.scene.gravity_changes.push_back({0.1 * k, {12 * std::sin(2.1 * k), -9.81, 12 * std::cos(3.3 * k)}});
  const Double3 from{low.x, low.y, low.z}, to{high.x, 40 * d, high.z};
  for (bool sheet : {false, true}) {
    t.scene.solids = {sheet ? meshSolid(openBox(from, to), {}, true) : meshSolid(cupMesh(from, to, d))};
    auto run = start(t);
    shake(*run, 2);
    const Snapshot s = run->snapshot();
    ASSERT_TRUE(s.finite());
    EXPECT_EQ(beyond(s, low, {high.x, 40 * d, high.z}), 0u) << (sheet ? "sheet" : "cup");
    EXPECT_GT(s.fastest(), 0.1) << "it is shaken";
  }
}

// Closed boxes that move to and fro at 3 m/s.
TEST_F(MeshTest, MovingThinWallsHoldWater) {
  Trial t = trial();
  const double d = t.d(), inside = 8 * d;
  t.x = block({7, 6, 7}, d, {0.5 * d, 0.5 * d, 0.5 * d});
  const Double3 from{0, 0, 0}, to{inside, inside, inside};
  for (bool sheet : {false, true}) {
    const MeshData box = boxMesh(from, to);
    Solid tank =
        sheet ? meshSolid(box, {}, true) : meshSolid(joined(boxMesh({-d, -d, -d}, {inside + d, inside + d, inside + d}), turned(box)));
    for (int k = 0; k <= 10; ++k) tank.motion.push_back({0.1 * k, k % 2 == 0 ? Double3{} : Double3{0.25, 0, 0.15 * (k % 3)}});
    t.scene.solids = {tank};
    auto run = start(t);
    shake(*run, 1);
    const Snapshot s = run->snapshot();
    ASSERT_TRUE(s.finite());
    EXPECT_EQ(std::ranges::count_if(s.x,
                                    [&](const glm::dvec3& x) {
                                      return glm::any(glm::lessThan(x, glm::dvec3(0))) || glm::any(glm::greaterThan(x, glm::dvec3(inside)));
                                    }),
              0)
        << (sheet ? "sheet" : "solid walls");
    EXPECT_GT(s.fastest(), 0.5) << "it is shaken";
  }
}

// A fill that reaches up to a sheet overlaps with the half spacing that the sheet is thick: it is parted, and stays on its side.
TEST_F(MeshTest, SheetKeepsAFillThatTouchesIt) {
  Trial t = trial();
  const double d = t.d(), inside = 8 * d;
  t.scene.solids = {meshSolid(openBox({0, 0, 0}, {inside, 40 * d, inside}), {}, true)};
  t.x = block({8, 6, 8}, d);
  t.settle = true;
  auto run = start(t);
  run->advance(0.25);
  const Snapshot s = run->snapshot();
  ASSERT_TRUE(s.finite());
  EXPECT_EQ(beyond(s, {0, 0, 0}, {inside, 40 * d, inside}), 0u);
}

TEST_F(MeshTest, GoesOnFromASnapshotBitwise) {
  Trial t = falling();
  t.scene.solids[0].motion = {{0, {0, 0, 0}}, {1, {0, 0.2, 0}, {0, 0.6, 0, 0.8}}};
  auto whole = start(t);
  whole->substeps(20);
  const FluidSnapshot saved = whole->saved();
  whole->substeps(20);
  auto second = start(t, &saved);
  second->substeps(20);
  EXPECT_EQ(whole->snapshot(), second->snapshot());
}

}  // namespace mesh_test
}  // namespace rill::test
