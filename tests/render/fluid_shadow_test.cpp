// The fluid's shadow, blurred: against means in double precision, of random maps and of degenerate ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "render/scenery_rig.hpp"
#include "render/surface.hpp"
#include "render/surface_rig.hpp"

namespace rill::test {
namespace fluid_shadow_test {

constexpr int kBorder = surface::kShadowBorder;
constexpr float kUnit = 0.0001F;  // m per count

struct Size {
  int width = 0, height = 0;
};

/// The mean over three by three texels, those outside the map being 0, m.
std::vector<double> blurred(const std::vector<uint32_t>& counts, const Size& size) {
  const auto at = [&](size_t fluid, int x, int y) {
    const bool inside = x >= 0 && x < size.width && y >= 0 && y < size.height;
    return inside ? double{kUnit} * counts[(fluid * size_t(size.height) + size_t(y)) * size_t(size.width) + size_t(x)] : 0.0;
  };
  std::vector<double> means;
  for (size_t fluid = 0; fluid < counts.size() / size_t(size.width * size.height); ++fluid)
    for (int y = -kBorder; y < size.height + kBorder; ++y)
      for (int x = -kBorder; x < size.width + kBorder; ++x) {
        double sum = 0;
        for (const int v : {y - 1, y, y + 1})
          for (const int u : {x - 1, x, x + 1}) sum += at(fluid, u, v);
        means.push_back(sum / 9);
      }
  return means;
}

class FluidShadow : public SurfaceOnGpu {
 protected:
  void expectBlurred(const std::vector<uint32_t>& counts, const Size& size, uint32_t fluids, const std::string& what) {
    auto stage = SurfaceStage::create(device());
    ASSERT_TRUE(stage) << stage.error().message;
    if (fluids > 1) { ASSERT_TRUE(stage->setFluids(device(), std::vector<FluidBody>(fluids))); }
    const Buffer map = upload("thickness", counts);
    surface::SurfacePush light{};
    light.width = uint32_t(size.width);
    light.height = uint32_t(size.height);
    light.unit = kUnit;
    light.count = 1;
    Graph graph;
    fillTransients(graph, 1);
    const Ticket ticket = graph.readback(stage->addShadow(graph, light, graph.import("thickness", importOf(map))));
    run(graph);
    const auto found = read<float>(graph, ticket);
    const auto wanted = blurred(counts, size);
    ASSERT_EQ(found.size(), wanted.size()) << what;
    // Up to nine roundings of counts and eight of sums, and those of the unit.
    for (size_t k = 0; k < wanted.size(); ++k) ASSERT_NEAR(double{found[k]}, wanted[k], 20 * 6e-8 * wanted[k]) << what << ", texel " << k;
  }
};

TEST_F(FluidShadow, IsTheMeanOfRandomMaps) {
  std::mt19937 random(5);
  for (const Size size : {Size{37, 21}, Size{12, 12}, Size{64, 3}})
    for (const uint32_t fluids : {1u, 3u}) {
      std::vector<uint32_t> counts(size_t(size.width * size.height) * fluids);
      for (uint32_t& count : counts) count = random() % 3 == 0 ? 0 : uint32_t(random()) >> random() % 32;
      expectBlurred(counts, size, fluids, std::to_string(size.width) + " wide, " + std::to_string(fluids) + " fluids");
    }
}

TEST_F(FluidShadow, IsTheMeanOfDegenerateMaps) {
  constexpr uint32_t kMax = std::numeric_limits<uint32_t>::max();
  for (const Size size : {Size{1, 1}, Size{1, 40}, Size{40, 1}, Size{2, 2}, Size{16, 16}})
    for (const uint32_t count : {0u, 1u, kMax})
      expectBlurred(std::vector<uint32_t>(size_t(size.width * size.height), count), size, 1,
                    std::to_string(size.width) + " by " + std::to_string(size.height) + " of " + std::to_string(count));
}

class SceneWithoutParticles : public SceneryTest {};

TEST_F(SceneWithoutParticles, HasNoShadowPass) {
  Scene scene;
  scene.domain.emplace();
  draw(scene, {{0.5, 2, 3}, {0.5, 0, 0.5}, 40}, 32, 24);
  for (const std::string pass : {"fluid shadow", "fluid shadow blur"}) EXPECT_EQ(reasons_[pass], "there are no particles") << pass;
}

}  // namespace fluid_shadow_test
}  // namespace rill::test
