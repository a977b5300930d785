// Sunlight through the fluid in whole pictures: caustics, and crests that shine.
#include <gtest/gtest.h>

#include <string>

#include "rill/offline.hpp"

namespace rill::offline {
namespace caustics_run_test {

struct Wanted {
  bool caustics = false;
  std::string sky = "day", look = {}, fill = R"({"box": {"min": [0, 0, 0], "max": [0.6, 0.3, 0.6]}})", more = {}, open = {};
};

/// A picture, and how many passes of caustics and of crests drew it.
struct Seen {
  std::vector<uint8_t> pixels;
  size_t passes = 0, crests = 0;
};

Seen seen(const Wanted& wanted) {
  auto scene = parseScene(R"({"rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1.2, 0.8, 0.6], "open": [)" + wanted.open +
                              R"(]}, "fluid": {"spacing": 0.05}, "fill": [)" + wanted.fill + R"(], "look": {"sky": ")" + wanted.sky +
                              R"(", "caustics": )" + (wanted.caustics ? "true" : "false") + wanted.look + "}" + wanted.more + "}",
                          "tank", ".");
  EXPECT_TRUE(scene) << scene.error().message;
  auto run = Simulation::open(*scene, Options{.validation = true});
  EXPECT_TRUE(run) << run.error().message;
  Seen out;
  for (int k = 0; k < 2; ++k) {
    const auto image = run->render("final", 160, 90);
    EXPECT_TRUE(image) << image.error().message;
    EXPECT_TRUE(k == 0 || out.pixels == image->rgba) << "two pictures of one frame differ";
    out.pixels = image->rgba;
  }
  const auto messages = run->takeValidationMessages();
  EXPECT_TRUE(messages.empty()) << messages[0];
  const auto stats = run->stats();
  EXPECT_TRUE(stats);
  for (const PassTime& pass : stats->passes) {
    out.passes += pass.name.starts_with("caustics");
    out.crests += pass.name.starts_with("fluid crest");
  }
  return out;
}

TEST(CausticsRun, NothingOfThemExistsWithoutTheKey) {
  const Seen plain = seen({}), refracted = seen({.caustics = true});
  EXPECT_EQ(plain.passes, 0u);
  EXPECT_GT(refracted.passes, 6u);
  EXPECT_NE(plain.pixels, refracted.pixels);
}

TEST(CrestsRun, NothingOfThemExistsInFluidThatDoesNotScatter) {
  for (const char* clear : {"", R"(, "preset": "pool")", R"(, "preset": "clay")"}) EXPECT_EQ(seen({.look = clear}).crests, 0u) << clear;
  for (const char* sky : {"day", "studio"}) EXPECT_EQ(seen({.sky = sky, .look = R"(, "preset": "river")"}).crests, 3u) << sky;
}

TEST(CausticsRun, FallOnSolids) {
  const std::string open = R"("-y")";  // no floor that they could fall on
  const std::string ball = R"(, "solids": [{"sphere": {"center": [0.9, 0.1, 0.3], "radius": 0.1}}])";
  const std::string column = R"({"box": {"min": [0.7, 0.4, 0], "max": [1.1, 0.6, 0.6]}})";
  const Seen plain = seen({.fill = column, .more = ball, .open = open}),
             refracted = seen({.caustics = true, .fill = column, .more = ball, .open = open});
  EXPECT_NE(plain.pixels, refracted.pixels);
}

TEST(CausticsRun, AreSkippedWhereNoLightComesThrough) {
  for (const Wanted& wanted : {Wanted{.look = R"(, "preset": "clay")"}, Wanted{.fill = ""}}) {
    Wanted with = wanted;
    with.caustics = true;
    const Seen plain = seen(wanted), refracted = seen(with);
    EXPECT_EQ(refracted.passes, 0u) << wanted.look;
    EXPECT_EQ(plain.pixels, refracted.pixels) << wanted.look;
  }
}

TEST(CausticsRun, HandleALowSun) { EXPECT_GT(seen({.caustics = true, .sky = "sunset"}).passes, 6u); }

}  // namespace caustics_run_test
}  // namespace rill::offline
