// Independent hosts built against the installed package (build_hosts.cmake): each runs without validation
// messages, and its image matches a golden image. RILL_UPDATE_GOLDEN=1 replaces the golden images: inspect
// them before committing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

#include "shared/png.hpp"
#include "support/child_process.hpp"
#include "support/picture.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

namespace fs = std::filesystem;

const fs::path kOut = fs::path(RILL_BINARY_DIR) / "embed";

/// Every call checked, synchronization too; the layer writes to standard output.
const Child::Environment kValidation{{"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"},
                                     {"VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"}};

void expectClean(const Outcome& outcome) {
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

/// `checked` by the validation layer.
Picture render(const std::string& host, bool checked) {
  const TemporaryFolder folder;
  const fs::path program = kOut / (host == "two_fluids" ? "build-hosts" : "build-embed") / host;
  EXPECT_TRUE(fs::exists(program)) << program << " was not built: is what it needs installed? (apps/setup.sh)";
  const std::string file = (folder / "out.ppm").string();
  expectClean(Child({program.string(), file}, ".", checked ? kValidation : Child::Environment{}).wait());
  return readPicture(file);
}

/// The image that a host renders. Each host runs once per process.
const Picture& pictureOf(const std::string& host, bool checked = true) {
  static std::map<std::string, Picture> pictures;
  const auto [entry, isNew] = pictures.try_emplace(host);
  if (isNew) entry->second = render(host, checked);
  return entry->second;
}

TEST(Validation, DetectsIncorrectHost) {
  const Outcome outcome = Child({(kOut / "build-hosts/careless").string()}, ".", kValidation).wait();
  EXPECT_NE(outcome.out.find("VUID-vkCmdFillBuffer-dstOffset"), std::string::npos) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("SYNC-HAZARD-WRITE-AFTER-WRITE"), std::string::npos) << outcome.out;
}

struct Case {
  const char* host;
  Distance most;  ///< another driver rounds otherwise
  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.host; }
};

class Host : public ::testing::TestWithParam<Case> {};

TEST_P(Host, RunsCleanAndMatchesGolden) {
  const Picture& picture = pictureOf(GetParam().host);
  ASSERT_FALSE(picture.rgb.empty());
  const fs::path golden = fs::path(RILL_SOURCE_DIR) / "assets/golden" / ("embed-" + std::string(GetParam().host) + ".png");
  if (std::getenv("RILL_UPDATE_GOLDEN")) {
    std::vector<uint8_t> rgba;
    for (size_t k = 0; k < picture.rgb.size(); k += 3)
      rgba.insert(rgba.end(), {picture.rgb[k], picture.rgb[k + 1], picture.rgb[k + 2], 255});
    ASSERT_TRUE(apps::writePng(golden, {picture.width, picture.height, rgba}));
  }
  const Distance apart = distance(picture, readPicture(golden));
  EXPECT_LE(apart.mean, GetParam().most.mean);
  EXPECT_LE(apart.worst, GetParam().most.worst);
}

INSTANTIATE_TEST_SUITE_P(Pictures, Host,
                         ::testing::Values(Case{"water", {0.02, 0.3}}, Case{"between", {0.02, 0.3}}, Case{"positions", {0.02, 0.3}},
                                           Case{"particles", {0.01, 0.1}}, Case{"blur", {0.002, 0.01}}, Case{"two_fluids", {0.02, 0.3}}),
                         [](const auto& one) { return std::string(one.param.host); });

/// The water example with volk, with the shared library, and without exceptions and RTTI renders identical pixels by the same calls.
TEST(SameGame, RendersIdenticalPixels) {
  const Picture& usual = pictureOf("water");
  ASSERT_FALSE(usual.rgb.empty());
  for (const char* way : {"water_volk", "water_shared", "water_plain"}) EXPECT_TRUE(usual.rgb == pictureOf(way, false).rgb) << way;
}

/// What crates.cpp prints of a crate.
struct Floating {
  double ratio = 0, draught = 0, tilt_deg = 0, speed = 0, rise_m = 0;
};

TEST(Crates, FloatAtTheirDraught) {
  const TemporaryFolder folder;
  const fs::path program = kOut / "build-embed/crates";
  ASSERT_TRUE(fs::exists(program)) << program << " was not built: is what it needs installed? (apps/setup.sh)";
  const std::string file = (folder / "out.ppm").string();
  const Outcome outcome = Child({program.string(), file}, ".", kValidation).wait();
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::istringstream text(outcome.out);
  std::vector<Floating> crates;
  for (std::string line; std::getline(text, line);) {
    Floating c;
    ASSERT_EQ(std::sscanf(line.c_str(), "density %lf: draught %lf of its height, tilt %lf degrees, %lf m/s, rise %lf m", &c.ratio,
                          &c.draught, &c.tilt_deg, &c.speed, &c.rise_m),
              5)
        << "not a validation message, but: " << line;
    crates.push_back(c);
  }
  ASSERT_EQ(crates.size(), 5u);
  for (const Floating& c : crates) {
    SCOPED_TRACE(c.ratio);
    EXPECT_NEAR(c.draught, std::min(c.ratio, 1.0), 0.125) << "half a spacing";
    const double face_deg = c.ratio > 1 ? 90 * std::round(c.tilt_deg / 90) : 0;  // one that bounces off the floor may roll over
    EXPECT_LT(std::abs(c.tilt_deg - face_deg), 10);
    EXPECT_LT(c.speed, c.ratio > 1 ? 0.02 : 0.3) << "waves move what floats, not what lies on the floor";
    EXPECT_LT(c.rise_m, 0.15) << "0.06 for the lightest, 0.31 without the added mass";
  }
  // The picture has crates and water: about 10,000 of 129,600 pixels.
  const Picture picture = readPicture(file);
  ASSERT_EQ(picture.rgb.size(), 3u * 480 * 270);
  size_t wood = 0, water = 0;
  for (size_t k = 0; k < picture.rgb.size(); k += 3) {
    const int r = picture.rgb[k], g = picture.rgb[k + 1], b = picture.rgb[k + 2];
    wood += r > g + 30 && g > b + 20;
    water += b > r + 40;  // the sky is grayer
  }
  EXPECT_GT(wood, 2000u);
  EXPECT_GT(water, 8000u);
}

TEST(WaterBetween, OccludesLaterDrawsByDepth) {
  const Picture& picture = pictureOf("between");
  ASSERT_FALSE(picture.rgb.empty());
  // The bar lies along x through the whole tank. The water at the left hides it, the air at the right does not.
  uint32_t left = 0, right = 0;
  for (uint32_t y = 0; y < picture.height; ++y)
    for (uint32_t x = 0; x < picture.width; ++x) {
      const uint8_t* rgb = &picture.rgb[3 * (size_t{y} * picture.width + x)];
      if (rgb[0] > 120 && rgb[1] < 80 && rgb[2] < 80) ++(x < picture.width / 3 ? left : right);
    }
  EXPECT_EQ(left, 0u);
  EXPECT_GT(right, 100u);
}

TEST(Blur, MatchesReferenceBlur) {
  const Picture& picture = pictureOf("blur");
  ASSERT_EQ(picture.rgb.size(), 3u * 96 * 64);
  const auto painted = [](int x, int y, int c) {
    x = std::clamp(x, 0, 95), y = std::clamp(y, 0, 63);
    const int light[] = {240, 200, 90}, dark[] = {2 * x, 3 * y, 90};
    return (x / 8 + y / 8) % 2 != 0 ? light[c] : dark[c];
  };
  const auto across = [&](int x, int y, int c) { return (painted(x - 1, y, c) + 2 * painted(x, y, c) + painted(x + 1, y, c)) / 4.0; };
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x)
      for (int c = 0; c < 3; ++c) {
        const double expected = (across(x, std::max(y - 1, 0), c) + 2 * across(x, y, c) + across(x, std::min(y + 1, 63), c)) / 4;
        ASSERT_NEAR(picture.rgb[size_t(3 * (96 * y + x) + c)], expected, 1.1) << x << ", " << y;
      }
}

TEST(Package, ProvidesScenesAndSimulation) {
  for (const char* host : {"scenes", "scenes_shared", "scenes_pkgconfig", "researcher"}) {
    expectClean(Child({(kOut / "build-hosts" / host).string()}, ".", kValidation).wait());
  }
}

TEST(Package, InstallsToStandardLocations) {
  for (const char* file : {"include/rill/fluid.hpp", "include/rill/version.hpp", "share/rill/scenes/scene.schema.json",
                           "share/rill/scenes/dam-break.json", "share/doc/rill/LICENSE"})
    EXPECT_TRUE(fs::exists(kOut / "rill" / file)) << file;
  // The package contains no paths of the build or the first installation.
  for (const auto& entry : fs::recursive_directory_iterator(kOut / "rill")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cmake" && extension != ".pc" && extension != ".hpp") continue;
    const std::string text = contentOf(entry.path());
    EXPECT_EQ(text.find(RILL_SOURCE_DIR), std::string::npos) << entry.path();
    EXPECT_EQ(text.find((kOut / "first").string()), std::string::npos) << entry.path();
  }
}

}  // namespace
}  // namespace rill::test
