// The surface as data: each byte equals the surface's or the thickness's value of its pixel.
#include <cmath>

#include "render/surface_reference.hpp"

namespace rill::test {
namespace {

class SurfaceAsData : public SurfaceOnGpu {
 protected:
  std::vector<uint32_t> data(const FluidView& view, SurfaceData what, float full) {
    Graph graph;
    fillTransients(graph, 0);
    const FluidState fluid = state(graph);
    const Ticket ticket = graph.readback(renderer().addData(graph, fluid, view, what, full, SurfaceMethod::Planes));
    run(graph);
    return read<uint32_t>(graph, ticket);
  }
  static int channel(uint32_t pixel, int c) { return int(pixel >> (8 * c) & 0xFF); }
  static double byte(double v) { return std::clamp(v, 0.0, 1.0) * 255; }

  FluidView side() {
    fill(block({-0.5, -0.4, -0.5}, {0.5, 0.4, 0.5}));
    return looking({2, 1, 2.5}, {0, 0, 0}, 96, 64);
  }
};

TEST_F(SurfaceAsData, NormalsAreInWorldSpace) {
  const FluidView view = side();
  const auto pixels = surface(view);
  const auto bytes = data(view, SurfaceData::Normals, 1);
  ASSERT_EQ(bytes.size(), pixels.size());
  int there = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (!std::isfinite(pixels[i].depth)) {
      ASSERT_EQ(bytes[i], 0u) << i;
      continue;
    }
    ++there;
    ASSERT_EQ(channel(bytes[i], 3), 255);
    // The view's rows are the axes of view space in the world, whose z points back to the eye.
    const Vector& n = pixels[i].normal;
    const auto& column = view.view.column;
    const Double3 world = {n.x * double{column[0].x} + n.y * double{column[0].y} - n.z * double{column[0].z},
                           n.x * double{column[1].x} + n.y * double{column[1].y} - n.z * double{column[1].z},
                           n.x * double{column[2].x} + n.y * double{column[2].y} - n.z * double{column[2].z}};
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(channel(bytes[i], c), byte(world[c] * 0.5 + 0.5), 0.6) << i << " " << c;
  }
  EXPECT_GT(there, 500);
}

TEST_F(SurfaceAsData, DepthIsLinearGrayUpToFull) {
  const FluidView view = side();
  const auto pixels = surface(view);
  for (const float full : {5.0f, 3.0f}) {  // the second is nearer than some of it
    const auto bytes = data(view, SurfaceData::Depth, full);
    for (size_t i = 0; i < pixels.size(); ++i) {
      const bool there = std::isfinite(pixels[i].depth);
      ASSERT_EQ(channel(bytes[i], 3), there ? 255 : 0);
      for (int c = 0; c < 3 && there; ++c) ASSERT_NEAR(channel(bytes[i], c), byte(double{pixels[i].depth} / double{full}), 0.6) << i;
    }
  }
}

// A slab of known depth in meters, seen from the front.
TEST_F(SurfaceAsData, ThicknessIsInMeters) {
  fill(block({-2, -2, -4.6}, {2, 2, -4}, 0));
  const auto bytes = data(orthographic(0.5), SurfaceData::Thickness, 1);
  double sum = 0, count = 0;
  for (uint32_t y = kHeight / 4; y < kHeight * 3 / 4; ++y)
    for (uint32_t x = kWidth / 4; x < kWidth * 3 / 4; ++x) {
      const int got = channel(bytes[y * kWidth + x], 1);
      ASSERT_NEAR(got, byte(0.6), 30) << x << " " << y;  // rows of the lattice show
      sum += got;
      ++count;
    }
  EXPECT_NEAR(sum / count, byte(0.6), 2);
}

}  // namespace
}  // namespace rill::test
