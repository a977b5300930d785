// Scenes of many solids: each particle visits those near it alone, with the same result as if it visited all.
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "fluid/near_solids.hpp"
#include "fluid/rig.hpp"
#include "shape/pose.hpp"
#include "shared/solid_records.h"
#include "sph/solid_density.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace many_solids_test {

/// Fluid that falls onto balls, boxes and meshes; the first 36 overlap, so that some particles have more near than a list holds.
Trial falling() {
  Trial t = trial();
  const double d = t.d();
  setWalls(t, {4, 1, 1});
  const auto mesh = meshOf(ballMesh(1.5 * d, 2));
  for (int k = 0; k < 72; ++k) {
    const int column = k % 12, row = k / 12;
    const glm::dvec3 at = row < 3 ? glm::dvec3(0.2 + 0.014 * k, 0.1, 0.5) : glm::dvec3(0.2 + 0.33 * column, 0.1, 0.33 * row - 0.82);
    if (k % 3 == 0) t.scene.solids.push_back(ball(at, 1.2 * d));
    if (k % 3 == 1) t.scene.solids.push_back(slab(at - 0.9 * d, at + 0.9 * d));
    if (k % 3 == 2) t.scene.solids.push_back(Solid{.shape = MeshShape{.mesh = mesh}, .translation = {at.x, at.y, at.z}});
  }
  t.scene.solids.back().motion = {{0, {0, 0, 0}}, {1, {0, 0.3, 0}}};
  t.x = block({24, 5, 14}, d, {0.06, 0.2, 0.06}, 0.05);
  return t;
}

class ManySolidsTest : public FluidTest {};

TEST_F(ManySolidsTest, MatchReference) {
  const Trial t = falling();
  expectEqual(t, 1, 4e-5, 2e-3);  // the density that up to 36 solids displace is summed, each rounded
  expectEqual(t, 10, 1e-3, 1e-1);
}

TEST_F(ManySolidsTest, ListsHoldAllThatAreNear) {
  const Trial t = falling();
  auto run = start(t);
  run->substeps(1);
  const FluidSnapshot saved = run->saved();
  const double d = t.d(), limit = solidReach(SmoothingKernel(t.scene.solver.kernel, t.scene.fluid.smoothing_ratio * d, d));
  std::map<uint32_t, const NearSolids*> listed;
  for (const NearSolids& near : saved.nearSolids) listed[near.particle] = &near;
  size_t whole = 0, many = 0, some = 0, none = 0;
  for (uint32_t i = 0; i < saved.position.size(); ++i) {
    const Double3 x{saved.position[i].x, saved.position[i].y, saved.position[i].z};
    std::set<uint16_t> near;
    for (uint16_t k = 0; k < t.scene.solids.size(); ++k)
      if (surfaceAt(t.scene.solids[k].shape, solidPose(t.scene.solids[k], 0), x).distance < limit) near.insert(k);
    const NearSolids* own = listed.contains(i) ? listed[i] : nullptr;
    if (near.empty()) none += own == nullptr;
    if (own && own->solids[0] == kAllSolids) {
      ++whole;
      continue;
    }
    if (near.empty()) continue;
    ASSERT_TRUE(own) << i;
    ++some;
    many += near.size() > 6;
    for (const uint16_t k : near) EXPECT_TRUE(std::ranges::find(own->solids, k) != own->solids.end()) << "particle " << i << " solid " << k;
  }
  EXPECT_GT(whole, 10u);
  EXPECT_GT(some, 40u);
  EXPECT_GT(many, 20u) << "no list takes more than four words";
  EXPECT_GT(none, 10u) << "the list is no list of all";
}

TEST_F(ManySolidsTest, GoOnFromASnapshotBitwise) {
  const Trial t = falling();
  auto whole = start(t);
  whole->substeps(10);
  const FluidSnapshot saved = whole->saved();
  whole->substeps(10);
  auto second = start(t, &saved);
  second->substeps(10);
  EXPECT_EQ(whole->snapshot(), second->snapshot());
}

/// How many more solids a list has room for changes how it is stored, not what it says: of five solids, one a body and one that fluid
/// sticks to, the bits are the same beside others that are out of reach.
TEST_F(ManySolidsTest, DistantSolidsChangeNoBit) {
  Trial t = falling();
  t.scene.solids.resize(5);
  t.scene.solids[1].body = Body{.density = 600};
  t.scene.solids[3].slip = false;
  t.scene.fluid.viscosity = 1;
  auto alone = start(t);
  alone->substeps(10);
  for (const size_t solids : {7, 15, 23, 31}) {
    while (t.scene.solids.size() < solids) {
      const double n = double(t.scene.solids.size());
      t.scene.solids.push_back(slab({3.6, 0.02 * n, 0.4}, {3.7, 0.02 * n + 0.01, 0.6}));
    }
    auto run = start(t);
    run->substeps(10);
    EXPECT_EQ(run->snapshot(), alone->snapshot()) << solids << " solids";
  }
}

TEST(NearSolidEntries, ComeBackAsTheyWere) {
  for (const auto& [solids, quads] : std::initializer_list<std::pair<uint32_t, uint32_t>>{
           {1, 1}, {6, 1}, {7, 2}, {14, 2}, {15, 3}, {22, 3}, {23, 4}, {30, 4}, {31, 4}, {kMaxSolids, 4}}) {
    ASSERT_EQ(nearSolidQuads(solids), quads) << solids << " solids";
    FluidSnapshot s;
    for (uint32_t particle = 0; particle < 3; ++particle) {
      NearSolids near{.particle = 5 * particle};
      near.solids.fill(kNoSolid);
      for (uint32_t k = 0; k < std::min(solids, kListedSolids) - particle % solids; ++k) near.solids[k] = static_cast<uint16_t>(k);
      s.nearSolids.push_back(near);
    }
    const std::vector<uint32_t> words = layOutNearSolids(s, quads);
    EXPECT_EQ(words.size(), size_t{3} * 4 * quads);
    EXPECT_EQ(gatherNearSolids(words, quads), s.nearSolids) << solids << " solids";
  }
}

}  // namespace many_solids_test
}  // namespace rill::test
