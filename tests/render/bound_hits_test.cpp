// Bounded loops of the surface's shaders count where they are cut short.
#include <optional>
#include <random>

#include "render/fluid_renderer_impl.hpp"
#include "support/gpu_test.hpp"
#include "views/scenery.hpp"

namespace rill::test {
namespace {

constexpr float kApart = 0.1f;

class BoundHits : public GpuTest {
 protected:
  /// Of a picture of 320x240 from the origin along -z, with its focus `focus` m away.
  uint32_t hits(const std::vector<Float4>& positions, SurfaceMethod method, double focus, SurfaceData data = SurfaceData::Normals) {
    CameraView camera;
    for (int k = 0; k < 3; ++k) camera.eye[k] = camera.target[k] = 0;
    camera.target[2] = -focus;
    camera.fov_y_deg = 45;
    if (!renderer_) {
      auto made = FluidRenderer::create(device());
      EXPECT_TRUE(made) << made.error().message;
      renderer_ = std::move(*made);
    }
    const Buffer position = upload("position", positions);
    Graph graph;
    FluidState fluid;
    fluid.capacity = uint32_t(positions.size());
    fluid.spacing = kApart;
    fluid.position = graph.import("position", importOf(position));
    (void)graph.readback(renderer_->addData(graph, fluid, fluidView(camera, 320, 240, kApart), data, 1, method));
    const Ticket counters = graph.readback(implOf(*renderer_).last.counters);
    run(graph);
    const auto words = read<uint32_t>(graph, counters);
    EXPECT_EQ(words.size(), surface::kSurfaceCounterWords);
    return words.empty() ? 0 : words[surface::kBoundHits];
  }
  /// A jittered block, its near side so far away.
  static std::vector<Float4> water(float meters) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> wobble(-0.2f * kApart, 0.2f * kApart);
    std::vector<Float4> out;
    for (int z = 0; z < 8; ++z)
      for (int y = -10; y < 10; ++y)
        for (int x = -10; x < 10; ++x)
          out.push_back(
              {float(x) * kApart + wobble(random), float(y) * kApart + wobble(random), -meters - float(z) * kApart + wobble(random), 0});
    return out;
  }
  std::optional<FluidRenderer> renderer_;
};

constexpr SurfaceMethod kMethods[] = {SurfaceMethod::Planes, SurfaceMethod::CurvatureFlow, SurfaceMethod::NarrowRange};

TEST_F(BoundHits, IsZeroInOrdinaryFluid) {
  for (const SurfaceMethod method : kMethods) EXPECT_EQ(hits(water(4), method, 4), 0u) << int(method);
}

TEST_F(BoundHits, CountsCoincidentParticles) {
  // More than kMaxInRow, fewer than kMaxInCell.
  std::vector<Float4> heap(500, Float4{0, 0, -4, 0});
  for (const SurfaceMethod method : kMethods) EXPECT_GT(hits(heap, method, 4), 0u) << int(method);
}

// Samples are as small as distant fluid needs.
TEST_F(BoundHits, CountsFluidMuchNearerThanTheFocus) {
  const std::vector<Float4> near = {{0, 0, -0.12f, 0}};
  EXPECT_GT(hits(near, SurfaceMethod::Planes, 40), 0u) << "a disc that fills the picture";
  EXPECT_GT(hits(water(2), SurfaceMethod::NarrowRange, 40), 0u) << "fewer taps than the filter reaches over";
}

}  // namespace
}  // namespace rill::test
