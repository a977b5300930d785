// The shaders that walk the grid, run on lanes that reconverge only where a rule guarantees it. No installed driver reconverges as little.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "lanes/walk_scene.hpp"
#include "shared/neighbor_list.h"

namespace rill {
std::span<const EmbeddedShader> leavingShaders();  // built with loops that each cluster leaves separately: shaders/fluid/cluster.glsl
}

namespace rill::lanes {
namespace {

struct Case {
  const char* shader;
  uint32_t size, cluster;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.shader << ", subgroups of " << c.size << ", clusters of " << c.cluster; }

class ReconvergenceTest : public testing::TestWithParam<Case> {
 protected:
  static const WalkScene& scene() {
    static const WalkScene made;
    return made;
  }
  Outcome run(std::span<const EmbeddedShader> shaders, Rules rules, uint32_t seed) const {
    const Case& c = GetParam();
    return walk(scene(), *findShader(shaders, c.shader), c.size, c.cluster, rules, seed);
  }
  /// Where a cluster is its subgroup and lanes come together again: what CPU drivers do.
  Outcome expected() const { return walk(scene(), *findShader(embeddedShaders(), GetParam().shader), 4, 4, Rules::Maximal, 1); }
  static void expectSameParticles(const Outcome& found, const Outcome& wanted) {
    for (const auto& [name, words] : wanted.arrays) {
      if (name != "sums") {  // of floats, by subgroups
        EXPECT_EQ(found.arrays.at(name), words) << name;
      }
    }
  }
};

TEST_P(ReconvergenceTest, NoShuffleReadsAnAbsentLane) {
  const Outcome wanted = expected();
  ASSERT_EQ(wanted.strayShuffles, 0u);
  for (const Rules rules : {Rules::SubgroupUniform, Rules::Maximal})
    for (const uint32_t seed : {1u, 2u}) {
      const Outcome found = run(embeddedShaders(), rules, seed);
      EXPECT_EQ(found.strayShuffles, 0u);
      expectSameParticles(found, wanted);
    }
}

// Shows that the emulator separates lanes, and what a device must guarantee where clusters leave loops separately.
TEST_P(ReconvergenceTest, LoopsThatClustersLeaveNeedMaximalReconvergence) {
  const Case& c = GetParam();
  const Outcome wanted = expected(), maximal = run(leavingShaders(), Rules::Maximal, 1);
  EXPECT_EQ(maximal.strayShuffles, 0u);
  expectSameParticles(maximal, wanted);
  const Outcome uniform = run(leavingShaders(), Rules::SubgroupUniform, 1);
  if (c.cluster == c.size) {
    EXPECT_EQ(uniform.strayShuffles, 0u);
  } else {
    EXPECT_GT(uniform.strayShuffles, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ReconvergenceTest,
                         testing::Values(Case{"fluid/build", 32, 4}, Case{"fluid/build", 32, 32}, Case{"fluid/build", 64, 16},
                                         Case{"fluid/build", 64, 32}, Case{"fluid/density", 32, 4}, Case{"fluid/density", 64, 32},
                                         Case{"fluid/measure", 32, 8}, Case{"fluid/measure", 64, 32}));

/// The neighbors that the first block of a list has for particle i, in ascending order.
std::vector<uint32_t> listed(const Outcome& build, uint32_t i) {
  const uint32_t head = build.arrays.at("listHead")[i];
  std::vector<uint32_t> found;
  for (uint32_t k = 0, j = i - (head >> kHeadDistanceShift); k < (head & kUnlisted); ++k) {
    const uint32_t entry = build.arrays.at("list")[2 * (i + k / 4 * kListBlock) + k % 4 / 2] >> 16 * (k % 2) & 0xffffu;
    j += entry < kLongStep ? entry : static_cast<uint32_t>(static_cast<int32_t>(entry << 20) >> (20 - kLongStepShift));
    if (entry < kLongStep) found.push_back(j);
  }
  std::ranges::sort(found);
  return found;
}

TEST(LaneEmulator, FindsAllPairs) {
  const WalkScene scene;
  const Outcome build = walk(scene, *findShader(embeddedShaders(), "fluid/build"), 64, 32, Rules::SubgroupUniform, 3);
  const Outcome measure = walk(scene, *findShader(embeddedShaders(), "fluid/measure"), 64, 32, Rules::SubgroupUniform, 3);
  uint32_t overflowing = 0, wrapped = 0;
  for (uint32_t i = 0; i < scene.count(); ++i) {
    const std::vector<uint32_t> neighbors = scene.neighborsOf(i, scene.params.reach);
    if ((build.arrays.at("listHead")[i] & kUnlisted) == kUnlisted) {
      ++overflowing;
      EXPECT_GT(neighbors.size(), kListCapacity - 4) << i;  // steps around a seam take entries, too
    } else {
      EXPECT_EQ(listed(build, i), neighbors) << i;
    }
    wrapped += scene.particles[i][0] < 0;
    if (scene.particles[i][0] < kInactiveLimit) {
      EXPECT_NEAR(std::bit_cast<float>(measure.arrays.at("velocity")[4 * i + 3]), scene.densityOf(i), 1e-5) << i;
    }
  }
  EXPECT_GT(overflowing, 40u);
  EXPECT_GT(wrapped, 40u);
}

}  // namespace
}  // namespace rill::lanes
