#include "offline/state_hash.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rill::offline {
namespace {

const std::vector<Float3> kPositions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
const std::vector<Float3> kVelocities = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
const std::vector<uint32_t> kIds = {0, 1, 2};

TEST(StateHash, EmptyStateHashesToOffsetBasis) { EXPECT_EQ(stateHash({}, {}, {}), 0xcbf29ce484222325ull); }

TEST(StateHash, IsFnv1aOverTheBytes) {
  // Six zero floats are 24 zero bytes: 24 multiplications by the prime.
  uint64_t expected = 0xcbf29ce484222325ull;
  for (int i = 0; i < 24; ++i) expected *= 0x100000001b3ull;
  const std::vector<Float3> zero(1);
  EXPECT_EQ(stateHash(zero, zero, std::vector<uint32_t>{0}), expected);
}

TEST(StateHash, IsIndependentOfStorageOrder) {
  const std::vector<Float3> p = {kPositions[2], kPositions[0], kPositions[1]}, v = {kVelocities[2], kVelocities[0], kVelocities[1]};
  EXPECT_EQ(stateHash(p, v, std::vector<uint32_t>{2, 0, 1}), stateHash(kPositions, kVelocities, kIds));
}

TEST(StateHash, DependsOnEveryBit) {
  const uint64_t base = stateHash(kPositions, kVelocities, kIds);
  auto positions = kPositions;
  positions[1].y = 5.0000005f;
  EXPECT_NE(stateHash(positions, kVelocities, kIds), base);
  auto velocities = kVelocities;
  velocities[0].x = -0.0f;
  EXPECT_NE(stateHash(kPositions, velocities, kIds), base);
}

TEST(StateHash, CoversTheFluidOfEachParticle) {
  const auto of = [](const std::vector<uint32_t>& ids, const std::vector<uint8_t>& fluids) {
    return stateHash(kPositions, kVelocities, ids, {}, fluids);
  };
  EXPECT_NE(of(kIds, {0, 1, 0}), of(kIds, {0, 0, 1}));
  EXPECT_NE(of(kIds, {0, 1, 0}), of(kIds, {0, 2, 0}));
  const std::vector<Float3> p = {kPositions[2], kPositions[0], kPositions[1]}, v = {kVelocities[2], kVelocities[0], kVelocities[1]};
  EXPECT_EQ(stateHash(p, v, std::vector<uint32_t>{2, 0, 1}, {}, std::vector<uint8_t>{0, 2, 1}), of(kIds, {2, 1, 0}));
  EXPECT_EQ(of(kIds, {0, 0, 0}), stateHash(kPositions, kVelocities, kIds)) << "one fluid";
}

TEST(StateHash, CoversConcentrations) {
  const std::vector<Float4> mixed = {{0.5F, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0.25F}};
  const auto of = [](const std::vector<uint32_t>& ids, const std::vector<Float4>& concentrations) {
    return stateHash(kPositions, kVelocities, ids, {}, {}, concentrations);
  };
  const uint64_t base = of(kIds, mixed);
  EXPECT_NE(base, of(kIds, {}));
  for (float Float4::*component : {&Float4::x, &Float4::y, &Float4::z, &Float4::w}) {
    auto other = mixed;
    other[1].*component += 1e-6F;
    EXPECT_NE(of(kIds, other), base);
  }
  const std::vector<Float3> p = {kPositions[2], kPositions[0], kPositions[1]}, v = {kVelocities[2], kVelocities[0], kVelocities[1]};
  EXPECT_EQ(stateHash(p, v, std::vector<uint32_t>{2, 0, 1}, {}, {}, std::vector<Float4>{mixed[2], mixed[0], mixed[1]}), base);
}

TEST(OrderById, SortsIdsWithGapsAndRepeats) {
  EXPECT_EQ(orderById(std::vector<uint32_t>{2, 0, 1}), (std::vector<uint32_t>{1, 2, 0}));
  EXPECT_EQ(orderById(std::vector<uint32_t>{90, 7, 40}), (std::vector<uint32_t>{1, 2, 0}));
  EXPECT_EQ(orderById(std::vector<uint32_t>{1, 1, 0}), (std::vector<uint32_t>{2, 0, 1}));
  EXPECT_TRUE(orderById({}).empty());
}

}  // namespace
}  // namespace rill::offline
