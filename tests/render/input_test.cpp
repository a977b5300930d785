// Invalid input of a host: the graph's compile() fails with a message that names it.
#include <cmath>
#include <limits>

#include "render/surface_rig.hpp"

namespace rill::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class RendererInput : public SurfaceOnGpu {
 protected:
  /// The error of compile() for a picture or, if `data`, for the surface as data.
  std::string compileError(const FluidState& fluid, const FluidView& view, const FluidLook& look = {}, bool data = false) {
    auto renderer = FluidRenderer::create(device());
    if (!renderer) return renderer.error().message;
    Graph graph;
    SceneTargets targets{graph.create("color", ImageDesc{VK_FORMAT_R16G16B16A16_SFLOAT, 64, 48}),
                         graph.create("depth", ImageDesc{VK_FORMAT_D32_SFLOAT, 64, 48})};
    FluidState own = fluid;
    if (own.position.index == 0) own.position = graph.import("positions", {reinterpret_cast<VkBuffer>(uintptr_t{16}), 0, 160});
    if (data)
      (void)graph.readback(renderer->addData(graph, own, view, what_, 1, look.surface));
    else
      targets = renderer->addTo(graph, own, targets, view, look);
    const auto compiled = graph.compile();
    if (compiled) return "compiled";
    EXPECT_EQ(compiled.error().kind, ErrorKind::BadInput);
    return compiled.error().message;
  }
  /// A state whose positions compileError() imports.
  static FluidState state() {
    FluidState fluid;
    fluid.capacity = 10;
    fluid.spacing = 0.1f;
    fluid.position = BufferRef{{0, 0, 0}};
    return fluid;
  }
  SurfaceData what_ = SurfaceData::Normals;
};

TEST_F(RendererInput, RejectsInvalidFormats) {
  const struct {
    TargetFormats formats;
    const char* named;
  } cases[] = {{{VK_FORMAT_UNDEFINED, VK_FORMAT_D32_SFLOAT}, "TargetFormats::color is 0;"},
               {{VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT}, "TargetFormats::color is 126;"},
               {{VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_UNDEFINED}, "TargetFormats::depth is 0;"},
               {{VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}, "TargetFormats::depth is 37;"},
               {{VK_FORMAT_R8G8B8A8_UNORM, VkFormat(123456)}, "TargetFormats::depth is 123456;"}};
  for (const auto& c : cases) {
    const auto made = FluidRenderer::create(device(), c.formats);
    ASSERT_FALSE(made) << c.named;
    EXPECT_EQ(made.error().kind, ErrorKind::BadInput);
    EXPECT_TRUE(made.error().message.starts_with(c.named)) << made.error().message;
  }
}

TEST_F(RendererInput, RejectsInvalidViews) {
  const FluidView good = looking({0, 0, 0}, {0, 0, -4}, 64, 48);
  FluidView empty = good, huge = good, skewed = good, none = good;
  empty.width = 0;
  huge.height = 100'000;
  skewed.view.column[0].y = kNan;
  none.projection.column[0].x = 0;
  for (const FluidView* view : {&empty, &huge, &skewed, &none}) {
    const auto checked = FluidRenderer::check(*view);
    ASSERT_FALSE(checked);
    for (const bool data : {false, true}) EXPECT_EQ(compileError(state(), *view, {}, data), checked.error().message);
  }
}

TEST_F(RendererInput, RejectsInvalidStates) {
  const FluidView view = looking({0, 0, 0}, {0, 0, -4}, 64, 48);
  FluidState bad = state();
  bad.position = {};
  EXPECT_NE(compileError(bad, view).find("an empty ref"), std::string::npos) << compileError(bad, view);
  EXPECT_NE(compileError(bad, view, {}, true).find("an empty ref"), std::string::npos);
  bad = state();
  bad.capacity = 11;
  EXPECT_EQ(compileError(bad, view), "FluidState::position has 160 bytes; expected 16 for each of its 11 particles");
  bad.capacity = (1u << 26) + 1;
  EXPECT_EQ(compileError(bad, view, {}, true), "FluidState::capacity is 67108865; expected at most 67108864");
  bad = state();
  bad.spacing = kNan;
  EXPECT_EQ(compileError(bad, view), "FluidState::spacing is nan; expected a length above 0 (m)");
  bad.spacing = 0.1f;
  bad.origin[2] = kNan;
  EXPECT_EQ(compileError(bad, view), "FluidState::origin is nan; expected finite numbers (m)");
}

TEST_F(RendererInput, RejectsInvalidEnumsAndLooks) {
  const FluidView view = looking({0, 0, 0}, {0, 0, -4}, 64, 48);
  FluidLook look;
  look.surface = SurfaceMethod(9);
  EXPECT_EQ(compileError(state(), view, look), "invalid SurfaceMethod value 9");
  EXPECT_EQ(compileError(state(), view, look, true), "invalid SurfaceMethod value 9");
  look = {};
  look.refractionIndex = 0.5f;
  EXPECT_EQ(compileError(state(), view, look), "FluidLook::refractionIndex is 0.5; expected 1 to 10");
  for (const float bad : {-1.0f, 1.1e6f, std::numeric_limits<float>::quiet_NaN()}) {
    look = {};
    look.scattering.y = bad;
    EXPECT_TRUE(compileError(state(), view, look).ends_with("; expected 0 to 1e6 (1/m)")) << bad;
  }
  look = {};
  look.meanCosine = -1;
  EXPECT_EQ(compileError(state(), view, look), "FluidLook::meanCosine is -1; expected -0.99 to 0.99");
  look = {};
  look.aeration = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(compileError(state(), view, look), "FluidLook::aeration is nan; expected 0 to 1");
  what_ = SurfaceData(200);
  EXPECT_EQ(compileError(state(), view, {}, true), "invalid SurfaceData value 200");
}

TEST_F(RendererInput, RejectsInvalidFluids) {
  auto renderer = FluidRenderer::create(device());
  ASSERT_TRUE(renderer);
  const auto error = [&](const std::vector<FluidBody>& fluids) {
    const auto set = renderer->setFluids(fluids);
    return set ? std::string("accepted") : set.error().message;
  };
  EXPECT_EQ(error(std::vector<FluidBody>(kMaxFluids)), "accepted");
  EXPECT_EQ(error(std::vector<FluidBody>(kMaxFluids + 1)), "found 9 fluids; expected at most 8");
  EXPECT_EQ(error({{}, {.absorption = Float3{1, -2, 3}}}), "FluidBody::absorption is -2; expected 0 to 1e6 (1/m)");
  EXPECT_EQ(error({{.absorption = Float3{kNan, 0, 0}}}), "FluidBody::absorption is nan; expected 0 to 1e6 (1/m)");
}

}  // namespace
}  // namespace rill::test
