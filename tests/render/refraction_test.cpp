// Refraction of solids in a flat pool: each is seen once, with even outlines.
#include <algorithm>

#include "render/flat_pool.hpp"

namespace rill::test {
namespace shading_test {

// The floor of a pool and a box on it, as a camera without fluid sees them, whose rays of the picture's middle are at `angle` to the
// vertical and end at the origin. The box is red, the floor black.
Backdrop boxInPool(const FluidView& view, double distance, double angle, double depth, Vector half) {
  const auto& columns = view.projection.column;
  const bool isParallel = columns[2].w == 0;
  const Vector forward{0, -std::cos(angle), -std::sin(angle)}, up{0, std::sin(angle), -std::cos(angle)};
  Backdrop out;
  for (uint32_t y = 0; y < view.height; ++y)
    for (uint32_t x = 0; x < view.width; ++x) {
      const double across = (x + 0.5) / view.width * 2 - 1, down = (y + 0.5) / view.height * 2 - 1;
      const Vector off = Vector{across / columns[0].x, 0, 0} + up * (down / columns[1].y);
      const Vector from = forward * -distance + (isParallel ? off : Vector{0, 0, 0}), sight = isParallel ? forward : forward + off;
      const double floor = (-depth - from.y) / sight.y, top = (-depth + half.y - from.y) / sight.y;
      const double front = (half.z - from.z) / sight.z, back = (-half.z - from.z) / sight.z;  // rays run towards -z
      const double left = (-half.x - from.x) / sight.x, right = (half.x - from.x) / sight.x;  // infinite without a slope
      const double enters = std::max({top, front, std::min(left, right)}), leaves = std::min({floor, back, std::max(left, right)});
      const bool box = enters < leaves;
      const double z = -(box ? enters : floor);
      out.depths.push_back(static_cast<float>((columns[2].z * z + columns[3].z) / (columns[2].w * z + columns[3].w)));
      out.pixels.push_back({box ? 1.0f : 0.0f, 0, 0, 1});
    }
  return out;
}

// How often lines of the picture go from the floor to the box, and the box's pixels. Pixels of an edge, which are between both, count as
// those before them.
struct Outlines {
  size_t most = 0, pixels = 0;
};
Outlines outlines(const std::vector<Color>& picture, uint32_t across, uint32_t down) {
  Outlines out;
  const auto follow = [&](size_t first, size_t stride, size_t count) {
    size_t begins = 0;
    bool isBox = false;
    for (size_t k = 0; k < count; ++k) {
      const double red = picture[first + k * stride][0];
      begins += !isBox && red > 0.75;
      isBox = isBox ? red >= 0.25 : red > 0.75;
    }
    out.most = std::max(out.most, begins);
  };
  for (uint32_t y = 0; y < down; ++y) follow(size_t{y} * across, 1, across);
  for (uint32_t x = 0; x < across; ++x) follow(x, across, down);
  out.pixels = size_t(std::ranges::count_if(picture, [](const Color& pixel) { return pixel[0] > 0.5; }));
  return out;
}

class Refraction : public FlatPool {
 protected:
  // A box in a clear pool, without what the pool mirrors.
  Outlines boxSeen(const FluidView& view, double angle, double depth, Vector half) {
    const FluidLook look = clear();
    const Backdrop behind = boxInPool(view, kDistance, angle, depth, half);
    Backdrop dark = behind;
    for (auto& pixel : dark.pixels) pixel = {0, 0, 0, 1};
    auto picture = drawn(view, look, behind, {.color = kFormat}).channels(kFormat);
    const auto mirrored = drawn(view, look, dark, {.color = kFormat}).channels(kFormat);
    for (size_t i = 0; i < picture.size(); ++i) picture[i][0] = (picture[i][0] - mirrored[i][0]) / (1 - fresnel(angle, 1.333));
    return outlines(picture, view.width, view.height);
  }
};

// Rays that end near an edge of the box are found on one side of it or the other, not by turns.
TEST_F(Refraction, SolidsInFluidAreSeenOnce) {
  constexpr double kDepth = 0.4;
  pool(kDepth, 5);
  for (const double degrees : {30.0, 50.0, 65.0}) {
    const double angle = degrees * kDegree;
    const Outlines seen = boxSeen(parallel(angle), angle, kDepth, {0.15, 0.2, 0.1});
    EXPECT_EQ(seen.most, 1u) << degrees << " degrees";
    EXPECT_GT(seen.pixels, 300u) << degrees << " degrees";
    const Outlines inPerspective = boxSeen(eye(angle), angle, kDepth, {0.6, 0.25, 0.4});
    EXPECT_EQ(inPerspective.most, 1u) << degrees << " degrees, perspective";
    EXPECT_GT(inPerspective.pixels, 300u) << degrees << " degrees, perspective";
  }
}

// In slits between solids that hide all samples, the thickness is that in front of the solids, which falls along x.
TEST_F(Refraction, SlitsWithoutSamplesHaveTheThicknessBesideThem) {
  pool(0.4);
  const FluidView view = parallel(0.01);
  FluidLook look = clear();
  look.absorption = {5, 5, 5};
  const uint32_t slit[2] = {0, 1};  // columns of each four; samples lie at the third
  std::vector<float> depths;
  for (uint32_t y = 0; y < kDown; ++y)
    for (uint32_t x = 0; x < kAcross; ++x) {
      const double board = kDistance + 0.35 - 0.3 * x / kAcross;
      depths.push_back(static_cast<float>(-view.projection.column[2].z * (x % 4 <= slit[1] ? 20 : board)));
    }
  const auto white = seen(view, look, {1, 1, 1, 1}, depths), black = seen(view, look, {0, 0, 0, 1}, depths);
  double light[2] = {0, 0};
  for (uint32_t y = 20; y < kDown - 20; ++y)
    for (uint32_t x = 20; x < kAcross - 20; x += 4)
      for (const uint32_t column : slit) {
        const size_t i = size_t{y} * kAcross + x + column;
        light[column] += white[i][0] - black[i][0];
      }
  EXPECT_GT(light[1], 1.001 * light[0]);
}

}  // namespace shading_test
}  // namespace rill::test
