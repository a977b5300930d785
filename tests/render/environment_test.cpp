// Environment maps: loading, as background, and in reflections of the fluid.
#include "render/environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "render/environment_mips.hpp"
#include "render/environment_sun.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "rill/scene_io.hpp"
#include "support/gpu_test.hpp"
#include "support/half_pixels.hpp"
#include "support/temporary_folder.hpp"
#include "views/scenery.hpp"

namespace rill::test {
namespace {

using Rgb = std::array<double, 3>;

Rgb unpacked(uint32_t texel) {
  const double scale = std::ldexp(1.0, int(texel >> 27) - 24);
  return {(texel & 511) * scale, (texel >> 9 & 511) * scale, (texel >> 18 & 511) * scale};
}

/// `color` of (column, row).
EnvironmentPicture picture(uint32_t width, const std::function<Rgb(uint32_t, uint32_t)>& color) {
  EnvironmentPicture out{width, width / 2, {}};
  for (uint32_t y = 0; y < out.height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const Rgb c = color(x, y);
      out.texels.push_back(sharedExponent(float(c[0]), float(c[1]), float(c[2])));
    }
  return out;
}

/// A Radiance picture without run lengths: the same four bytes for each pixel.
std::string radiance(int width, int height, const std::string& rgbe, int pixels) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (int k = 0; k < pixels; ++k) text += rgbe;
  return text;
}

/// Big-endian, as PNG has its numbers.
std::string word(uint32_t value) { return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)}; }
/// A PNG whose pixels all have one color. Checksums are omitted, because stb_image ignores them.
std::string png(uint32_t width, uint32_t height, const std::string& rgb) {
  std::string rows;
  for (uint32_t y = 0; y < height; ++y) {
    rows += '\0';
    for (uint32_t x = 0; x < width; ++x) rows += rgb;
  }
  const auto chunk = [](const std::string& name, const std::string& data) { return word(uint32_t(data.size())) + name + data + word(0); };
  const uint16_t length = uint16_t(rows.size()), inverse = uint16_t(~length);
  const std::string stored = {'\x78', '\x01', '\x01', char(length & 255), char(length >> 8), char(inverse & 255), char(inverse >> 8)};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", word(width) + word(height) + std::string("\x08\x02\0\0\0", 5)) +
         chunk("IDAT", stored + rows + word(0)) + chunk("IEND", "");
}

TEST(SharedExponent, KeepsNineBitsAndAcceptsAnyFloat) {
  EXPECT_EQ(unpacked(sharedExponent(1, 0.5f, 0.25f)), (Rgb{1, 0.5, 0.25}));
  EXPECT_EQ(unpacked(sharedExponent(0, 0, 0)), (Rgb{0, 0, 0}));
  for (const float value : {1e-4f, 0.0311f, 0.9999f, 3.3f, 511.6f, 32767.9f}) {
    const Rgb back = unpacked(sharedExponent(value, value / 3, 0));
    EXPECT_NEAR(back[0], value, value / 500) << value;
    EXPECT_NEAR(back[1], value / 3, value / 500);
    EXPECT_EQ(back[2], 0);
  }
  const float infinite = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(unpacked(sharedExponent(infinite, none, -3)), (Rgb{32768, 0, 0}));
}

TEST(LoadEnvironment, ReadsRadianceLinearlyAndBytesAsSrgb) {
  const TemporaryFolder folder;
  const auto hdr = loadEnvironment(folder.write("a.hdr", radiance(4, 2, {'\x80', '\x40', '\x20', '\x82'}, 8)));
  ASSERT_TRUE(hdr) << hdr.error().message;
  EXPECT_EQ(hdr->width, 4u);
  EXPECT_EQ(hdr->height, 2u);
  ASSERT_EQ(hdr->texels.size(), 8u);
  for (const uint32_t texel : hdr->texels) EXPECT_EQ(unpacked(texel), (Rgb{2, 1, 0.5}));
  const auto bytes = loadEnvironment(folder.write("a.png", png(2, 1, {'\xFF', '\x80', '\0'})));
  ASSERT_TRUE(bytes) << bytes.error().message;
  ASSERT_EQ(bytes->texels.size(), 2u);
  const Rgb linear = unpacked(bytes->texels[1]);
  EXPECT_EQ(linear[0], 1);
  EXPECT_NEAR(linear[1], 0.21586, 1.0 / 512);
  EXPECT_EQ(linear[2], 0);
}

TEST(LoadEnvironment, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& content) {
    const auto file = folder.write("sky.hdr", content);
    const auto read = loadEnvironment(file);
    if (read) return std::string("taken");
    EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(read.error().message.rfind(file.string() + ": ", 0), 0u) << read.error().message;
    return read.error().message.substr(file.string().size() + 2);
  };
  EXPECT_EQ(said(""), "not an image; expected a .hdr, .png or .jpg file");
  EXPECT_EQ(said("{}"), "not an image; expected a .hdr, .png or .jpg file");
  EXPECT_EQ(said(radiance(3, 2, "abcd", 6)), "found 3x2 pixels; expected twice as wide as high, at most 8192x4096");
  EXPECT_EQ(said(radiance(16384, 8192, "abcd", 1)), "found 16384x8192 pixels; expected twice as wide as high, at most 8192x4096");
  EXPECT_EQ(said(radiance(4, 2, "abcd", 7)), "the image data is truncated");
  const std::string whole = png(64, 32, "abc");
  EXPECT_EQ(said(whole), "taken");
  EXPECT_EQ(said(whole.substr(0, whole.size() / 2)).rfind("can't be decoded: ", 0), 0u);
  EXPECT_FALSE(loadEnvironment(folder / "none.hdr"));
  EXPECT_FALSE(loadEnvironment(folder.path()));
}

double dotOf(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Double3 directionOf(double x, double y, uint32_t width) {
  const double polar = y / (width / 2) * std::numbers::pi, turn = (x / width - 0.5) * 2 * std::numbers::pi;
  return {std::sin(polar) * std::sin(turn), std::cos(polar), -std::sin(polar) * std::cos(turn)};
}

double solidAngle(uint32_t y, uint32_t width) {
  const double step = std::numbers::pi / (width / 2);
  return 2 * std::numbers::pi / width * (std::cos(y * step) - std::cos((y + 1) * step));
}

/// Irradiance of each channel on a surface with this normal.
Rgb irradianceOf(const EnvironmentPicture& map, const Double3& normal) {
  Rgb sum{};
  for (uint32_t y = 0; y < map.height; ++y)
    for (uint32_t x = 0; x < map.width; ++x) {
      const double weight = solidAngle(y, map.width) * std::max(dotOf(directionOf(x + 0.5, y + 0.5, map.width), normal), 0.0);
      const Rgb color = unpacked(map.texels[y * map.width + x]);
      for (size_t c = 0; c < 3; ++c) sum[c] += weight * color[c];
    }
  return sum;
}

/// A blue sky over gray ground, with a disc of `radius` rad towards `sun`.
EnvironmentPicture sunny(const Double3& sun, double radius, double radiance, uint32_t width = 512) {
  return picture(width, [&](uint32_t x, uint32_t y) {
    const bool disc = dotOf(directionOf(x + 0.5, y + 0.5, width), sun) > std::cos(radius);
    if (disc) return Rgb{radiance, 0.9 * radiance, 0.7 * radiance};
    return y < width / 4 ? Rgb{0.2, 0.4, 0.9} : Rgb{0.2, 0.2, 0.2};
  });
}

constexpr double kTexel = std::numbers::pi / 256;  // rad, of a map of 512 x 256
const Double3 kSuns[] = {{0, 1, 0},     {0.01, 0.99995, 0}, {0.6, 0.64, -0.48}, {0.6, 0.64, 0.48},  {-0.6, 0.8, 0},
                         {0, 0.6, 0.8}, {1e-3, 0.6, 0.8},   {-0.96, 0.28, 0},   {0.8, 0.12, 0.588}, {-0.36, 0.872, 0.331}};

TEST(EnvironmentSunTest, IsFoundWithinATexel) {
  for (const Double3& to : kSuns) {
    const double size = std::sqrt(dotOf(to, to));
    const Double3 sun = {to.x / size, to.y / size, to.z / size};
    for (const double radius : {1.5 * kTexel, 4 * kTexel}) {
      const auto found = findSun(sunny(sun, radius, 3000));
      ASSERT_TRUE(found) << sun.x << " " << sun.y << " " << sun.z;
      const double apart = std::acos(std::min(dotOf(sun, {found->direction.x, found->direction.y, found->direction.z}), 1.0));
      EXPECT_LT(apart, kTexel) << sun.x << " " << sun.y << " " << sun.z << ", radius " << radius;
      EXPECT_NEAR(double{found->radius}, radius, 0.75 * kTexel) << "texels are inside or outside";
      EXPECT_NEAR(double{found->light.y / found->light.x}, 0.9, 0.01);
      EXPECT_NEAR(double{found->light.z / found->light.x}, 0.7, 0.01);
    }
  }
}

TEST(EnvironmentSunTest, TakingItOutKeepsIrradiance) {
  for (const Double3& to : kSuns) {
    const double size = std::sqrt(dotOf(to, to));
    EnvironmentPicture map = sunny({to.x / size, to.y / size, to.z / size}, 3 * kTexel, 3000);
    const EnvironmentPicture before = map;
    const auto sun = takeSun(map);
    ASSERT_TRUE(sun);
    for (const uint32_t texel : map.texels) ASSERT_LT(unpacked(texel)[0], 0.21) << "the disc is gone";
    const Double3 direction = {sun->direction.x, sun->direction.y, sun->direction.z};
    for (const Double3& normal : {Double3{0, 1, 0}, direction, Double3{0.6, 0.8, 0}}) {
      const Rgb whole = irradianceOf(before, normal), sky = irradianceOf(map, normal);
      const double facing = std::numbers::pi * std::max(dotOf(normal, direction), 0.0);
      if (facing < 0.1) continue;  // a disc that is partly below the surface's horizon
      const double light[] = {sun->light.x, sun->light.y, sun->light.z};
      for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(sky[c] + facing * light[c], whole[c], 0.01 * whole[c]) << to.x << " " << to.y;
    }
  }
}

TEST(EnvironmentSunTest, OtherPicturesHaveNone) {
  EXPECT_FALSE(findSun(picture(64, [](uint32_t, uint32_t) { return Rgb{1, 1, 1}; })));
  EXPECT_FALSE(findSun(picture(64, [](uint32_t, uint32_t) { return Rgb{0, 0, 0}; })));
  EXPECT_FALSE(findSun(sunny({0.6, 0.64, -0.48}, 0.4, 3000))) << "a softbox";
  EXPECT_FALSE(findSun(sunny({0.6, 0.64, -0.48}, 3 * kTexel, 1))) << "clipped";
  EXPECT_FALSE(findSun(sunny({0.6, -0.64, -0.48}, 3 * kTexel, 3000))) << "below the horizon";
  EXPECT_FALSE(findSun({}));
  EXPECT_FALSE(findSun({4, 2, {1, 2, 3}}));
}

Rgb meanOf(const uint32_t* texels, uint32_t rows) {
  Rgb sum{};
  for (uint32_t y = 0; y < rows; ++y)
    for (uint32_t x = 0; x < 2 * rows; ++x) {
      const Rgb color = unpacked(texels[y * 2 * rows + x]);
      for (size_t c = 0; c < 3; ++c) sum[c] += color[c] * solidAngle(y, 2 * rows) / (4 * std::numbers::pi);
    }
  return sum;
}

// The tolerance is that of nine bits per component, of texels and of their means.
TEST(EnvironmentLevels, KeepTheMeanOfAnySize) {
  for (const uint32_t width : {2u, 4u, 12u, 64u, 146u, 500u}) {
    uint32_t state = 7;
    const auto random = [&] { return double((state = state * 1664525 + 1013904223) >> 8) / (1 << 24); };
    const EnvironmentPicture map = picture(width, [&](uint32_t, uint32_t) { return Rgb{random(), 20 * random() * random(), 0.5}; });
    const auto levels = environmentLevels(map);
    const Rgb wanted = meanOf(map.texels.data(), map.height);
    size_t first = 0;
    for (uint32_t rows = map.height;; rows /= 2) {
      ASSERT_LE(first + 2 * rows * rows, levels.size()) << width;
      const Rgb mean = meanOf(&levels[first], rows);
      for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], wanted[c], 0.004 * wanted[c] + 20.0 / 1024) << width << ", " << rows << " rows";
      first += 2 * rows * rows;
      if (rows == 1) break;
    }
    EXPECT_EQ(first, levels.size());
  }
}

TEST(EnvironmentLevels, FinestAreLeftOutWhereABufferIsTooSmall) {
  const EnvironmentPicture map = picture(16, [](uint32_t x, uint32_t y) { return Rgb{double(x), double(y), 1}; });
  const auto whole = environmentLevels(map);  // 128 + 32 + 8 + 2 texels
  ASSERT_EQ(whole.size(), 170u);
  auto levels = whole;
  EXPECT_EQ(dropFineLevels(levels, 8, 680), 8u);
  EXPECT_EQ(levels, whole);
  EXPECT_EQ(dropFineLevels(levels, 8, 679), 4u);
  EXPECT_EQ(levels, std::vector(whole.begin() + 128, whole.end()));
  EXPECT_EQ(dropFineLevels(levels, 4, 39), 1u);
  EXPECT_EQ(levels.size(), 2u);
}

TEST(SkyPicture, DayAndSunsetAreExposedAndHaveTheirSun) {
  EXPECT_FALSE(skyPicture("studio"));
  EXPECT_FALSE(skyPicture("dya"));
  for (const auto& [name, to] : {std::pair{"day", Double3{-0.36, 1.0, 0.52}}, std::pair{"sunset", Double3{-0.75, 0.16, -0.66}}}) {
    const auto sky = skyPicture(name);
    ASSERT_TRUE(sky);
    const auto sun = findSun(*sky);
    ASSERT_TRUE(sun) << name;
    const Double3 found = {sun->direction.x, sun->direction.y, sun->direction.z};
    EXPECT_LT(std::acos(std::min(dotOf(found, to) / std::sqrt(dotOf(to, to)), 1.0)), std::numbers::pi / sky->height) << name;
    const Rgb up = irradianceOf(*sky, {0, 1, 0});
    EXPECT_NEAR(0.2126 * up[0] + 0.7152 * up[1] + 0.0722 * up[2], std::numbers::pi, 0.01 * std::numbers::pi) << name;
    EXPECT_GT(unpacked(sky->texels[0])[2], unpacked(sky->texels[0])[0]) << "the zenith is blue";
  }
  const auto day = findSun(*skyPicture("day")), evening = findSun(*skyPicture("sunset"));
  EXPECT_LT(evening->light.z / evening->light.x, 0.6f * day->light.z / day->light.x) << "a low sun is red";
  // By day a surface that lies flat has three to nine times as much light from the sun as from the sky.
  const double fromSun = day->light.y * day->direction.y;
  EXPECT_GT(fromSun, 0.75);
  EXPECT_LT(fromSun, 0.9);
}

class EnvironmentOnGpu : public GpuTest {
 protected:
  static constexpr uint32_t kWidth = 160, kHeight = 120;
  static constexpr float kSpacing = 0.1f;

  void use(const EnvironmentPicture& environment) {
    auto made = FluidRenderer::create(device());
    ASSERT_TRUE(made) << made.error().message;
    renderer_ = *std::move(made);
    const auto set = renderer_->setEnvironment(environment);
    ASSERT_TRUE(set) << set.error().message;
    scenery_ = {};
  }
  /// Linear colors of the scene's surroundings with the fluid, and whether the environment was copied for it.
  std::vector<Rgb> draw(const CameraView& camera, const FluidLook& look = {}) {
    if (!scenery_) {
      auto made = Scenery::create(device(), scene_, start_, {}, implOf(*renderer_).environment.get());
      EXPECT_TRUE(made) << made.error().message;
      scenery_ = *std::move(made);
    }
    Graph graph;
    FluidState fluid;
    fluid.capacity = uint32_t(start_.positions.size());
    fluid.spacing = kSpacing;
    std::vector<Float4> positions;
    for (const Float3& p : start_.positions) positions.push_back({p.x, p.y, p.z, 0});
    Buffer position;
    if (fluid.capacity > 0) {
      position = upload("position", positions);
      fluid.position = graph.import("position", importOf(position));
    } else {
      fluid.position = fluid.velocity = {};
    }
    const FluidView view = fluidView(camera, kWidth, kHeight, kSpacing);
    const TargetFormats formats;
    SceneTargets targets{graph.create("color", {formats.color, kWidth, kHeight}), graph.create("depth", {formats.depth, kWidth, kHeight})};
    FluidRendererImpl& renderer = implOf(*renderer_);
    const BufferRef texels = renderer.environment ? renderer.environment->addTo(graph) : BufferRef{};
    targets = scenery_->addTo(graph, fluid, targets, view, look, 0, texels);
    targets = renderer.addTo(graph, fluid, targets, view, look, true, texels);
    const Ticket ticket = readbackHalves(graph, targets.color, uint64_t{kWidth} * kHeight);
    run(graph);
    copied_ = false;
    for (const PassReport& pass : graph.report()) copied_ = copied_ || pass.name == "environment upload";
    std::vector<Rgb> out;
    const auto halves = read<uint16_t>(graph, ticket);
    for (size_t k = 0; k < halves.size(); k += 4) out.push_back({halfValue(halves[k]), halfValue(halves[k + 1]), halfValue(halves[k + 2])});
    return out;
  }
  static CameraView looking(double x, double y, double z) {
    CameraView camera;
    const Double3 at = {x, y, z};
    for (int a = 0; a < 3; ++a) {
      camera.eye[a] = 0;
      camera.target[a] = at[a];
    }
    camera.fov_y_deg = 60;
    return camera;
  }

  Scene scene_ = [] {
    Scene scene;
    scene.fluid.spacing = kSpacing;
    return scene;
  }();
  ParticleSet start_;
  std::optional<FluidRenderer> renderer_;
  std::unique_ptr<Scenery> scenery_;
  bool copied_ = false;
};

TEST_F(EnvironmentOnGpu, UniformMapIsTheExactBackground) {
  use(picture(16, [](uint32_t, uint32_t) { return Rgb{0.25, 0.5, 1.5}; }));
  for (const auto& camera : {looking(0, 0, -1), looking(0.01, 1, 0), looking(0.3, -1, 1)})
    for (const Rgb& c : draw(camera)) ASSERT_EQ(c, (Rgb{0.25, 0.5, 1.5}));
  EXPECT_EQ(implOf(*renderer_).environment->above().x, 0.25f);
  EXPECT_EQ(implOf(*renderer_).environment->below().z, 1.5f);
}

// The direction of each axis shows its texels.
TEST_F(EnvironmentOnGpu, AxesMapToTheDocumentedTexels) {
  // Columns by eighths of a turn from +z over -x, -z, +x; the poles in rows of their own.
  const EnvironmentPicture compass = picture(64, [](uint32_t x, uint32_t y) {
    if (y < 8) return Rgb{4, 4, 4};
    if (y >= 24) return Rgb{8, 8, 8};
    return x < 8 || x >= 56 ? Rgb{1, 1, 0} : x < 24 ? Rgb{1, 0, 0} : x < 40 ? Rgb{0, 1, 0} : Rgb{0, 0, 1};
  });
  use(compass);
  const auto middle = [&](double x, double y, double z) { return draw(looking(x, y, z))[kHeight / 2 * kWidth + kWidth / 2]; };
  EXPECT_EQ(middle(0, 0, 1), (Rgb{1, 1, 0})) << "around the seam";
  EXPECT_EQ(middle(-1, 0, 0), (Rgb{1, 0, 0}));
  EXPECT_EQ(middle(0, 0, -1), (Rgb{0, 1, 0}));
  EXPECT_EQ(middle(1, 0, 0), (Rgb{0, 0, 1}));
  EXPECT_EQ(middle(0, 1, 1e-3), (Rgb{4, 4, 4}));
  EXPECT_EQ(middle(0, -1, 1e-3), (Rgb{8, 8, 8}));
}

// A ball in front of a map whose left half is bright reflects it on its left side only.
TEST_F(EnvironmentOnGpu, FluidReflectsIt) {
  use(picture(64, [](uint32_t x, uint32_t) { return x < 32 ? Rgb{1, 1, 1} : Rgb{0, 0, 0}; }));
  for (double z = -1; z < 1; z += kSpacing)
    for (double y = -1; y < 1; y += kSpacing)
      for (double x = -1; x < 1; x += kSpacing)
        if (x * x + y * y + z * z < 1) start_.positions.push_back({float(x), float(y), float(z - 3)});
  FluidLook mirror;
  mirror.opaque = true;
  mirror.scatter = {0, 0, 0};
  mirror.sun = 0;
  const std::vector<Rgb> drawn = draw(looking(0, 0, -1), mirror);
  double left = 0, right = 0;
  for (uint32_t y = kHeight / 2 - 10; y < kHeight / 2 + 10; ++y)
    for (uint32_t k = 10; k < 25; ++k) {
      left += drawn[y * kWidth + kWidth / 2 - k][0] / 300;
      right += drawn[y * kWidth + kWidth / 2 + k][0] / 300;
    }
  EXPECT_GT(left, 0.015) << "about what Fresnel says of water";
  EXPECT_LT(left, 0.2);
  EXPECT_LT(right, 0.1 * left);
}

// Pixels are three texels wide: noise becomes its mean.
TEST_F(EnvironmentOnGpu, IsFilteredWherePixelsAreWider) {
  uint32_t state = 1;
  use(picture(2048, [&](uint32_t, uint32_t) {
    state = state * 1664525 + 1013904223;
    const double value = state >> 31;
    return Rgb{value, value, value};
  }));
  double sum = 0, squares = 0;
  for (const Rgb& c : draw(looking(0, 0, -1))) {
    sum += c[0] / (kWidth * kHeight);
    squares += c[0] * c[0] / (kWidth * kHeight);
  }
  EXPECT_NEAR(sum, 0.5, 0.01);
  EXPECT_LT(std::sqrt(squares - sum * sum), 0.22) << "0.33 without a filter";
}

// The highlight on a mirrored ball has the normal halfway between the eye and the sun.
TEST_F(EnvironmentOnGpu, HighlightIsWhereTheSunIs) {
  // Shells, because the terraces of a lattice would tilt normals.
  for (double r = 0.95; r > 0.4; r -= kSpacing) {
    const int count = int(4 * std::numbers::pi * r * r / (kSpacing * kSpacing));
    for (int k = 0; k < count; ++k) {
      const double y = 1 - (2 * k + 1.0) / count, flat = std::sqrt(1 - y * y), turn = 2.399963 * k;
      start_.positions.push_back({float(r * flat * std::cos(turn)), float(r * y), float(r * flat * std::sin(turn) - 3)});
    }
  }
  FluidLook mirror;
  mirror.opaque = true;
  mirror.scatter = {0, 0, 0};
  mirror.highlight = 100;
  mirror.sun = 200;
  // Where a ball of radius 1, 3 m away, has the normal halfway between the eye and the sun, on a plane through its center.
  const auto wanted = [](const Double3& sun) {
    Double3 normal = {0, 0, 1};
    for (int k = 0; k < 50; ++k) {
      const Double3 eye = {-normal.x, -normal.y, 3 - normal.z};
      const double away = std::sqrt(dotOf(eye, eye));
      normal = {eye.x / away + sun.x, eye.y / away + sun.y, eye.z / away + sun.z};
      const double size = std::sqrt(dotOf(normal, normal));
      normal = {normal.x / size, normal.y / size, normal.z / size};
    }
    return std::pair{3 * normal.x / (3 - normal.z), 3 * normal.y / (3 - normal.z)};
  };
  // The center of what is brighter than the sky, of which nothing else is.
  const auto highlight = [&](const FluidLook& look) {
    const auto pixels = draw(looking(0, 0, -1), look);
    double x = 0, y = 0, sum = 0;
    for (size_t at = 0; at < pixels.size(); ++at) {
      const double light = std::max(pixels[at][0] - 0.3, 0.0);
      x += light * (double(at % kWidth) + 0.5 - kWidth / 2);
      y += light * (kHeight / 2 - double(at / kWidth) - 0.5);
      sum += light;
    }
    EXPECT_GT(sum, 10);
    return std::pair{x / sum, y / sum};
  };
  const double meters = 3 * std::tan(std::numbers::pi / 6) / (kHeight / 2);  // a pixel at the distance of the center, about
  for (const Double3& sun : {Double3{0.6, 0.64, 0.48}, Double3{-0.5, 0.5, 0.7071}}) {
    use(sunny(sun, 3 * kTexel, 3000));
    const auto [x, y] = highlight(mirror);
    EXPECT_NEAR(x * meters, wanted(sun).first, 0.1) << sun.x;
    EXPECT_NEAR(y * meters, wanted(sun).second, 0.1) << sun.x;
    EXPECT_NEAR(double{scenery_->toSun().x}, sun.x, kTexel) << "shadows";
    FluidLook set = mirror;
    const Double3 other = {-sun.x, -sun.y, sun.z};
    set.toSun = {float(other.x), float(other.y), float(other.z)};
    const auto [left, down] = highlight(set);
    EXPECT_NEAR(left * meters, wanted(other).first, 0.1) << "a host's own sun stays";
    EXPECT_NEAR(down * meters, wanted(other).second, 0.1);
  }
}

TEST_F(EnvironmentOnGpu, IsCopiedOnceIfPresent) {
  use(picture(4, [](uint32_t, uint32_t) { return Rgb{0.5, 0.5, 0.5}; }));
  const auto first = draw(looking(0, 0, -1));
  EXPECT_TRUE(copied_);
  const auto second = draw(looking(0, 0, -1));
  EXPECT_FALSE(copied_);
  EXPECT_EQ(first, second);
  auto plain = FluidRenderer::create(device());
  ASSERT_TRUE(plain);
  renderer_ = *std::move(plain);
  scenery_ = {};
  EXPECT_NE(draw(looking(0, 0, -1)), first);
  EXPECT_FALSE(copied_);
}

TEST_F(EnvironmentOnGpu, RejectsInvalidPictures) {
  auto made = FluidRenderer::create(device());
  ASSERT_TRUE(made);
  for (const EnvironmentPicture& bad : {EnvironmentPicture{}, EnvironmentPicture{4, 2, {1, 2, 3}}, EnvironmentPicture{4, 4, {}}}) {
    const auto set = made->setEnvironment(bad);
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().kind, ErrorKind::BadInput);
  }
}

}  // namespace
}  // namespace rill::test
