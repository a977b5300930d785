// What film effects leave alone, which samples pictures share, and what moves between samples.
#include <algorithm>
#include <cmath>
#include <vector>

#include "film_fixture.hpp"
#include "rill/player.hpp"

namespace rill::offline {
namespace film_test {

TEST(FilmPicture, SimulationIsTheSameBitForBit) {
  const auto run = [](const Film& film, std::vector<uint8_t>& picture) {
    Simulation simulation = opened(dam(0.05), film, 30);
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(simulation.advance(1.0 / 60));
      const auto image = simulation.render("final", 64, 36);
      EXPECT_TRUE(image) << image.error().message;
      picture = image->rgba;
    }
    const auto stats = simulation.stats();
    EXPECT_TRUE(stats);
    const bool sums = std::ranges::any_of(
        stats->passes, [](const PassTime& pass) { return pass.name.starts_with("film") || pass.name.starts_with("motion "); });
    EXPECT_EQ(sums, film.shutter_s > 0) << "no pass where there is no effect";
    return stats->stateHash;
  };
  std::vector<uint8_t> plain, film, again;
  const Film effects{.samples = 8, .shutter_s = 1.0 / 120, .aperture = 2};
  const uint64_t hash = run({}, plain);
  EXPECT_EQ(run(effects, film), hash);
  EXPECT_EQ(run(effects, again), hash);
  EXPECT_EQ(film, again) << "the same bytes on each run";
  EXPECT_NE(film, plain);
}

TEST(FilmPicture, LinearAndShownPicturesShareTheirSamples) {
  Simulation run = opened(dam(0.05), {.samples = 4});
  const auto recorded = [&] {
    const auto stats = run.stats();
    uint32_t count = 0;
    for (const PassTime& pass : stats->passes) count += pass.name == "film add" ? pass.recorded : 0;
    return count;
  };
  ASSERT_TRUE(run.advance(0.01));
  const auto first = run.renderLinear(64, 36);
  EXPECT_EQ(recorded(), 4u);
  ASSERT_TRUE(first && run.render("final", 64, 36));
  EXPECT_EQ(recorded(), 4u);
  ASSERT_TRUE(run.render("final", 32, 18));
  EXPECT_EQ(recorded(), 8u) << "another size";
  EXPECT_EQ(run.renderLinear(64, 36)->rgba, first->rgba);
  ASSERT_TRUE(run.prepareRender("final", 32, 18));
  EXPECT_EQ(run.renderLinear(64, 36)->rgba, first->rgba) << "the sum was lost in between";
  ASSERT_TRUE(run.render("depth", 64, 36));
  ASSERT_TRUE(run.advance(0.1));
  EXPECT_NE(run.renderLinear(64, 36)->rgba, first->rgba) << "another time";
}

// What motion blur draws a moment from the present, against a simulation that was stopped there.
TEST(FilmPicture, MovedParticlesAreWhereTheSimulationTakesThem) {
  const double half = 1.0 / 240;  // of a shutter of 180 degrees at 60 frames a second
  Simulation run = opened(dam(0.03));
  ASSERT_TRUE(run.advance(0.25));
  const auto now = run.particles();
  ASSERT_TRUE(now && run.advance(half));
  const auto later = run.particles();
  ASSERT_TRUE(later);
  double moved = 0, still = 0;
  std::vector<double> errors;
  for (size_t i = 0; i < now->positions.size(); ++i) {
    const Float3 &from = now->positions[i], &to = later->positions[i];
    const auto off = [&](double seconds, const Float3& v, const Float3& a, const Float3& b) {
      return std::hypot(b.x - a.x - seconds * v.x, b.y - a.y - seconds * v.y, b.z - a.z - seconds * v.z);
    };
    // Forward from the present, and backward from there.
    for (const double error : {off(half, now->velocities[i], from, to), off(-half, later->velocities[i], to, from)}) {
      errors.push_back(error);
      moved += error * error;
      still += std::pow(off(0, {}, from, to), 2);
    }
  }
  std::ranges::sort(errors);
  const double count = double(errors.size()), spacing = 0.03;
  RecordProperty("rms, p99, unmoved rms in spacings", std::to_string(std::sqrt(moved / count) / spacing) + " " +
                                                          std::to_string(errors[size_t(0.99 * count)] / spacing) + " " +
                                                          std::to_string(std::sqrt(still / count) / spacing));
  EXPECT_LT(std::sqrt(moved / still), 0.1);
  EXPECT_LT(errors[size_t(0.99 * count)], 0.05 * spacing);
}

TEST(FilmPicture, WhitewaterMovesToo) {
  Scene scene = sceneOf(R"({"rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1.8, 1.5, 0.6], "open": ["+y"]}, "fluid": {"spacing": 0.06},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.9, 0.6]}}], "look": {"whitewater": true}})");
  Simulation run = opened(scene, {.samples = 4, .shutter_s = 0.01});
  ASSERT_TRUE(run.advance(0.7) && run.render("final", 96, 54));
  EXPECT_TRUE(run.takeValidationMessages().empty());
  const auto stats = run.stats();
  ASSERT_TRUE(stats);
  EXPECT_EQ(std::ranges::count_if(stats->passes, [](const PassTime& pass) { return pass.name == "motion whitewater"; }), 1);
}

TEST(FilmPicture, ShutterTakesThePlaceOfTheExposureOfSpray) {
  const auto picture = [](double exposure_s, const Film& film) {
    Scene scene = sceneOf(
        R"({"rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1.8, 1.5, 0.6], "open": ["+y"]}, "fluid": {"spacing": 0.06},
        "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.9, 0.6]}}], "look": {"whitewater": true}})");
    scene.look.spray_exposure = exposure_s;
    Simulation run = opened(scene, film);
    EXPECT_TRUE(run.advance(0.8));
    return run.render("final", 320, 180)->rgba;
  };
  const auto streaks = picture(0.02, {}), dots = picture(0, {});
  EXPECT_EQ(picture(0.9, {.samples = 1, .shutter_s = 0.02}), streaks);
  EXPECT_NE(streaks, dots);
  EXPECT_EQ(picture(0.02, {}), streaks) << "bitwise deterministic";
}

TEST(FilmPicture, OtherViewsAreNotAffected) {
  Simulation film = opened(dam(0.05), {.samples = 4}), plain = opened(dam(0.05));
  for (const char* view : {"particles", "depth"}) EXPECT_EQ(film.render(view, 64, 36)->rgba, plain.render(view, 64, 36)->rgba) << view;
}

TEST(FilmPicture, RejectsValuesOutOfRange) {
  for (const Film& bad : {Film{.samples = 1000}, Film{.shutter_s = -1}, Film{.aperture = 0.1}}) {
    const auto refused = Simulation::open(dam(), {.film = bad});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("Options::film."), std::string::npos) << refused.error().message;
    EXPECT_FALSE(Player::open(dam(), {.film = bad}));
  }
}

}  // namespace film_test
}  // namespace rill::offline
