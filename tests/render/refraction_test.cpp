// Refraction of solids in a flat pool: each is seen once, with even outlines.
#include <algorithm>

#include "render/flat_pool.hpp"

namespace rill::test {
namespace shading_test {

// The floor of a pool and a box on it, as a camera without fluid sees them. The box is red, the floor black.
Backdrop boxInPool(double angle, double depth, Vector half, double near_to_far) {
  constexpr double kPixel = 1.0 / 120;
  constexpr uint32_t kAcross = 160, kDown = 120;
  const Vector sight{0, -std::cos(angle), -std::sin(angle)}, up{0, std::sin(angle), -std::cos(angle)};
  Backdrop out;
  for (uint32_t y = 0; y < kDown; ++y)
    for (uint32_t x = 0; x < kAcross; ++x) {
      const Vector from = sight * -5.0 + Vector{(x + 0.5 - kAcross / 2.0) * kPixel, 0, 0} + up * ((kDown / 2.0 - y - 0.5) * kPixel);
      const double floor = (-depth - from.y) / sight.y, top = (-depth + half.y - from.y) / sight.y;
      const double front = (half.z - from.z) / sight.z, back = (-half.z - from.z) / sight.z;  // rays run towards -z
      const double enters = std::max(top, front), leaves = std::min(floor, back);
      const bool box = std::abs(from.x) < half.x && enters < leaves;
      out.depths.push_back(static_cast<float>(near_to_far * (box ? enters : floor)));
      out.pixels.push_back({box ? 1.0f : 0.0f, 0, 0, 1});
    }
  return out;
}

// How often lines of the picture go from the floor to the box, and the box's pixels.
struct Outlines {
  size_t most = 0, pixels = 0;
};
Outlines outlines(const std::vector<Color>& picture, uint32_t across, uint32_t down) {
  Outlines out;
  const auto isBox = [&](uint32_t x, uint32_t y) { return picture[size_t{y} * across + x][0] > 0.5; };
  for (uint32_t y = 1; y < down; ++y) {
    size_t begins = 0;
    for (uint32_t x = 1; x < across; ++x) {
      begins += isBox(x, y) && !isBox(x - 1, y);
      out.pixels += isBox(x, y);
    }
    out.most = std::max(out.most, begins);
  }
  for (uint32_t x = 1; x < across; ++x) {
    size_t begins = 0;
    for (uint32_t y = 1; y < down; ++y) begins += isBox(x, y) && !isBox(x, y - 1);
    out.most = std::max(out.most, begins);
  }
  return out;
}

// Rays that end near an edge of the box are found on one side of it or the other, not by turns.
TEST_F(FlatPool, SolidsInFluidAreSeenOnce) {
  constexpr double kDepth = 0.4;
  pool(kDepth, 5);
  const FluidLook look = clear();
  for (const double degrees : {30.0, 50.0, 65.0}) {
    const double angle = degrees * kDegree;
    const FluidView view = parallel(angle);
    const Backdrop behind = boxInPool(angle, kDepth, {0.15, 0.2, 0.1}, double{-view.projection.column[2].z});
    Backdrop dark = behind;
    for (auto& pixel : dark.pixels) pixel = {0, 0, 0, 1};
    auto picture = drawn(view, look, behind, {.color = kFormat}).channels(kFormat);
    const auto mirrored = drawn(view, look, dark, {.color = kFormat}).channels(kFormat);
    for (size_t i = 0; i < picture.size(); ++i) picture[i][0] = (picture[i][0] - mirrored[i][0]) / (1 - fresnel(angle, 1.333));
    const Outlines seen = outlines(picture, kAcross, kDown);
    EXPECT_EQ(seen.most, 1u) << degrees << " degrees";
    EXPECT_GT(seen.pixels, 300u) << degrees << " degrees";
  }
}

}  // namespace shading_test
}  // namespace rill::test
