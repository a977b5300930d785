// Compares images with reviewed ones (assets/golden). RILL_UPDATE_GOLDEN=1 in the environment replaces them: review the
// new images before committing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <string_view>

#include "rill/offline.hpp"
#include "shared/png.hpp"
#include "support/child_process.hpp"
#include "support/picture.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace golden_test {

namespace fs = std::filesystem;

constexpr const char* kScene = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1.6, 0.8, 0.4]}, "fluid": {"spacing": 0.04},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.56, 0.4]}}],
  "solids": [{"sphere": {"center": [1.1, 0.12, 0.2], "radius": 0.12}}, {"box": {"min": [1.3, 0, 0.1], "max": [1.4, 0.3, 0.3]}, "rotation": [0, 0.2588, 0, 0.9659]}],
  "camera": {"eye": [2.4, 1.0, 2.0], "target": [0.75, 0.25, 0.2], "fov_y_deg": 38}
})";

struct Case {
  const char* view;
  int frame;
  Distance most;  ///< drivers round differently
  const char* set = "look.preset=water";

  bool plain() const { return std::string_view(set) == "look.preset=water"; }
  std::string look() const { return plain() ? "" : std::string(set).substr(std::string_view(set).find('=') + 1); }
  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.view << one.frame << one.look(); }
};

constexpr uint32_t kWidth = 320, kHeight = 180;

extern const std::vector<Case> kCases;

Picture withoutAlpha(const offline::Image& image) {
  Picture picture{image.width, image.height, {}};
  for (size_t k = 0; k < image.rgba.size(); k += 4) picture.rgb.insert(picture.rgb.end(), &image.rgba[k], &image.rgba[k] + 3);
  return picture;
}

/// Simulates the scene with `set` and renders all views that the cases want of it.
std::map<std::string, offline::Image> renderAll(std::string_view set) {
  std::map<std::string, offline::Image> images;
  const size_t equals = set.find('=');
  const std::vector<Override> overrides{{std::string(set.substr(0, equals)), std::string(set.substr(equals + 1))}};
  const auto scene = parseScene(kScene, "golden", ".", overrides);
  EXPECT_TRUE(scene) << scene.error().message;
  if (!scene) return images;
  auto simulation = offline::Simulation::open(*scene);
  EXPECT_TRUE(simulation) << simulation.error().message;
  int last = 0;
  for (const Case& one : kCases)
    if (one.set == set) last = std::max(last, one.frame);
  for (int frame = 0; simulation && frame <= last; ++frame) {
    const auto ok = frame > 0 ? simulation->advance(1.0 / 20) : Expected<void>();
    EXPECT_TRUE(ok) << ok.error().message;
    for (const Case& one : kCases) {
      if (one.set != set || one.frame != frame) continue;
      auto image = simulation->render(one.view, kWidth, kHeight);
      EXPECT_TRUE(image) << image.error().message;
      if (image) images[one.view + std::to_string(frame)] = *std::move(image);
    }
  }
  return images;
}

/// One simulation per setting: on some drivers compiling its pipelines takes longer than all of its images.
offline::Image imageOf(const Case& wanted) {
  static std::map<std::string, std::map<std::string, offline::Image>> bySetting;
  const auto [entry, isNew] = bySetting.try_emplace(wanted.set);
  if (isNew) entry->second = renderAll(wanted.set);
  return entry->second[wanted.view + std::to_string(wanted.frame)];
}

class GoldenTest : public ::testing::TestWithParam<Case> {};

TEST_P(GoldenTest, MatchesGoldenImage) {
  const Case& wanted = GetParam();
  const offline::Image image = imageOf(wanted);
  const fs::path golden =
      fs::path(RILL_SOURCE_DIR) / "assets/golden" /
      (std::string(wanted.view) + "-" + std::to_string(wanted.frame) + (wanted.plain() ? "" : "-" + wanted.look()) + ".png");
  if (std::getenv("RILL_UPDATE_GOLDEN")) { ASSERT_TRUE(apps::writePng(golden, image)); }
  const Picture picture = withoutAlpha(image), expected = readPicture(golden);
  ASSERT_FALSE(expected.rgb.empty()) << golden;
  const Distance apart = distance(picture, expected);
  EXPECT_LE(apart.mean, wanted.most.mean);
  EXPECT_LE(apart.worst, wanted.most.worst);
  if (!wanted.plain()) {  // clearly different from the default look
    const fs::path plain = golden.parent_path() / (std::string(wanted.view) + "-" + std::to_string(wanted.frame) + ".png");
    EXPECT_LT(2 * apart.mean, distance(picture, readPicture(plain)).mean);
  }
}

const std::vector<Case> kCases = {Case{"particles", 0, {0.005, 0.05}},
                                  Case{"particles", 6, {0.02, 0.25}},
                                  Case{"density", 0, {0.005, 0.05}},
                                  Case{"density", 6, {0.03, 0.35}},
                                  Case{"speed", 6, {0.03, 0.35}},
                                  Case{"final", 0, {0.01, 0.08}},
                                  Case{"final", 6, {0.02, 0.3}},
                                  Case{"final", 6, {0.02, 0.3}, "look.preset=milk"},
                                  Case{"final", 6, {0.02, 0.3}, "look.preset=ink"},
                                  Case{"final", 6, {0.02, 0.3}, "look.preset=clay"},
                                  Case{"normals", 0, {0.03, 0.4}, "look.surface=curvature_flow"},
                                  Case{"normals", 0, {0.03, 0.4}, "look.surface=narrow_range"},
                                  Case{"normals", 0, {0.03, 0.4}},
                                  Case{"depth", 0, {0.005, 0.05}},
                                  Case{"thickness", 6, {0.02, 0.2}}};

INSTANTIATE_TEST_SUITE_P(Views, GoldenTest, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.view) + std::to_string(one.param.frame) + one.param.look(); });

// The program writes the images that the golden ones are compared with, whatever the view and the look.
TEST(GoldenCapture, ProgramWritesSameImages) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("golden.json", kScene).string();
  for (const auto& [view, set] : {std::pair("final", "look.preset=milk"), std::pair("speed", "look.preset=water")}) {
    const Outcome outcome = capture(
        {scene, "--frames", "7", "--fps", "20", "--view", view, "--size", "320x180", "--set", set, "--out", folder.string(), "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const offline::Image image = imageOf({view, 6, {}, set});
    ASSERT_FALSE(image.rgba.empty());
    EXPECT_TRUE(readPicture(folder / "frame_00006.png").rgb == withoutAlpha(image).rgb) << view << ", " << set;
  }
}

TEST(PictureDistance, DetectsMissingShapeAndToleratesOnePixel) {
  Picture gray{40, 20, std::vector<uint8_t>(3 * 40 * 20, 128)};
  EXPECT_EQ(distance(gray, gray).worst, 0);
  Picture shape = gray, moved = gray;
  for (size_t y = 2; y < 8; ++y)
    for (size_t x = 2; x < 8; ++x)
      for (size_t c = 0; c < 3; ++c) shape.rgb[3 * (40 * y + x) + c] = moved.rgb[3 * (40 * y + x + 1) + c] = 255;
  EXPECT_GT(distance(gray, shape).worst, 0.15);
  EXPECT_EQ(distance(shape, moved).worst, 0);
  EXPECT_EQ(distance(gray, Picture{}).mean, 1);
}

}  // namespace golden_test
}  // namespace rill::test
