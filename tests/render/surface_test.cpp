// The fluid's surface on a driver, against the analytic shape that its particles fill.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

#include "render/fluid_renderer_impl.hpp"
#include "render/scenery.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace {

constexpr float kSpacing = 0.1f;
constexpr double kDegree = std::numbers::pi / 180;

struct Vector {
  double x = 0, y = 0, z = 0;
};
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(Vector a, double k) { return {a.x * k, a.y * k, a.z * k}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Pixel {
  float depth = 0;  ///< m; infinite: no fluid
  Vector normal;    ///< in view space: x right, y up, z away from the eye
};

class SurfaceOnGpu : public GpuTest {
 protected:
  static constexpr uint32_t kWidth = 320, kHeight = 240;

  /// Looks along -z from the origin.
  static FluidView perspective(double focus = 4) {
    CameraView camera;
    camera.eye[0] = camera.eye[1] = camera.eye[2] = 0;
    camera.target[0] = camera.target[1] = 0;
    camera.target[2] = -focus;
    camera.fov_y_deg = 45;
    return fluidView(camera, kWidth, kHeight, kSpacing);
  }
  static FluidView orthographic(double halfHeight) {
    FluidView view = perspective();
    const float h = static_cast<float>(halfHeight), w = h * kWidth / kHeight;
    view.projection = {{{1 / w, 0, 0, 0}, {0, -1 / h, 0, 0}, {0, 0, -0.01f, 0}, {0, 0, 0, 1}}};
    return view;
  }

  void fill(const std::vector<Float4>& positions) {
    count_ = uint32_t(positions.size());
    if (count_ > 0) position_ = upload("position", positions);
  }
  FluidState state(Graph& graph) {
    FluidState fluid;
    fluid.count = count_;
    fluid.spacing = kSpacing;
    if (count_ > 0) fluid.position = graph.import("position", importOf(position_));
    return fluid;
  }
  FluidRendererImpl& renderer() {
    if (!renderer_) {
      auto made = FluidRenderer::create(device());
      EXPECT_TRUE(made) << made.error().message;
      renderer_ = std::move(*made);
    }
    return renderer_->impl();
  }

  std::vector<Pixel> surface(const FluidView& view, SurfaceMethod method = SurfaceMethod::Auto) {
    EXPECT_TRUE(FluidRenderer::check(view));
    std::vector<uint32_t> first;
    for (int run = 0; run < 2; ++run) {
      Graph graph;
      const FluidState fluid = state(graph);
      SurfaceBuffers found = renderer().surface.addTo(graph, fluid, renderer().camera(fluid, view), method, true, view.focus_m);
      const Ticket ticket = graph.readback(found.pixels);
      GpuTest::run(graph);
      auto words = read<uint32_t>(graph, ticket);
      if (run == 0)
        first = std::move(words);
      else
        EXPECT_EQ(first, words) << "two runs, two pictures";
    }
    std::vector<Pixel> pixels(first.size() / 2);
    for (size_t i = 0; i < pixels.size(); ++i) {
      std::memcpy(&pixels[i].depth, &first[2 * i], 4);
      const auto n = unpackNormal(first[2 * i + 1]);
      pixels[i].normal = {n[0], n[1], n[2]};
    }
    return pixels;
  }

  /// Particles of a lattice, jittered.
  std::vector<Float4> block(Vector low, Vector high, double jitter = 0.2) {
    std::uniform_real_distribution<double> wobble(-jitter * kSpacing, jitter * kSpacing);
    std::vector<Float4> out;
    for (double z = low.z + 0.5 * kSpacing; z < high.z; z += kSpacing)
      for (double y = low.y + 0.5 * kSpacing; y < high.y; y += kSpacing)
        for (double x = low.x + 0.5 * kSpacing; x < high.x; x += kSpacing)
          out.push_back({float(x + wobble(random_)), float(y + wobble(random_)), float(z + wobble(random_)), 0});
    return out;
  }
  /// Four layers under a plane, as a fluid at rest has them: half a spacing under it the first, jittered 0.25 spacings along and 0.1
  /// across.
  std::vector<Float4> under(Vector point, Vector normal, Vector u, Vector v, double extent) {
    std::uniform_real_distribution<double> along(-0.25 * kSpacing, 0.25 * kSpacing), across(-0.1 * kSpacing, 0.1 * kSpacing);
    std::vector<Float4> out;
    for (int layer = 0; layer < 4; ++layer)
      for (double a = -extent; a < extent; a += kSpacing)
        for (double b = -extent; b < extent; b += kSpacing) {
          const double p = a + along(random_), q = b + along(random_), h = -(layer + 0.5) * kSpacing + across(random_);
          out.push_back({float(point.x + p * u.x + q * v.x + h * normal.x), float(point.y + p * u.y + q * v.y + h * normal.y),
                         float(point.z + p * u.z + q * v.z + h * normal.z), 0});
        }
    return out;
  }
  /// Shells in a ball: spirals of as many particles as have the density of rest.
  std::vector<Float4> shells(Vector centre, double radius) {
    std::uniform_real_distribution<double> wobble(-0.1 * kSpacing, 0.1 * kSpacing);
    std::vector<Float4> out;
    for (double r = radius - 0.5 * kSpacing; r > 0; r -= kSpacing) {
      const int count = std::max(1, int(4 * std::numbers::pi * r * r / (kSpacing * kSpacing)));
      for (int k = 0; k < count; ++k) {
        const double z = 1 - (2 * k + 1.0) / count, angle = 2.399963 * k, s = std::sqrt(1 - z * z);
        out.push_back({float(centre.x + r * s * std::cos(angle) + wobble(random_)),
                       float(centre.y + r * s * std::sin(angle) + wobble(random_)), float(centre.z + r * z + wobble(random_)), 0});
      }
    }
    return out;
  }

  Buffer position_;
  uint32_t count_ = 0;
  std::unique_ptr<FluidRenderer> renderer_;
  std::mt19937 random_{7};
};

struct Errors {
  double degrees = 0, depth = 0;  ///< mean; rms in spacings
  double both = 0, either = 0;
  double overlap() const { return both / either; }
};

/// `truth`: depth along the pixel's direction (z of 1) and the normal, or no hit.
template <class Truth>
Errors compared(const std::vector<Pixel>& pixels, uint32_t width, uint32_t height, const Truth& truth) {
  Errors e;
  double square = 0;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const Pixel& got = pixels[y * width + x];
      Pixel wanted;
      const bool hit = truth((x + 0.5) / width * 2 - 1, 1 - (y + 0.5) / height * 2, wanted), drawn = std::isfinite(got.depth);
      e.either += hit || drawn;
      if (!hit || !drawn) continue;
      ++e.both;
      e.degrees += std::acos(std::clamp(dot(got.normal, wanted.normal), -1.0, 1.0)) / kDegree;
      square += std::pow((got.depth - wanted.depth) / kSpacing, 2);
    }
  e.degrees /= std::max(e.both, 1.0);
  e.depth = std::sqrt(square / std::max(e.both, 1.0));
  return e;
}

const double kTangent = std::tan(22.5 * kDegree), kAspect = 320.0 / 240;

TEST_F(SurfaceOnGpu, ATiltedPlaneIsAPlane) {
  const Vector normal{0.3 / std::sqrt(1.34), 0.5 / std::sqrt(1.34), 1 / std::sqrt(1.34)};  // of the fluid, in the world; z towards the eye
  const double at = -4;                                                                    // through (0, 0, at)
  const double across = std::sqrt(1 - normal.x * normal.x);
  const Vector u{across, -normal.x * normal.y / across, -normal.x * normal.z / across};  // and v = normal x u
  const Vector v{normal.y * u.z - normal.z * u.y, normal.z * u.x - normal.x * u.z, normal.x * u.y - normal.y * u.x};
  fill(under({0, 0, at}, normal, u, v, 5));
  const std::pair<SurfaceMethod, double> methods[] = {
      {SurfaceMethod::Planes, 2}, {SurfaceMethod::CurvatureFlow, 2}, {SurfaceMethod::NarrowRange, 2}};
  for (const auto& [method, degrees] : methods) {
    const Errors e = compared(surface(perspective(), method), kWidth, kHeight, [&](double x, double y, Pixel& wanted) {
      const Vector ray{x * kTangent * kAspect, y * kTangent, -1};
      wanted.depth = float(dot({0, 0, at}, normal) / dot(ray, normal));
      wanted.normal = {normal.x, normal.y, -normal.z};
      return true;
    });
    EXPECT_LT(e.degrees, degrees) << int(method);
    EXPECT_LT(e.depth, 0.15) << int(method);
    EXPECT_GT(e.overlap(), 0.99) << int(method);
  }
}

TEST_F(SurfaceOnGpu, ABallIsABallInEitherProjection) {
  const Vector centre{0.2, -0.1, -5};
  const double radius = 1;
  fill(shells(centre, radius));
  const auto hit = [&](Vector from, Vector ray, Pixel& wanted) {
    const Vector d = centre - from;
    const double a = dot(ray, ray), b = dot(d, ray), c = dot(d, d) - radius * radius, under = b * b - a * c;
    if (under <= 0) return false;
    const double t = (b - std::sqrt(under)) / a;
    const Vector n = (from - centre) * (1 / radius), along = ray * (t / radius);
    wanted.depth = float(t);
    wanted.normal = {n.x + along.x, n.y + along.y, -(n.z + along.z)};
    return true;
  };
  const Errors e = compared(surface(perspective(5)), kWidth, kHeight, [&](double x, double y, Pixel& wanted) {
    return hit({0, 0, 0}, {x * kTangent * kAspect, y * kTangent, -1}, wanted);
  });
  EXPECT_LT(e.degrees, 6);
  EXPECT_LT(e.depth, 0.4);
  EXPECT_GT(e.overlap(), 0.95);
  const double half = 1.6;
  const Errors o = compared(surface(orthographic(half)), kWidth, kHeight, [&](double x, double y, Pixel& wanted) {
    return hit({x * half * kAspect, y * half, 0}, {0, 0, -1}, wanted);
  });
  EXPECT_LT(o.degrees, 6);
  EXPECT_LT(o.depth, 0.4);
  EXPECT_GT(o.overlap(), 0.95);
}

TEST_F(SurfaceOnGpu, AnyDepthConventionSeesTheSame) {
  fill(block({-1, -1, -5}, {1, 1, -4}));
  const FluidView reversed = perspective();
  const auto wanted = surface(reversed);
  const float near = 0.1f, far = 40;
  FluidView standard = reversed, finite = reversed;
  standard.projection.column[2] = {0, 0, far / (near - far), -1};
  standard.projection.column[3] = {0, 0, near * far / (near - far), 0};
  finite.projection.column[2] = {0, 0, near / (far - near), -1};
  finite.projection.column[3] = {0, 0, near * far / (far - near), 0};
  for (FluidView* view : {&standard, &finite}) {
    const auto got = surface(*view);
    size_t others = 0;
    for (size_t i = 0; i < got.size(); ++i)
      others += std::isfinite(got[i].depth) != std::isfinite(wanted[i].depth) ||
                (std::isfinite(got[i].depth) && std::abs(got[i].depth - wanted[i].depth) > 1e-3);
    EXPECT_LT(others, got.size() / 1000);
  }
}

TEST_F(SurfaceOnGpu, AMetreOfFluidMeasuresAMetre) {
  fill(block({-3, -3, -5}, {3, 3, -4}, 0));  // ten layers
  for (const uint32_t step : {4u, 16u}) {    // discs of many samples, and of less than one
    Graph graph;
    const FluidState fluid = state(graph);
    const auto push = SurfaceStage::thicknessPush(renderer().camera(fluid, orthographic(1)), fluid, step);
    const Ticket ticket = graph.readback(renderer().surface.addThickness(graph, fluid, push, {}));
    run(graph);
    const auto counts = read<uint32_t>(graph, ticket);
    const uint32_t columns = (kWidth + step - 1) / step;
    double sum = 0, count = 0;
    for (uint32_t y = 1; y + 1 < kHeight / step; ++y)
      for (uint32_t x = 1; x + 1 < kWidth / step; ++x) {
        const double metres = double(counts[y * columns + x]) * push.unit;
        EXPECT_NEAR(metres, 1, 0.15);
        sum += metres;
        ++count;
      }
    EXPECT_NEAR(sum / count, 1, 0.01);
  }
}

TEST_F(SurfaceOnGpu, NastyCloudsAreDrawnWithoutANumberThatIsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<std::vector<Float4>> clouds = {
      {{0, 0, -4, 0}},
      {{nan, 0, -4, 0}, {0, inf, -4, 0}, {0, 0, -1e30f, 0}, {0.1f, 0, -4, 0}},
      std::vector<Float4>(100000, Float4{0, 0, -4, 0}),
      {{0, 0, -0.0999f, 0}, {0, 0, -0.1f, 0}, {0, 0, -0.19f, 0}, {0, 0, 0, 0}, {0, 0, 5, 0}},
      {{0, 0, -0.12f, 0}},  // fills the picture
      {{1e7f, 0, -4, 0}, {0, 0, -1e7f, 0}},
  };
  for (const auto& cloud : clouds) {
    fill(cloud);
    for (const SurfaceMethod method : {SurfaceMethod::Planes, SurfaceMethod::CurvatureFlow, SurfaceMethod::NarrowRange})
      for (const auto& [width, height] : {std::pair{320u, 240u}, std::pair{1u, 1u}, std::pair{4096u, 3u}}) {
        FluidView view = perspective();
        view.width = width;
        view.height = height;
        for (const Pixel& pixel : surface(view, method)) {
          ASSERT_FALSE(std::isnan(pixel.depth));
          ASSERT_GT(pixel.depth, 0);
          ASSERT_NEAR(dot(pixel.normal, pixel.normal), 1, 1e-3);
        }
      }
  }
}

TEST_F(SurfaceOnGpu, FluidAndSceneHideEachOther) {
  fill(block({-3, -3, -5}, {3, 3, -4}));
  const FluidView view = perspective();
  for (const double wall : {3.0, 6.0}) {  // before the fluid, behind it
    Graph graph;
    const TargetFormats formats;
    ImageRef colour = graph.create("colour", {formats.colour, kWidth, kHeight}),
             depth = graph.create("depth", {formats.depth, kWidth, kHeight});
    const float near = view.projection.column[3].z;
    graph.pass("wall", [&](Pass& pass) {
      VkClearValue red{}, at{};
      red.color = {{1, 0, 0, 1}};
      at.depthStencil = {float(near / wall), 0};
      colour = pass.write(colour, Use::ColourTarget, Load::Clear, red);
      depth = pass.write(depth, Use::DepthTarget, Load::Clear, at);
      return [](Commands&) {};
    });
    FluidLook look;
    look.opaque = true;
    look.scatter = {0, 0, 1};
    const FluidState fluid = state(graph);
    const SceneTargets drawn = renderer().addTo(graph, fluid, {colour, depth}, view, look, false);
    BufferRef depths = graph.create("depths", {uint64_t{kWidth} * kHeight * 4}),
              colours = graph.create("colours", {uint64_t{kWidth} * kHeight * 8});
    graph.pass("copy", [&](Pass& pass) {
      pass.read(drawn.depth, Use::CopySource);
      pass.read(drawn.colour, Use::CopySource);
      depths = pass.write(depths, Use::CopyTarget);
      colours = pass.write(colours, Use::CopyTarget);
      return [=](Commands& commands) {
        commands.copy(drawn.depth, depths);
        commands.copy(drawn.colour, colours);
      };
    });
    const Ticket depthTicket = graph.readback(depths), colourTicket = graph.readback(colours);
    run(graph);
    const auto metres = read<float>(graph, depthTicket);
    const auto halves = read<uint16_t>(graph, colourTicket);
    const size_t middle = kHeight / 2 * kWidth + kWidth / 2;
    const bool seen = wall > 5;
    EXPECT_NEAR(near / metres[middle], seen ? 4 : wall, seen ? 0.4 * kSpacing : 1e-4);
    const bool red = halves[4 * middle] == 0x3C00 && halves[4 * middle + 2] == 0;
    EXPECT_EQ(red, !seen);
  }
}

TEST_F(SurfaceOnGpu, OnlyTheViewportIsDrawnTo) {
  fill(block({-3, -3, -5}, {3, 3, -4}));
  FluidView view = perspective();
  view.x = 32;
  view.y = 16;
  view.width = 100;
  view.height = 60;
  Graph graph;
  const TargetFormats formats;
  ImageRef colour = graph.create("colour", {formats.colour, kWidth, kHeight}),
           depth = graph.create("depth", {formats.depth, kWidth, kHeight});
  graph.pass("clear", [&](Pass& pass) {
    colour = pass.write(colour, Use::ColourTarget, Load::Clear);
    depth = pass.write(depth, Use::DepthTarget, Load::Clear);
    return [](Commands&) {};
  });
  const SceneTargets drawn = renderer().addTo(graph, state(graph), {colour, depth}, view, {}, false);
  BufferRef depths = graph.create("depths", {uint64_t{kWidth} * kHeight * 4});
  graph.pass("copy", [&](Pass& pass) {
    pass.read(drawn.depth, Use::CopySource);
    depths = pass.write(depths, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(drawn.depth, depths); };
  });
  const Ticket ticket = graph.readback(depths);
  run(graph);
  const auto stored = read<float>(graph, ticket);
  int gaps = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const bool inside = x >= 32 && x < 132 && y >= 16 && y < 76;
      gaps += inside && !(stored[y * kWidth + x] > 0);
      if (!inside) { ASSERT_EQ(stored[y * kWidth + x], 0) << x << " " << y; }
    }
  EXPECT_LT(gaps, 100 * 60 / 500) << "at less than two pixels a spacing";
}

TEST_F(SurfaceOnGpu, AViewportBeyondTheTargetsIsAnError) {
  fill(block({-1, -1, -5}, {1, 1, -4}));
  Graph graph;
  const TargetFormats formats;
  const SceneTargets targets{graph.create("colour", {formats.colour, 8, 8}), graph.create("depth", {formats.depth, 8, 8})};
  (void)renderer().addTo(graph, state(graph), targets, perspective(), {}, false);
  const auto ok = graph.compile();
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().message, "the fluid's viewport of 320x240 pixels at 0, 0 does not lie within a target of 8x8");
}

// Thirty particles a pixel: a slab is whole, and one ball fills a picture that it is before.
TEST_F(SurfaceOnGpu, FarAndNearFluidIsWhole) {
  fill(block({-3, -3, -5}, {3, 3, -4}));
  FluidView tiny = perspective();
  tiny.width = 8;
  tiny.height = 6;
  for (const SurfaceMethod method : {SurfaceMethod::Planes, SurfaceMethod::CurvatureFlow, SurfaceMethod::NarrowRange})
    for (const Pixel& pixel : surface(tiny, method)) EXPECT_NEAR(pixel.depth, 4, 0.5) << int(method);
  fill({{0, 0, -0.16f, 0}});  // 0.06 before the eye, of a radius of 0.05 as it is drawn
  const auto filled = surface(perspective());
  for (uint32_t y = kHeight / 2 - 60; y < kHeight / 2 + 60; ++y)
    for (uint32_t x = kWidth / 2 - 60; x < kWidth / 2 + 60; ++x) ASSERT_TRUE(std::isfinite(filled[y * kWidth + x].depth)) << x << " " << y;
}

// Depth may begin behind the eye.
TEST_F(SurfaceOnGpu, AnOrthographicViewMaySeeBehindItsEye) {
  fill(block({-3, -3, 1}, {3, 3, 2}));
  FluidView view = orthographic(1);
  view.projection.column[2].z = -0.05f;  // -10 to 10 m
  view.projection.column[3].z = 0.5f;
  for (const Pixel& pixel : surface(view)) ASSERT_NEAR(pixel.depth, 8, 0.1);
}

TEST_F(SurfaceOnGpu, WithoutParticlesNothingRuns) {
  fill({});
  Graph graph;
  const TargetFormats formats;
  const SceneTargets targets{graph.create("colour", {formats.colour, 8, 8}), graph.create("depth", {formats.depth, 8, 8})};
  const SceneTargets after = renderer().addTo(graph, state(graph), targets, perspective(), {}, false);
  EXPECT_EQ(after.colour, targets.colour);
  EXPECT_EQ(after.depth, targets.depth);
  ASSERT_TRUE(graph.compile());
  for (const PassReport& report : graph.report()) EXPECT_EQ(report.runs, 0u) << report.name;
}

TEST(FluidViewCheck, RefusesWhatIsNoCamera) {
  FluidView view;
  view.projection.column[2] = {0, 0, 0, -1};
  view.projection.column[3] = {0, 0, 0.1f, 0};
  EXPECT_TRUE(FluidRenderer::check(view));
  const auto said = [](const FluidView& bad) {
    const auto ok = FluidRenderer::check(bad);
    return ok ? std::string("fine") : ok.error().message;
  };
  FluidView bad = view;
  bad.width = 0;
  EXPECT_NE(said(bad).find("1 to 8192"), std::string::npos);
  bad = view;
  bad.view.column[0].x = 2;
  EXPECT_NE(said(bad).find("not rigid"), std::string::npos);
  bad = view;
  bad.projection.column[3].w = 1;
  EXPECT_NE(said(bad).find("neither a perspective"), std::string::npos);
  bad = view;
  bad.projection.column[1].x = 0.5f;
  EXPECT_NE(said(bad).find("shears"), std::string::npos);
  bad = view;
  bad.width = bad.height = 4096;
  EXPECT_NE(said(bad).find("16777216"), std::string::npos);
  bad = view;
  bad.focus_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(said(bad).find("focus_m"), std::string::npos);
  bad = view;
  bad.projection.column[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(said(bad).find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace rill::test
