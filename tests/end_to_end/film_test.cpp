// Film effects in pictures, by the light in them: super-sampling, motion blur, depth of field.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "film_fixture.hpp"
#include "rill/player.hpp"
#include "support/half_pixels.hpp"

namespace rill::offline {
namespace film_test {

/// Light of a picture, rows from the top: the mean of the colors.
struct Light {
  uint32_t width = 0, height = 0;
  std::vector<double> value;
  double sum() const {
    double all = 0;
    for (const double v : value) all += v;
    return all;
  }
};

template <class Source>
Light lightOf(Source& source, uint32_t width, uint32_t height) {
  const auto image = source.renderLinear(width, height);
  EXPECT_TRUE(image) << image.error().message;
  Light light{width, height, {}};
  if (!image) return light;
  for (size_t i = 0; i < image->rgba.size(); i += 4)
    light.value.push_back((test::halfValue(image->rgba[i]) + test::halfValue(image->rgba[i + 1]) + test::halfValue(image->rgba[i + 2])) /
                          3);
  return light;
}

/// Clay in empty space before the backdrop.
std::string clay(const std::string& things, const std::string& camera) {
  return R"({"rill": "0.2", "gravity": [0, 0, 0], "fluid": {"spacing": 0.02}, "look": {"preset": "clay"}, )" + things + R"(, "camera": )" +
         camera + "}";
}

/// Variance along the rows of what `picture` has and `without` has not, square pixels.
double spread(const Light& picture, const Light& without) {
  double sum = 0, first = 0, second = 0;
  for (size_t i = 0; i < picture.value.size(); ++i) {
    const double difference = std::abs(picture.value[i] - without.value[i]), x = double(i % picture.width);
    if (difference < 2e-3) continue;  // rounding of halves
    sum += difference, first += difference * x, second += difference * x * x;
  }
  EXPECT_GT(sum, 1) << "there is nothing in the picture";
  return second / sum - first / sum * first / sum;
}

double rms(const Light& a, const Light& b) {
  double sum = 0;
  for (size_t i = 0; i < a.value.size(); ++i) sum += (a.value[i] - b.value[i]) * (a.value[i] - b.value[i]);
  return std::sqrt(sum / double(a.value.size()));
}

// Independent of the samples' pattern: pixels of a picture four times as large, averaged on the host. A solid: edges of the domain are
// lines of some pixels, and a fluid's surface depends on the picture's resolution.
TEST(FilmPicture, SuperSamplingApproachesALargerPicture) {
  constexpr uint32_t kWidth = 96, kHeight = 54, kTimes = 4;
  const Scene scene = sceneOf(clay(R"("fill": [], "solids": [{"name": "box",
    "box": {"min": [-0.1, -0.1, -0.1], "max": [0.1, 0.1, 0.1]}, "rotation": [0.2, 0.3, 0.1, 0.9]}])",
                                   R"({"eye": [0, 0.3, 1.2], "target": [0, 0, 0], "fov_y_deg": 20})"));
  const auto drawn = [&](uint32_t samples, uint32_t scale) {
    Simulation run = opened(scene, {.samples = samples});
    Light light = lightOf(run, kWidth * scale, kHeight * scale);
    EXPECT_TRUE(run.takeValidationMessages().empty());
    return light;
  };
  const Light large = drawn(1, kTimes);
  Light truth{kWidth, kHeight, std::vector<double>(kWidth * kHeight)};
  for (size_t i = 0; i < large.value.size(); ++i)
    truth.value[i / large.width / kTimes * kWidth + i % large.width / kTimes] += large.value[i] / (kTimes * kTimes);
  const Light one = drawn(1, 1), four = drawn(4, 1), many = drawn(64, 1);
  EXPECT_LT(rms(four, truth), 0.5 * rms(one, truth));
  EXPECT_LT(rms(many, truth), 0.15 * rms(one, truth));
  RecordProperty("rms of 1, 4, 64 samples",
                 std::to_string(rms(one, truth)) + " " + std::to_string(rms(four, truth)) + " " + std::to_string(rms(many, truth)));
  EXPECT_NEAR(many.sum() / one.sum(), 1, 0.01) << "light is kept";
}

constexpr const char* kFarCamera = R"({"eye": [0, 0, 40], "target": [0, 0, 0], "fov_y_deg": 1.5})";
const double kFarPixels = 128 / (80 * std::tan(0.75 * std::numbers::pi / 180));  // per m, of a picture 128 pixels high

TEST(FilmPicture, MovingBallBlursOverItsPath) {
  const double speed = 2, open = 0.2, path = speed * open * kFarPixels;
  const Scene empty = sceneOf(clay(R"("fill": [])", kFarCamera));
  const Scene ball = sceneOf(clay(R"("fill": [{"sphere": {"center": [0, 0, 0], "radius": 0.1}, "velocity": [2, 0, 0]}])", kFarCamera));
  Simulation without = opened(empty), sharp = opened(ball, {.samples = 32}), blurred = opened(ball, {.shutter_s = open});
  const Light background = lightOf(without, 256, 128), before = lightOf(sharp, 256, 128), after = lightOf(blurred, 256, 128);
  const double wider = spread(after, background) - spread(before, background);
  const double measured = std::sqrt(12 * wider / (1 - 1.0 / (kFilmSamples * kFilmSamples)));
  EXPECT_NEAR(measured, path, 0.03 * path);
  RecordProperty("blur and path in pixels", std::to_string(measured) + " " + std::to_string(path));
  RecordProperty("light with and without blur", std::to_string(after.sum()) + " " + std::to_string(before.sum()));
  EXPECT_NEAR(after.sum() - background.sum(), before.sum() - background.sum(), 0.02 * std::abs(before.sum() - background.sum()));
  const auto shown = blurred.render("final", 256, 128);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_TRUE(blurred.takeValidationMessages().empty());

  // A player blurs by the velocities that it is given.
  const auto particles = blurred.particles();
  auto player = Player::open(ball, {.film = {.shutter_s = open}});
  ASSERT_TRUE(particles && player);
  ASSERT_TRUE(player->show({.positions = particles->positions, .velocities = particles->velocities}));
  const Light played = lightOf(*player, 256, 128);
  EXPECT_NEAR(spread(played, background), spread(after, background), 0.02 * spread(after, background));
  ASSERT_TRUE(player->show({.positions = particles->positions}));
  EXPECT_NEAR(spread(lightOf(*player, 256, 128), background), spread(before, background), 0.02 * spread(before, background))
      << "without velocities it rests";
}

TEST(FilmPicture, SolidsAndBodiesBlurOverTheirPath) {
  const double path = 2 * 0.1 * kFarPixels;
  // Particles out of sight: without any there are no bodies.
  const std::string fill = R"("fill": [{"sphere": {"center": [0, 30, 0], "radius": 0.1}}], "solids": [)";
  const std::string sphere = R"({"name": "ball", "sphere": {"center": [0, 0, 0], "radius": 0.1})";
  for (const char* motion : {R"(, "body": {"density": 500, "velocity": [2, 0, 0]}}])",
                             R"(, "motion": [{"at": 0, "translate": [-1, 0, 0]}, {"at": 1, "translate": [1, 0, 0]}]}])"}) {
    const Scene moving = sceneOf(clay(fill + sphere + motion, kFarCamera));
    Simulation without = opened(sceneOf(clay(R"("fill": [])", kFarCamera)));
    const auto drawn = [&](const Film& film) {
      Simulation run = opened(moving, film);
      const bool keyframed = std::string(motion).find("motion") != std::string::npos;
      EXPECT_TRUE(run.advance(keyframed ? 0.5 : 1.0 / 60));
      return lightOf(run, 256, 128);
    };
    const Light background = lightOf(without, 256, 128);
    const double wider = spread(drawn({.shutter_s = 0.1}), background) - spread(drawn({.samples = 32}), background);
    EXPECT_GT(wider, 0) << motion;
    EXPECT_NEAR(std::sqrt(12 * wider), path, 0.04 * path) << motion;
  }
}

TEST(FilmPicture, OrbitBlursToo) {
  const Scene ball = sceneOf(clay(R"("fill": [{"sphere": {"center": [0.5, 0, 0], "radius": 0.1}}])", kFarCamera));
  Simulation without = opened(sceneOf(clay(R"("fill": [])", kFarCamera)));
  const Light background = lightOf(without, 256, 128);
  const auto width = [&](double orbit) {
    Simulation run = opened(ball, {.shutter_s = 0.1}, orbit);
    return spread(lightOf(run, 256, 128), background);
  };
  // x = 0.5 cos(angle): to and fro from the end of its path, over 1/8 of it each.
  EXPECT_GT(width(900), width(0) + 10);
}

TEST(FilmPicture, OutOfFocusBallIsBlurredByTheCircleOfConfusion) {
  constexpr uint32_t kSide = 360;
  const std::string camera = R"({"eye": [0, 0, 4], "target": [0, 0, 0], "fov_y_deg": 30})";
  const std::string fill = R"("fill": [{"sphere": {"center": [0, 0, 0], "radius": 0.06}}])";
  const auto widthOf = [&](const Film& film) {
    Simulation without = opened(sceneOf(clay(R"("fill": [])", camera)), film), run = opened(sceneOf(clay(fill, camera)), film);
    return spread(lightOf(run, kSide, kSide), lightOf(without, kSide, kSide));
  };
  const double sharp = widthOf({.samples = 64});
  EXPECT_NEAR(widthOf({.samples = 64, .aperture = 0.5}), sharp, 0.02 * sharp) << "the target is in focus";
  const double image = 0.012 / std::tan(15 * std::numbers::pi / 180);
  for (const double focus : {2.0, 16.0}) {
    const double focal = 1 / (1 / image + 1 / focus);
    const double circle = focal / 0.5 * std::abs(4 - focus) / 4 * focal / (focus - focal) / 0.024 * kSide;
    const double wider = widthOf({.samples = 64, .aperture = 0.5, .focus_m = focus}) - sharp;
    RecordProperty("circle at focus " + std::to_string(int(focus)) + ", formula, pixels",
                   std::to_string(std::sqrt(16 * wider)) + " " + std::to_string(circle));
    EXPECT_NEAR(std::sqrt(16 * wider), circle, 0.06 * circle) << focus;  // a disc's variance along an axis is its diameter squared over 16
  }
}

}  // namespace film_test
}  // namespace rill::offline
