// Several fluids: how much of each is on a ray, and pictures of scenes with two.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "offline/painter.hpp"
#include "render/surface_rig.hpp"
#include "render/view_push.hpp"
#include "support/half_pixels.hpp"

namespace rill::test {
namespace {

TEST(FluidBodies, HaveTheAbsorptionOfTheirColor) {
  const FluidBody body = fluidBody(Double3{0.5, 1, 0});
  ASSERT_TRUE(body.absorption);
  EXPECT_NEAR(body.absorption->x, 10 * std::log(2.0), 1e-5);
  EXPECT_EQ(body.absorption->y, 0);
  EXPECT_NEAR(body.absorption->z, 92.1, 0.01) << "bounded";
  EXPECT_FALSE(fluidBody(std::nullopt).absorption) << "as the look";
  for (const float part : {body.scatter.x, body.scatter.y, body.scatter.z}) EXPECT_TRUE(part > 0 && part <= 1) << part;
}

TEST(FluidBodies, AreLeftOutWhereNoFluidHasAColor) {
  Scene scene;
  EXPECT_TRUE(fluidBodies(scene).empty());
  scene.fluids = {{.name = "water"}, {.name = "oil"}};
  EXPECT_TRUE(fluidBodies(scene).empty());
  scene.fluids[1].color = {0.9, 0.7, 0.2};
  const auto bodies = fluidBodies(scene);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_FALSE(bodies[0].absorption);
  EXPECT_TRUE(bodies[1].absorption);
}

class ThicknessOfFluids : public SurfaceOnGpu {
 protected:
  /// `concentrations`: of each particle; empty: there are none.
  std::vector<uint32_t> thickness(SurfaceStage& stage, const FluidView& view, uint32_t step, SurfaceStage::Of of,
                                  const std::vector<Float4>& concentrations = {}) {
    Graph graph;
    FluidState fluid = state(graph);
    std::optional<Buffer> mixed;
    if (!concentrations.empty()) mixed = upload("concentrations", concentrations);
    if (mixed) fluid.concentration = graph.import("concentrations", importOf(*mixed));
    const SurfacePush push = SurfaceStage::thicknessPush(viewPush(view, Double3{0, 0, 0}), fluid, step);
    const Ticket ticket = graph.readback(stage.addThickness(graph, kFluidThickness, fluid, push, {}, nullptr, of));
    run(graph);
    return read<uint32_t>(graph, ticket);
  }
  using SurfacePush = surface::SurfacePush;
};

// A particle adds to its own fluid what it adds to the thickness of all, which splat_test.cpp compares with its reference.
TEST_F(ThicknessOfFluids, IsThatOfTheirParticlesAlone) {
  constexpr uint32_t kFluids = 3;
  auto stage = SurfaceStage::create(device());
  ASSERT_TRUE(stage && stage->setFluids(device(), std::vector<FluidBody>(kFluids)));
  const FluidView eye = looking({0, 0, 0}, {0, 0, -4}, 64, 48);
  auto particles = scattered({-2, -1.5, -5}, {2, 1.5, -0.2}, 1500);
  for (size_t i = 0; i < particles.size(); ++i) particles[i].w = float(i * 7 % 5 % kFluids);
  particles[0].w = 9;  // the last, as all above it
  // Discs of less than a sample, of several, and of so many that a workgroup shares them.
  for (const auto& [view, step] : {std::pair{eye, 8u}, {eye, 1u}, {orthographic(0.08, eye), 1u}}) {
    fill(particles);
    const auto all = thickness(*stage, view, step, SurfaceStage::Of::All),
               each = thickness(*stage, view, step, SurfaceStage::Of::EachFluid);
    ASSERT_EQ(each.size(), kFluids * all.size());
    std::vector<uint32_t> sum(all.size());
    for (uint32_t f = 0; f < kFluids; ++f) {
      std::vector<Float4> own;
      for (const Float4& p : particles)
        if (std::min(uint32_t(p.w), kFluids - 1) == f) own.push_back({p.x, p.y, p.z, 0});
      fill(own);
      const auto alone = thickness(*stage, view, step, SurfaceStage::Of::All);
      ASSERT_TRUE(std::equal(alone.begin(), alone.end(), each.begin() + std::ptrdiff_t(f * all.size()))) << f << " of step " << step;
      EXPECT_GT(*std::ranges::max_element(alone), 100u);
      for (size_t i = 0; i < sum.size(); ++i) sum[i] += alone[i];
    }
    EXPECT_EQ(sum, all);
  }
}

TEST_F(ThicknessOfFluids, OfWhatHasMixedAreTheSharesOfEach) {
  constexpr uint32_t kFluids = 3;
  std::vector<FluidBody> bodies(kFluids);
  bodies[1].diffuses = true;
  auto stage = SurfaceStage::create(device());
  ASSERT_TRUE(stage && stage->setFluids(device(), bodies));
  const FluidView eye = looking({0, 0, 0}, {0, 0, -4}, 64, 48);
  auto particles = scattered({-2, -1.5, -5}, {2, 1.5, -0.2}, 500);
  for (size_t i = 0; i < particles.size(); ++i) particles[i].w = float(i % kFluids);
  std::vector<Float4> unmixed, quarter(particles.size(), Float4{0.25F, 7, 7, 7});  // components that are of no fluid do not count
  for (const Float4& p : particles) unmixed.push_back({p.w == 1 ? 1.0F : 0.0F, 0, 0, 0});
  for (const uint32_t step : {8u, 1u}) {
    fill(particles);
    const auto each = thickness(*stage, eye, step, SurfaceStage::Of::EachFluid), all = thickness(*stage, eye, step, SurfaceStage::Of::All);
    EXPECT_EQ(thickness(*stage, eye, step, SurfaceStage::Of::EachFluid, unmixed), each) << step;
    const auto mixed = thickness(*stage, eye, step, SurfaceStage::Of::EachFluid, quarter);
    ASSERT_EQ(mixed.size(), each.size());
    // A particle's part is rounded to a unit: of 500 particles those on a ray are some tens.
    constexpr double kRounding = 50;
    for (size_t i = 0; i < all.size(); ++i) {
      const double own[] = {double(each[i]), double(each[all.size() + i]), double(each[2 * all.size() + i])};
      EXPECT_NEAR(mixed[i], 0.75 * (own[0] + own[1]), kRounding) << "the first that does not diffuse is the rest of the one that does";
      EXPECT_NEAR(mixed[all.size() + i], 0.25 * all[i], kRounding);
      EXPECT_NEAR(mixed[2 * all.size() + i], 0.75 * own[2], kRounding);
    }
  }
}

/// Pictures of two fluids of a scene, whose particles are made here.
class TwoFluids : public GpuTest {
 protected:
  static constexpr uint32_t kWidth = 240, kHeight = 160;
  using Color = std::array<double, 3>;

  TwoFluids() {
    scene_.fluid.spacing = 0.02;
    scene_.domain = Domain{{0, 0, 0}, {0.8, 0.6, 0.3}};
    scene_.fluids = {{.name = "water", .color = Double3{0.15, 0.5, 0.9}}, {.name = "oil", .color = Double3{0.95, 0.7, 0.1}}};
    scene_.camera = Camera{.eye = {0.4, 0.35, 1.6}, .target = {0.4, 0.2, 0.15}, .fov_y_deg = 32};
  }

  void box(const Double3& low, const Double3& high, size_t fluid) {
    const double d = scene_.fluid.spacing;
    for (double z = low.z + 0.5 * d; z < high.z; z += d)
      for (double y = low.y + 0.5 * d; y < high.y; y += d)
        for (double x = low.x + 0.5 * d; x < high.x; x += d) {
          particles_.push_back({float(x), float(y), float(z), float(fluid)});
          start_.positions.push_back({float(x), float(y), float(z)});
        }
  }

  /// Linear light of the view final.
  std::vector<Color> picture() {
    offline::Painter painter(scene_, start_);
    const auto ready = painter.prepare(device(), "final", kWidth, kHeight);
    EXPECT_TRUE(ready) << ready.error().message;
    if (!ready) return {};
    const Buffer position = upload("position", particles_);
    std::vector<Color> first;
    for (int run = 0; run < 2; ++run) {
      Graph graph;
      FluidState state;
      state.capacity = uint32_t(particles_.size());
      state.spacing = float(scene_.fluid.spacing);
      state.position = graph.import("position", importOf(position));
      const auto tickets = painter.declare(graph, state, "final", kWidth, kHeight, 0, offline::PixelKind::Linear);
      GpuTest::run(graph);
      const auto halves = read<uint16_t>(graph, tickets.picture);
      std::vector<Color> pixels(halves.size() / 4);
      for (size_t i = 0; i < pixels.size(); ++i)
        for (size_t c = 0; c < 3; ++c) pixels[i][c] = halfValue(halves[4 * i + c]);
      EXPECT_EQ(pixels.size(), size_t{kWidth} * kHeight);
      if (run == 1) { EXPECT_TRUE(first == pixels) << "two runs differ"; }
      first = std::move(pixels);
    }
    return first;
  }

  /// Mean over a square of five pixels a side around a point of the scene.
  Color at(const std::vector<Color>& pixels, const Double3& point) const {
    const CameraView view = sceneCamera(scene_, start_, double(kWidth) / kHeight);
    const CameraBasis basis = cameraBasis(view);
    double seen[3] = {};
    for (size_t a = 0; a < 3; ++a) {
      const double to = point[a] - view.eye[a];
      seen[0] += to * basis.right[a];
      seen[1] += to * basis.up[a];
      seen[2] += to * basis.forward[a];
    }
    const double focal = 0.5 * kHeight / std::tan(0.5 * view.fov_y_deg * std::numbers::pi / 180);
    const int x = int(0.5 * kWidth + focal * seen[0] / seen[2]), y = int(0.5 * kHeight - focal * seen[1] / seen[2]);
    Color sum{};
    for (int k = 0; k < 25; ++k)
      for (size_t c = 0; c < 3; ++c) sum[c] += pixels.at(size_t(y - 2 + k / 5) * kWidth + size_t(x - 2 + k % 5))[c] / 25;
    return sum;
  }

  Scene scene_;
  ParticleSet start_;
  std::vector<Float4> particles_;
};

TEST_F(TwoFluids, LayersHaveTheirColors) {
  box({0, 0, 0}, {0.8, 0.2, 0.3}, 0);
  box({0, 0.2, 0}, {0.8, 0.4, 0.3}, 1);
  const auto pixels = picture();
  const Color lower = at(pixels, {0.4, 0.1, 0.3}), upper = at(pixels, {0.4, 0.3, 0.3});
  EXPECT_GT(lower[2], 2 * lower[0]) << "water is blue";
  EXPECT_GT(upper[0], 4 * upper[2]) << "oil is amber";
  for (FluidMaterial& fluid : scene_.fluids) fluid.color.reset();
  const Color plain = at(picture(), {0.4, 0.3, 0.3});
  EXPECT_LT(plain[0], 1.2 * plain[2]) << "without colors both are water";
}

// Water that reaches higher under one half of the oil is seen through it from above.
TEST_F(TwoFluids, InterfaceIsSeenThroughTheUpperOne) {
  scene_.camera = Camera{.eye = {0.4, 1.6, 0.5}, .target = {0.4, 0.3, 0.15}, .fov_y_deg = 32};
  box({0, 0, 0}, {0.4, 0.06, 0.3}, 0);
  box({0.4, 0, 0}, {0.8, 0.2, 0.3}, 0);
  box({0, 0.06, 0}, {0.4, 0.26, 0.3}, 1);
  box({0.4, 0.2, 0}, {0.8, 0.26, 0.3}, 1);
  const auto pixels = picture();
  const Color deep = at(pixels, {0.2, 0.26, 0.15}), shallow = at(pixels, {0.6, 0.26, 0.15});
  EXPECT_GT(deep[0] / deep[2], 4 * shallow[0] / shallow[2]);
}

// Milk under water is white in the color of the water, as far as one looks through that.
TEST_F(TwoFluids, FluidBelowIsSeenInTheLightThatTheUpperOneLetsThrough) {
  scene_.look.preset = "milk";
  scene_.fluids = {{.name = "milk"}, {.name = "water", .color = Double3{0.4, 0.8, 1}}};
  scene_.camera = Camera{.eye = {0.4, 1.6, 0.5}, .target = {0.4, 0.2, 0.15}, .fov_y_deg = 32};
  box({0, 0, 0}, {0.4, 0.1, 0.3}, 0);
  box({0.4, 0, 0}, {0.8, 0.26, 0.3}, 0);
  box({0, 0.1, 0}, {0.4, 0.3, 0.3}, 1);
  box({0.4, 0.26, 0}, {0.8, 0.3, 0.3}, 1);
  const auto pixels = picture();
  const Color deep = at(pixels, {0.2, 0.3, 0.15}), shallow = at(pixels, {0.6, 0.3, 0.15});
  EXPECT_LT(deep[0] / deep[2], 0.6 * shallow[0] / shallow[2]);
  EXPECT_GT(deep[2], 0.5 * shallow[2]) << "the milk is seen";
}

// A ball of milk in water is brighter where it faces the sun, which stands at -0.36, 1, 0.52.
TEST_F(TwoFluids, FluidInsideIsShadedByItsShape) {
  scene_.look.preset = "milk";
  scene_.fluids = {{.name = "milk"}, {.name = "water", .color = Double3{0.8, 0.95, 1}}};
  scene_.camera = Camera{.eye = {0.4, 0.2, 1.6}, .target = {0.4, 0.2, 0.15}, .fov_y_deg = 32};
  box({0, 0, 0}, {0.8, 0.4, 0.3}, 1);
  for (Float4& p : particles_)
    if (std::hypot(p.x - 0.4, p.y - 0.2, p.z - 0.15) < 0.11) p.w = 0;
  const auto pixels = picture();
  const Color above = at(pixels, {0.37, 0.26, 0.25}), middle = at(pixels, {0.4, 0.2, 0.25}), below = at(pixels, {0.43, 0.14, 0.25});
  EXPECT_GT(above[1], 1.03 * middle[1]);
  EXPECT_GT(middle[1], 1.03 * below[1]);
}

// Sunlight colors the floor by the fluid that it has come through, as a plain shadow and as caustics.
TEST_F(TwoFluids, ShadowsHaveTheirColors) {
  scene_.domain = Domain{{0, 0, 0}, {1.6, 1, 1}};
  scene_.fluids = {{.name = "red", .color = Double3{0.9, 0.02, 0.02}}, {.name = "green", .color = Double3{0.02, 0.9, 0.02}}};
  scene_.camera = Camera{.eye = {0.8, 2.6, 1.4}, .target = {0.8, 0, 0.4}, .fov_y_deg = 32};
  box({0.2, 0.4, 0.6}, {0.5, 0.5, 0.9}, 0);
  box({0.9, 0.4, 0.6}, {1.2, 0.5, 0.9}, 1);
  for (const bool caustics : {false, true}) {
    scene_.look.caustics = caustics;
    const auto pixels = picture();
    // Light falls from -0.36, 1, 0.52.
    const Color red = at(pixels, {0.35 + 0.36 * 0.45, 0, 0.75 - 0.52 * 0.45}),
                green = at(pixels, {1.05 + 0.36 * 0.45, 0, 0.75 - 0.52 * 0.45});
    EXPECT_GT(red[0], 1.4 * red[1]) << caustics;
    EXPECT_GT(green[1], 1.4 * green[0]) << caustics;
  }
}

// Light that milk scatters reaches the floor in its shadow: 0.17 of the sun's red through 10 cm. Ink as thick lets no red through.
TEST_F(TwoFluids, FluidThatScattersCastsABrighterShadow) {
  scene_.domain = Domain{{0, 0, 0}, {1.6, 1, 1}};
  scene_.fluids = {{.name = "preset"}, {.name = "water", .color = Double3{0.8, 0.95, 1}}};
  scene_.camera = Camera{.eye = {0.8, 2.6, 1.4}, .target = {0.8, 0, 0.4}, .fov_y_deg = 32};
  box({0.2, 0.4, 0.6}, {0.5, 0.5, 0.9}, 0);
  const auto inShadow = [&](const char* preset) {
    scene_.look.preset = preset;
    return at(picture(), {0.35 + 0.36 * 0.45, 0, 0.75 - 0.52 * 0.45})[0];
  };
  EXPECT_GT(inShadow("diluted_milk"), 1.1 * inShadow("ink"));
}

}  // namespace
}  // namespace rill::test
