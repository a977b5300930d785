// The layer of layers/hostile.cpp does what its tests rely on, in the tests with the label hostile-driver. Without it products are exact
// (Vulkan 1.3 requires them to be correctly rounded) and each workgroup runs once.
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "support/gpu_test.hpp"

namespace rill::test {
namespace hostile_driver_test {

struct Source {
  float one = 1, denormal = 1e-40f, halves[2] = {-5e-5f, 6.103515625e-5f};
  uint32_t half = 0x0200;
  float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  float factors[8] = {1.1f, 2.3f, 3.7f, 0.13f, 17.9f, 0.7f, 5.3f, 9.1f};
};
struct Target {
  uint32_t flushed, bits, halves, unpacked, ordered, foundNan, foundInfinity, lowest, shuffled, next, products[8], quotients[8], turn[64];
};

TEST_F(GpuTest, HostileDriverUsesItsFreedomOnly) {
  const char* given = std::getenv("RILL_TEST_HOSTILE");
  const std::string named = given ? given : "";
  const auto is = [&](const std::string& mode) { return ("," + named).find("," + mode) != std::string::npos; };
  const Source source;
  const auto words = wordsFrom("hostile", upload("source", std::span<const Source>(&source, 1)), sizeof(Target) / 4, 64);
  ASSERT_EQ(words.size(), sizeof(Target) / 4);
  Target got;
  std::memcpy(&got, words.data(), sizeof got);

  if (is("flush-denormals")) {
    EXPECT_EQ(got.flushed, 0u);
    EXPECT_EQ(got.bits, 0u);
    EXPECT_EQ(got.halves, 0x04008000u) << "the least normal half stays, the denormal one's sign";
    EXPECT_EQ(got.unpacked, 0u);
  }
  if (is("assume-finite")) {
    EXPECT_EQ(got.ordered, 1u);
    EXPECT_EQ(got.foundNan, 0u);
    EXPECT_EQ(got.foundInfinity, 0u);
    EXPECT_TRUE(std::isnan(std::bit_cast<float>(got.lowest)));
  }
  if (is("poison-shuffles")) { EXPECT_EQ(got.shuffled, 0xdeadbeefu); }
  if (is("varying-subgroups")) {
    EXPECT_EQ(device().info().minSubgroupSize, uint32_t(std::stoul(named.substr(named.find('=') + 1))));
    EXPECT_LT(device().info().minSubgroupSize, device().info().subgroupSize) << "so that clusters are smaller";
  }
  int moved = 0, farthest = 0;
  for (int k = 0; k < 8; ++k) {
    const int away = int(got.products[k] - std::bit_cast<uint32_t>(source.factors[k] * source.factors[(k + 1) % 8]));
    EXPECT_LE(std::abs(away), is("perturb") ? 1 : 0);
    moved += away != 0;
    const int from = int(got.quotients[k] - std::bit_cast<uint32_t>(source.factors[k] / source.factors[(k + 1) % 8]));
    EXPECT_LE(std::abs(from), is("perturb") ? 3 : 1) << "2.5 units are allowed";
    farthest = std::max(farthest, std::abs(from));
  }
  if (is("perturb")) {
    EXPECT_GT(moved, 0);
    EXPECT_GT(farthest, 1);
  }
  std::set<uint32_t> turns(std::begin(got.turn), std::end(got.turn));
  EXPECT_EQ(turns.size(), 64u) << "each workgroup's work is done once";
  if (is("groups")) { EXPECT_FALSE(std::is_sorted(std::begin(got.turn), std::end(got.turn))); }
}

}  // namespace hostile_driver_test
}  // namespace rill::test
