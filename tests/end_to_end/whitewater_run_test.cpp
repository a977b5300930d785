// Whitewater of whole simulations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "rill/offline.hpp"

namespace rill::offline {
namespace whitewater_run_test {

Scene dam(bool whitewater, double spacing = 0.06) {
  auto scene = parseScene(R"({
    "rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1.8, 1.5, 0.6], "open": ["+y"]}, "fluid": {"spacing": )" +
                              std::to_string(spacing) + R"(},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.9, 0.6]}}], "look": {"whitewater": )" +
                              (whitewater ? "true" : "false") + "}}",
                          "dam", ".");
  EXPECT_TRUE(scene) << scene.error().message;
  return *scene;
}

Simulation opened(Expected<Simulation> made) {
  EXPECT_TRUE(made) << made.error().message;
  return *std::move(made);
}

TEST(WhitewaterRun, NothingOfItExistsWithoutTheKey) {
  Simulation plain = opened(Simulation::open(dam(false))), white = opened(Simulation::open(dam(true)));
  ASSERT_TRUE(plain.advance(0.1) && white.advance(0.1));
  const auto without = plain.stats(), with = white.stats();
  ASSERT_TRUE(without && with);
  EXPECT_EQ(without->stateHash, with->stateHash) << "the fluid does not depend on it";
  const auto passes = [](const Stats& stats) {
    return std::ranges::count_if(stats.passes, [](const PassTime& pass) { return pass.name.starts_with("whitewater"); });
  };
  EXPECT_EQ(passes(*without), 0);
  EXPECT_GT(passes(*with), 5);
  EXPECT_FALSE(without->whitewater.has_value());
  EXPECT_TRUE(plain.whitewater()->positions.empty());
  EXPECT_TRUE(plain.checkpoint()->whitewater.counts.empty());
}

TEST(WhitewaterRun, ResumesWithTheSameBits) {
  Simulation whole = opened(Simulation::open(dam(true)));
  ASSERT_TRUE(whole.advance(0.6));
  const auto taken = whole.checkpoint();
  ASSERT_TRUE(taken && whole.advance(0.2));
  const auto decoded = decodeCheckpoint(encodeCheckpoint(*taken), "dam.ckpt");
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_TRUE(decoded->whitewater == taken->whitewater);
  EXPECT_GT(taken->whitewater.place.size(), 100u);
  Simulation resumed = opened(Simulation::resume(dam(true), *decoded));
  EXPECT_TRUE(resumed.warnings().empty());
  EXPECT_EQ(resumed.whitewater()->positions.size(), taken->whitewater.place.size());
  ASSERT_TRUE(resumed.advance(0.2));
  EXPECT_TRUE(resumed.checkpoint()->whitewater == whole.checkpoint()->whitewater);
  EXPECT_TRUE(resumed.stats()->whitewater == whole.stats()->whitewater);

  Simulation late = opened(Simulation::resume(dam(true), *opened(Simulation::open(dam(false))).checkpoint()));
  ASSERT_EQ(late.warnings().size(), 1u);
  EXPECT_NE(late.warnings()[0].find("no whitewater"), std::string::npos);
}

TEST(WhitewaterRun, FiguresAreThoseOfTheParticles) {
  Simulation run = opened(Simulation::open(dam(true)));
  ASSERT_TRUE(run.advance(0.9));
  const auto stats = run.stats();
  const auto particles = run.whitewater();
  ASSERT_TRUE(stats && stats->whitewater && particles);
  const WhitewaterStats& white = *stats->whitewater;
  const auto of = [&](WhitewaterClass kind) { return uint64_t(std::ranges::count(particles->classes, kind)); };
  EXPECT_EQ(of(WhitewaterClass::Spray), white.spray);
  EXPECT_EQ(of(WhitewaterClass::Foam), white.foam);
  EXPECT_EQ(of(WhitewaterClass::Bubble), white.bubbles);
  EXPECT_EQ(white.emitted - white.dissolved, particles->classes.size());
  EXPECT_EQ(white.overflow, 0u);
  for (const uint64_t kind : {white.spray, white.foam, white.bubbles}) EXPECT_GT(kind, 20u);
  for (const Float3& p : particles->positions) { EXPECT_TRUE(p.x >= 0 && p.x <= 1.8f && p.y >= 0 && p.y < 5 && p.z >= 0 && p.z <= 0.6f); }
}

TEST(WhitewaterRun, SolidsHoldItBack) {
  Scene scene = dam(true);
  scene.solids = {Solid{.shape = BoxShape{{1.1, 0, 0.2}, {1.3, 0.3, 0.4}}},
                  Solid{.shape = SphereShape{{0.9, 0.2, 0.3}, 0.15},
                        .motion = {{.at = 0, .translate = {0, 0, 0}}, {.at = 1, .translate = {0.1, 0.3, 0.2}}}}};
  Simulation run = opened(Simulation::open(scene, Options{.validation = true}));
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(run.advance(0.15));
    const auto particles = run.whitewater();
    ASSERT_TRUE(particles);
    const double t = 0.15 * (k + 1), at[3] = {0.9 + 0.1 * t, 0.2 + 0.3 * t, 0.3 + 0.2 * t};
    for (const Float3& p : particles->positions) {
      EXPECT_FALSE(p.x > 1.1f && p.x < 1.3f && p.y > 0 && p.y < 0.3f && p.z > 0.2f && p.z < 0.4f) << k;
      EXPECT_GE(std::hypot(p.x - at[0], p.y - at[1], p.z - at[2]), 0.15 - 1e-5) << k;
    }
  }
  EXPECT_GT(run.whitewater()->positions.size(), 300u);
  EXPECT_TRUE(run.takeValidationMessages().empty());
}

TEST(WhitewaterRun, EmissionOfDamBreakIsIndependentOfFrameRate) {
  const auto emitted = [](int fps) {
    Simulation run = opened(Simulation::open(dam(true), Options{.longestFrame_s = 1}));
    for (int k = 0; k < fps; ++k) EXPECT_TRUE(run.advance(1.0 / fps));
    return double(run.stats()->whitewater->emitted);
  };
  const double middle = emitted(60);
  EXPECT_GT(middle, 1000);
  for (const int fps : {30, 120}) EXPECT_NEAR(emitted(fps), middle, 0.1 * middle) << fps;
}

TEST(WhitewaterRun, IsDrawnInTheFinalView) {
  const auto whitePixels = [](bool whitewater) {
    Simulation run = opened(Simulation::open(dam(whitewater)));
    EXPECT_TRUE(run.advance(0.7));
    const auto image = run.render("final", 160, 90);
    EXPECT_TRUE(image) << image.error().message;
    size_t white = 0;  // water is blue
    for (size_t k = 0; k < image->rgba.size(); k += 4) white += image->rgba[k] > 170 ? 1 : 0;
    return white;
  };
  EXPECT_GT(whitePixels(true), whitePixels(false) + 100);
}

TEST(WhitewaterRun, IsLitByTheSunOfTheSky) {
  const auto redOverBlue = [](const char* sky) {
    const auto draw = [&](bool whitewater) {
      Scene scene = dam(whitewater);
      scene.look.sky = sky;
      Simulation run = opened(Simulation::open(scene, Options{.validation = true}));
      EXPECT_TRUE(run.advance(0.7));
      const auto image = run.render("final", 160, 90);
      EXPECT_TRUE(image && run.takeValidationMessages().empty());
      return image->rgba;
    };
    const std::vector<uint8_t> with = draw(true), without = draw(false);
    double red = 0, blue = 1;
    for (size_t k = 0; k < with.size(); k += 4) {
      if (std::abs(with[k] - without[k]) < 20) continue;
      red += with[k];
      blue += with[k + 2];
    }
    return red / blue;
  };
  EXPECT_GT(redOverBlue("sunset"), 1.1 * redOverBlue("studio"));
}

}  // namespace whitewater_run_test
}  // namespace rill::offline
