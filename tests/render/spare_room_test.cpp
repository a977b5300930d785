// Pictures of a fluid with room for more particles than it has are those of one without.
#include <algorithm>

#include "offline/painter.hpp"
#include "rill/fluid.hpp"
#include "rill/particles.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace {

constexpr uint32_t kWidth = 160, kHeight = 120;

class SpareRoom : public GpuTest {
 protected:
  SpareRoom() {
    scene_.domain = Domain{};
    scene_.fluid.spacing = 0.05;
    BoxShape box;
    for (int a = 0; a < 3; ++a) box.min[a] = 0.2, box.max[a] = 0.6;
    scene_.fill.emplace_back().shape = box;
    // Past the fluid, towards the place of the entries without a particle.
    const Double3 eye = {-0.6, 0.2, -0.6}, target = {0.4, 0.9, 0.4};
    scene_.camera = Camera{};
    scene_.camera->eye = eye;
    scene_.camera->target = target;
  }

  std::vector<uint8_t> picture(std::string_view view, uint32_t capacity) {
    const auto start = makeParticles(scene_);
    EXPECT_TRUE(start);
    auto fluid = Fluid::create(device(), {.scene = &scene_, .particles = &*start, .capacity = capacity});
    offline::Painter painter(scene_, *start, 0);
    EXPECT_TRUE(fluid && painter.prepare(device(), view, kWidth, kHeight));
    Graph graph;
    const FluidState state = fluid->addTo(graph, {});
    const auto tickets = painter.declare(graph, state, view, kWidth, kHeight, 0);
    run(graph);
    return read<uint8_t>(graph, tickets.picture);
  }

  Scene scene_;
};

TEST_F(SpareRoom, IsNotSeen) {
  for (const std::string_view view : offline::Painter::views()) {
    SCOPED_TRACE(view);
    const auto exact = picture(view, 0), roomy = picture(view, 5000);
    ASSERT_EQ(exact.size(), size_t{kWidth} * kHeight * 4);
    EXPECT_TRUE(exact == roomy);
  }
}

}  // namespace
}  // namespace rill::test
