#pragma once
// Draws what stands around the fluid of a scene, without fluid.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/fluid_renderer_impl.hpp"
#include "support/gpu_test.hpp"
#include "support/half_pixels.hpp"
#include "views/scenery.hpp"

namespace rill::test {

class SceneryTest : public GpuTest {
 protected:
  /// Red of the pixels, from the upper left one, in a uniform environment of 1.
  std::vector<double> draw(const Scene& scene, const CameraView& camera, uint32_t width, uint32_t height, const FluidLook& look = {}) {
    EnvironmentPicture white{32, 16, {}};
    for (int k = 0; k < 32 * 16; ++k) white.texels.push_back(sharedExponent(1, 1, 1));
    auto renderer = FluidRenderer::create(device());
    EXPECT_TRUE(renderer) << renderer.error().message;
    const auto set = renderer->setEnvironment(white);
    EXPECT_TRUE(set) << set.error().message;
    Environment* environment = implOf(*renderer).environment.get();
    auto made = Scenery::create(device(), scene, {}, {}, environment);
    EXPECT_TRUE(made) << made.error().message;
    toSun_ = (*made)->toSun();
    Graph graph;
    FluidState fluid;
    fluid.spacing = 0.1F;
    const FluidView view = fluidView(camera, width, height, 0.1);
    const TargetFormats formats;
    SceneTargets targets{graph.create("color", {formats.color, width, height}), graph.create("depth", {formats.depth, width, height})};
    const BufferRef texels = environment->addTo(graph);
    targets = (*made)->addTo(graph, fluid, targets, view, look, 0, texels);
    targets = (*made)->addOverFluid(graph, targets, view, look, 0, {}, texels);
    const Ticket ticket = readbackHalves(graph, targets.color, uint64_t{width} * height);
    run(graph);
    std::vector<double> out;
    reasons_.clear();
    for (const PassReport& pass : graph.report()) reasons_.emplace(pass.name, pass.reason);
    const auto halves = read<uint16_t>(graph, ticket);
    for (size_t k = 0; k < halves.size(); k += 4) out.push_back(halfValue(halves[k]));
    return out;
  }

  // Of what was drawn last:
  Float3 toSun_;
  std::map<std::string, std::string> reasons_;  ///< why passes were culled or skipped, by name; empty: executed
};

}  // namespace rill::test
