// Environment maps as background, and in reflections of the fluid.
#include <memory>
#include <optional>

#include "render/environment_pictures.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "support/gpu_test.hpp"
#include "support/half_pixels.hpp"
#include "views/scenery.hpp"

namespace rill::test {
namespace environment_test {

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

}  // namespace environment_test
}  // namespace rill::test
