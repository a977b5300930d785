#include <algorithm>
#include <cmath>
#include <cstring>

#include "support.hpp"

namespace rill::test {
namespace {

double distance(const Float3& a, const Float3& b) { return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z); }

std::string withSpacing(const std::string& spacing, const std::string& more) {
  return R"({"rill": "0.1", "fluid": {"spacing": )" + spacing + "}, " + more + "}";
}

TEST(Particles, PlacesBoxLatticeHalfASpacingInside) {
  const ParticleSet set = particles(
      with(R"("domain": {"max": [1, 1, 1]}, "fill": [{"box": {"min": [0, 0, 0], "max": [0.3, 0.2, 0.1]}, "velocity": [1, 2, 3]}])"));
  ASSERT_EQ(set.positions.size(), 6U);
  ASSERT_EQ(set.velocities.size(), 6U);
  EXPECT_EQ(set.positions[0], (Float3{0.05F, 0.05F, 0.05F}));
  EXPECT_NEAR(set.positions[5].x, 0.25, 1e-7);
  EXPECT_NEAR(set.positions[5].y, 0.15, 1e-7);
  EXPECT_EQ(set.velocities[3], (Float3{1, 2, 3}));
  EXPECT_TRUE(set.warnings.empty());
}

TEST(Particles, RoundsCountsPerAxis) {
  const auto count = [](const std::string& max) { return particles(with(R"("fill": [{"box": {"max": )" + max + "}}]")).positions.size(); };
  EXPECT_EQ(count("[0.14, 0.1, 0.1]"), 1U);
  EXPECT_EQ(count("[0.16, 0.1, 0.1]"), 2U);
  EXPECT_EQ(count("[0.15, 0.1, 0.1]"), 2U);  // 1.5, although the binary quotient is slightly less
  EXPECT_EQ(count("[1, 1, 1]"), 1000U);
}

TEST(Particles, CentersLatticeOnSphere) {
  const ParticleSet one = particles(with(R"("domain": {}, "fill": [{"sphere": {"center": [0.5, 0.5, 0.5], "radius": 0.04}}])"));
  ASSERT_EQ(one.positions.size(), 1U);
  EXPECT_EQ(one.positions[0], (Float3{0.5F, 0.5F, 0.5F}));
  const ParticleSet eight = particles(with(R"("domain": {}, "fill": [{"sphere": {"center": [0.5, 0.5, 0.5], "radius": 0.1}}])"));
  ASSERT_EQ(eight.positions.size(), 8U);
  for (const Float3& p : eight.positions) EXPECT_NEAR(distance(p, {0.5F, 0.5F, 0.5F}), 0.05 * std::sqrt(3.0), 1e-6);
  const ParticleSet many = particles(withSpacing("0.01", R"("domain": {"min": [-1, -1, -1]}, "fill": [{"sphere": {"radius": 0.2}}])"));
  EXPECT_NEAR(static_cast<double>(many.positions.size()), 4.0 / 3 * M_PI * 8000, 300);
  double mean = 0;
  for (const Float3& p : many.positions) {
    EXPECT_LE(distance(p, {1, 1, 1}), 0.2 + 1e-6);
    mean += p.x / static_cast<double>(many.positions.size());
  }
  EXPECT_NEAR(mean, 1, 1e-6);
}

TEST(Particles, JitterIsSeededAndBounded) {
  const std::string text = R"("domain": {}, "fill": [{"box": {}, "jitter": 0.5}], "seed": )";
  const ParticleSet a = particles(with(text + "1")), again = particles(with(text + "1")), b = particles(with(text + "2"));
  const ParticleSet lattice = particles(with(R"("domain": {}, "fill": [{"box": {}}])"));
  ASSERT_EQ(a.positions.size(), 1000U);
  EXPECT_EQ(a.positions, again.positions);
  EXPECT_NE(a.positions, b.positions);
  double largest = 0, sum = 0;
  for (size_t i = 0; i < a.positions.size(); ++i) {
    const double dx = double{a.positions[i].x} - lattice.positions[i].x;
    largest = std::max(largest, std::abs(dx));
    sum += dx;
    EXPECT_GE(a.positions[i].x, 0);
    EXPECT_LE(a.positions[i].x, 1);
  }
  EXPECT_LE(largest, 0.05 + 1e-6);
  EXPECT_GT(largest, 0.045);
  EXPECT_NEAR(sum / 1000, 0, 0.003);
}

TEST(Particles, JitterIsIndependentOfOtherFillsAndLosesNoParticles) {
  const ParticleSet both = particles(with(
      R"("domain": {"max": [2, 1, 1]}, "fill": [{"box": {}, "jitter": 0.5}, {"box": {"min": [1, 0, 0], "max": [2, 1, 1]}, "jitter": 0.5}])"));
  EXPECT_EQ(both.positions.size(), 2000U);  // jittered neighbors across the border of two fills may be close
  const ParticleSet alone = particles(with(R"("domain": {"max": [2, 1, 1]}, "fill": [{"box": {}, "jitter": 0.5}])"));
  EXPECT_TRUE(std::equal(alone.positions.begin(), alone.positions.end(), both.positions.begin()));
}

TEST(Particles, LeavesOutAndReportsOverlaps) {
  const ParticleSet set = particles(with(
      R"("fill": [{"box": {}}, {"box": {"min": [0.5, 0, 0], "max": [1.5, 1, 1]}}, {"sphere": {"center": [5, 5, 5], "radius": 0.2}}])"));
  EXPECT_EQ(set.leftOutOverlap, 500U);
  EXPECT_GE(set.positions.size(), 1500U);
  ASSERT_EQ(set.warnings.size(), 1U);
  EXPECT_EQ(set.warnings[0], "dam: fill[1]: 500 of 1,000 particles are closer than 0.9 spacings to earlier fills, and are left out");
  for (size_t i = 0; i < set.positions.size(); ++i) {
    for (size_t j = 0; j < i; ++j) ASSERT_GE(distance(set.positions[i], set.positions[j]), 0.0899);
  }
}

/// The spatial hash agrees with a comparison of all pairs, also across cell borders and at negative coordinates.
TEST(Particles, OverlapsMatchAllPairsSearch) {
  const ParticleSet set = particles(with(
      R"("fill": [{"sphere": {"center": [0.03, -0.01, 0.02], "radius": 0.5}}, {"sphere": {"center": [-0.4, 0.21, 0.1], "radius": 0.5}}])"));
  const ParticleSet a = particles(
      with(R"("domain": {"min": [-9, -9, -9], "max": [9, 9, 9]}, "fill": [{"sphere": {"center": [0.03, -0.01, 0.02], "radius": 0.5}}])"));
  const ParticleSet b = particles(
      with(R"("domain": {"min": [-9, -9, -9], "max": [9, 9, 9]}, "fill": [{"sphere": {"center": [-0.4, 0.21, 0.1], "radius": 0.5}}])"));
  uint64_t near = 0;
  for (const Float3& p : b.positions)
    near += std::any_of(a.positions.begin(), a.positions.end(), [&](const Float3& q) { return distance(p, q) < 0.09; });
  EXPECT_GT(near, 20U);
  EXPECT_EQ(set.leftOutOverlap, near);
  EXPECT_EQ(set.positions.size(), a.positions.size() + b.positions.size() - near);
}

TEST(Particles, LeavesOutParticlesInsideSolids) {
  const std::string fill = R"("fill": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}], )";
  const auto left = [&](const std::string& solid) { return particles(with(fill + "\"solids\": [" + solid + "]")).leftOutSolid; };
  EXPECT_EQ(left(R"({"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.5]}})"), 125U);
  EXPECT_EQ(left(R"({"box": {"min": [0.2, 0.2, 0.2], "max": [0.4, 0.4, 0.4]}, "motion": [{"at": 1, "translate": [5, 0, 0]}]})"), 0U);
  EXPECT_EQ(
      left(
          R"({"box": {"min": [0.2, 0.2, 0.2], "max": [0.4, 0.4, 0.4]}, "motion": [{"at": 0, "translate": [0.1, 0, 0]}, {"at": 1, "translate": [5, 0, 0]}]})"),
      8U);
  // A bar along x, rotated by 90 degrees about y: along z.
  EXPECT_EQ(left(R"({"box": {"min": [0, 0.4, 0.4], "max": [1, 0.6, 0.6]}, "rotation": [0, 1, 0, 1]})"), 40U);
  EXPECT_EQ(left(R"({"box": {"min": [0, 0.4, 0], "max": [1, 0.6, 0.2]}, "rotation": [0, 1, 0, 1]})"), 24U);
  EXPECT_EQ(left(R"({"sphere": {"center": [0.5, 0.5, 0.5], "radius": 0.3}})"), 136U);
  const ParticleSet set = particles(with(fill + R"("solids": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.5]}}])"));
  ASSERT_EQ(set.warnings.size(), 1U);
  EXPECT_EQ(set.warnings[0], "dam: fill[0]: 125 of 1,000 particles start inside a solid and are left out");
}

TEST(Particles, TestsEverySolid) {
  std::string solids;
  for (int i = 0; i < 1000; ++i) {
    solids += (i ? "," : "") + std::string(R"({"sphere": {"radius": 0.01, "center": [)") + std::to_string(0.05 + 0.1 * (i % 10)) + "," +
              std::to_string(0.05 + 0.1 * (i / 10 % 10)) + "," + std::to_string(0.05 + 0.1 * (i / 100)) + "]}}";
  }
  const ParticleSet set = particles(with(R"("fill": [{"box": {"max": [1, 1, 1.1]}}], "solids": [)" + solids + "]"));
  EXPECT_EQ(set.leftOutSolid, 1000U);
  EXPECT_EQ(set.positions.size(), 100U);
}

TEST(Particles, LeavesOutParticlesBeyondClosedWallsOnly) {
  const std::string fill = R"("fill": [{"box": {"min": [-0.2, 0, 0], "max": [0.8, 1.2, 1]}}])";
  const ParticleSet closed = particles(with(R"("domain": {}, )" + fill));
  EXPECT_EQ(closed.positions.size(), 800U);
  EXPECT_EQ(closed.leftOutDomain, 400U);
  ASSERT_EQ(closed.warnings.size(), 1U);
  EXPECT_EQ(closed.warnings[0], "dam: fill[0]: 400 of 1,200 particles start outside the domain's walls and are left out");
  const ParticleSet open = particles(with(R"("domain": {"open": ["+y", "-x"]}, )" + fill));
  EXPECT_EQ(open.positions.size(), 1200U);
  EXPECT_TRUE(open.warnings.empty());
  EXPECT_LT(open.positions[0].x, 0);
}

TEST(Particles, KeepsFullTankDespiteRounding) {
  for (const std::string spacing : {"0.1", "0.05", "0.03", "0.07", "0.023", "0.3"}) {
    const ParticleSet set = particles(withSpacing(
        spacing,
        R"("domain": {"min": [0.1, -0.7, 1000.3], "max": [1.3, 0.2, 1001.2]}, "fill": [{"box": {"min": [0.1, -0.7, 1000.3], "max": [1.3, 0.2, 1001.2]}}])"));
    EXPECT_EQ(set.leftOutDomain, 0U) << spacing;
    for (const Float3& p : set.positions)
      ASSERT_TRUE(p.x > 0 && p.y > 0 && p.z > 0 && p.x <= 1.2F && p.y <= 0.9F && p.z <= 0.9F + 1e-4F) << spacing;
  }
}

TEST(Particles, IsTranslationInvariant) {
  const ParticleSet near = particles(with(R"("domain": {}, "fill": [{"box": {"max": [0.5, 0.5, 0.5]}, "jitter": 0.2}])"));
  const ParticleSet far = particles(with(
      R"("domain": {"min": [4096, -8192, 1024], "max": [4097, -8191, 1025]}, "fill": [{"box": {"min": [4096, -8192, 1024], "max": [4096.5, -8191.5, 1024.5]}, "jitter": 0.2}])"));
  ASSERT_EQ(near.positions.size(), far.positions.size());
  EXPECT_EQ(far.origin[1], -8192);
  for (size_t i = 0; i < near.positions.size(); ++i) ASSERT_LT(distance(near.positions[i], far.positions[i]), 1e-7);
}

TEST(Particles, PlacesOriginAtWholeSpacingsWithoutDomain) {
  const ParticleSet set = particles(with(R"("fill": [{"box": {"min": [10, 20, 30], "max": [10.5, 20.7, 30.3]}}])"));
  for (const double o : set.origin) EXPECT_NEAR(o / 0.1, std::round(o / 0.1), 1e-9);
  EXPECT_NEAR(set.origin[0], 10.25, 0.051);
  EXPECT_NEAR(set.positions[0].x + set.origin[0], 10.05, 1e-6);
  EXPECT_NEAR(set.positions[0].z + set.origin[2], 30.05, 1e-6);
}

TEST(Particles, WarnsOfCoarseFloatsFarFromDomain) {
  const ParticleSet set = particles(withSpacing(
      "0.01", R"("domain": {"max": [1, 1, 1], "open": ["+x"]}, "fill": [{"box": {"min": [5000, 0, 0], "max": [5000.1, 0.1, 0.1]}}])"));
  ASSERT_EQ(set.warnings.size(), 1U);
  EXPECT_NE(set.warnings[0].find("5000 m from the domain's minimum"), std::string::npos) << set.warnings[0];
}

TEST(Particles, ReportsEmptyFills) {
  const ParticleSet set =
      particles(with(R"("domain": {}, "fill": [{"box": {}}, {"box": {"max": [1, 0.04, 1]}}, {"sphere": {"radius": 0.02}}, {"box": {}}])"));
  ASSERT_EQ(set.warnings.size(), 4U);
  EXPECT_EQ(set.warnings[0], "dam: fill[1]: yields no particles: it is too thin for a spacing of 0.1 m");
  EXPECT_EQ(set.warnings[1], "dam: fill[2]: yields no particles: it is too thin for a spacing of 0.1 m");
  EXPECT_EQ(set.warnings[2], "dam: fill[3]: 1,000 of 1,000 particles are closer than 0.9 spacings to earlier fills, and are left out");
  EXPECT_EQ(set.warnings[3], "dam: fill[3]: yields no particles: all are left out");
}

TEST(Particles, FailsIfFillsYieldNoParticle) {
  Scene empty = scene(with(R"("domain": {})"));
  const auto none = makeParticles(empty, kMany);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->positions.empty() && none->warnings.empty());
  Scene outside = scene(with(R"("domain": {}, "fill": [{"box": {"min": [2, 2, 2], "max": [3, 3, 3]}}])"));
  const auto rejected = makeParticles(outside, kMany);
  ASSERT_FALSE(rejected);
  EXPECT_EQ(rejected.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(rejected.error().message.rfind(
                "dam: fill: no particles are left (1,000 outside the walls, 0 inside solids); expected at least one.", 0),
            0U)
      << rejected.error().message;
}

TEST(Particles, RejectsTooManyParticlesBeforeAllocation) {
  const auto message = [](const std::string& spacing, const std::string& fill, uint64_t most) {
    Scene s = scene(withSpacing(spacing, "\"fill\": [" + fill + "]"));
    const auto result = makeParticles(s, most);
    return result ? "made " + std::to_string(result->positions.size()) : result.error().message;
  };
  EXPECT_EQ(
      message("0.002", R"({"box": {"max": [1, 0.8, 0.5]}})", 33'554'432),
      "dam: fluid.spacing: 0.002 m makes 50,000,000 particles; expected at most 33,554,432, which a spacing of about 0.002307 m gives");
  EXPECT_EQ(message("0.1", R"({"box": {"max": [1, 1, 1]}})", 999)
                .rfind("dam: fluid.spacing: 0.1 m makes 1,000 particles; expected at most 999", 0),
            0U);
  EXPECT_EQ(message("0.1", R"({"box": {"max": [1, 1, 1]}})", 1000), "made 1000");
  EXPECT_EQ(
      message("1e-7", R"({"box": {"max": [1e6, 1e6, 1e6]}})", kMany).rfind("dam: fluid.spacing: 1e-07 m makes about 1e+39 particles", 0),
      0U);
  EXPECT_EQ(
      message("1e-7", R"({"sphere": {"radius": 1e6}})", kMany).rfind("dam: fluid.spacing: 1e-07 m makes about 4.189e+39 particles", 0), 0U);
  EXPECT_NE(message("0.0004", R"({"box": {"max": [1, 1, 1]}})", ~0ULL).find("expected at most 4,294,967,295"), std::string::npos);
  Scene asked = scene(with(R"("fill": [{"box": {}}])"), {{"fluid.particles", "50000000"}});
  EXPECT_EQ(makeParticles(asked, 1'000'000).error().message, "dam: fluid.particles: found 50,000,000, expected at most 1,000,000");
}

TEST(Particles, ComputesSpacingFromParticleCount) {
  const std::string fills[] = {R"({"box": {"max": [1, 1, 1]}})", R"({"box": {"max": [0.6, 0.45, 0.375]}})",
                               R"({"sphere": {"radius": 0.3}})",
                               R"({"box": {"max": [2, 0.1, 1]}}, {"sphere": {"center": [1, 1, 0.5], "radius": 0.2}})"};
  for (const std::string& fill : fills) {
    for (const double wanted : {8000.0, 30000.0, 200000.0}) {
      Scene s =
          scene(R"({"rill": "0.1", "fluid": {"particles": )" + std::to_string(static_cast<int>(wanted)) + R"(}, "fill": [)" + fill + "]}");
      const ParticleSet set = particles(s);
      EXPECT_NEAR(static_cast<double>(set.positions.size()) / wanted, 1, 0.05) << fill;
      EXPECT_GT(set.spacing, 0);
      Scene again =
          scene(R"({"rill": "0.1", "fluid": {"particles": )" + std::to_string(static_cast<int>(wanted)) + R"(}, "fill": [)" + fill + "]}");
      const ParticleSet same = particles(again);
      EXPECT_EQ(same.positions, set.positions);
      EXPECT_EQ(same.spacing, set.spacing);
    }
  }
  Scene cube = scene(R"({"rill": "0.1", "fluid": {"particles": 8000}, "fill": [{"box": {}}]})");
  const ParticleSet ofCube = particles(cube);
  EXPECT_EQ(ofCube.positions.size(), 8000U);
  EXPECT_NEAR(ofCube.spacing, 0.05, 1e-12);  // the lattice that fits the box, among those with as many particles
}

TEST(Particles, ParticleCountExcludesLeftOutParticles) {
  Scene s = scene(
      R"({"rill": "0.1", "domain": {}, "fluid": {"particles": 20000}, "fill": [{"box": {"min": [-1, 0, 0]}}, {"box": {"max": [0.5, 1, 1]}}]})");
  EXPECT_NEAR(static_cast<double>(particles(s).positions.size()), 20000, 1000);
}

TEST(Particles, WarnsIfParticleCountIsMissed) {
  Scene s = scene(R"({"rill": "0.1", "domain": {}, "fluid": {"particles": 1000}, "fill": [{"box": {"min": [-19, 0, 0]}}]})");
  const ParticleSet set = particles(s);
  ASSERT_EQ(set.warnings.size(), 2U);
  EXPECT_NE(set.warnings[1].find("particles instead of 1,000"), std::string::npos) << set.warnings[1];
}

TEST(Particles, ParticleCountRequiresAFill) {
  Scene s = scene(R"({"rill": "0.1", "fluid": {"particles": 100}})");
  EXPECT_EQ(
      makeParticles(s, kMany).error().message,
      "dam: fluid.particles: no fill is a box, a sphere or a mesh, so the spacing cannot be computed; expected fluid.spacing instead");
  Scene unset;
  EXPECT_EQ(makeParticles(unset, kMany).error().message, "fluid: expected exactly one of \"spacing\", \"particles\"; found none");
}

}  // namespace
}  // namespace rill::test
