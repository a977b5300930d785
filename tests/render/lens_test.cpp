// Fluid in air as a lens: where rays through a ball end, against Snell's law at both of its surfaces in double precision.
#include <algorithm>

#include "render/flat_pool.hpp"

namespace rill::test {
namespace lens_test {

using shading_test::kFormat;

constexpr double kRadius = 0.8, kIndex = 1.333;

/// Direction behind a surface with a normal against `sight`; `ratio`: of the indices before and behind it.
Vector refracted(Vector sight, Vector normal, double ratio) {
  const double cosine = -dot(sight, normal);
  return sight * ratio + normal * (ratio * cosine - std::sqrt(1 - ratio * ratio * (1 - cosine * cosine)));
}

/// Where a ray that meets the ball around the origin ends in the plane z = -behind.
Vector afterBall(Vector from, Vector sight, double behind) {
  const double middle = -dot(from, sight), square = dot(from, from) - middle * middle;
  const Vector in = from + sight * (middle - std::sqrt(kRadius * kRadius - square));
  const Vector inside = refracted(sight, unit(in), 1 / kIndex), out = in + inside * (-2 * dot(in, inside));
  const Vector leaves = refracted(inside, unit(out) * -1, kIndex);
  return out + leaves * ((-behind - out.z) / leaves.z);
}

class Lens : public shading_test::FlatPool {
 protected:
  static FluidView ahead() { return eye(90 * kDegree); }

  /// The pixels of a wall at z = -behind that are seen; what the fluid reflects is subtracted.
  std::vector<Vector> wallSeen(const FluidView& view, double behind) {
    const auto& columns = view.projection.column;
    const double z = -(kDistance + behind), w = columns[2].w * z + columns[3].w;
    Backdrop dark, wall;
    wall.depths.assign(size_t{view.width} * view.height, static_cast<float>((columns[2].z * z + columns[3].z) / w));
    for (uint32_t y = 0; y < view.height; ++y)
      for (uint32_t x = 0; x < view.width; ++x) wall.pixels.push_back({float(x) + 0.5f, float(y) + 0.5f, 1, 1});
    dark.depths = wall.depths;
    const auto without = drawn(view, clear(), dark, {.color = kFormat}).channels(kFormat);
    const auto with = drawn(view, clear(), wall, {.color = kFormat}).channels(kFormat);
    std::vector<Vector> out;
    for (size_t i = 0; i < with.size(); ++i) {
      const double share = with[i][2] - without[i][2];
      out.push_back({(with[i][0] - without[i][0]) / share, (with[i][1] - without[i][1]) / share, 0});
    }
    return out;
  }

  /// Largest and mean distance, in radii, between where pixels look and where Snell's law leads them, at 0.25 to 0.6 radii from the ball's
  /// middle. Nearer to it, rays that are bent by less than 6 degrees run on parallel.
  struct Errors {
    double most = 0, mean = 0;
    size_t pixels = 0;
  };
  Errors errors(const FluidView& view, double behind) {
    const auto& columns = view.projection.column;
    const bool isParallel = columns[2].w == 0;
    const auto seen = wallSeen(view, behind);
    Errors out;
    for (uint32_t y = 0; y < view.height; ++y)
      for (uint32_t x = 0; x < view.width; ++x) {
        const Vector off{((x + 0.5) / view.width * 2 - 1) / columns[0].x, ((y + 0.5) / view.height * 2 - 1) / columns[1].y, 0};
        const Vector eye{0, 0, kDistance}, ahead{0, 0, -1};
        const Vector from = isParallel ? eye + off : eye, sight = isParallel ? ahead : unit(ahead + off);
        const double along = -dot(from, sight), r = std::sqrt(dot(from, from) - along * along) / kRadius;
        if (r < 0.25 || r > 0.6) continue;
        const Vector wanted = afterBall(from, sight, behind), pixel = seen[size_t{y} * view.width + x];
        const double far = isParallel ? 1 : kDistance + behind;
        const Vector got{(pixel.x / view.width * 2 - 1) / columns[0].x * far, (pixel.y / view.height * 2 - 1) / columns[1].y * far,
                         wanted.z};
        const double error = std::sqrt(dot(got - wanted, got - wanted)) / kRadius;
        out.most = std::max(out.most, error);
        out.mean += error;
        ++out.pixels;
      }
    out.mean /= double(out.pixels);
    return out;
  }
};

// With rays that run on parallel to the view ray behind the ball, the mean errors are 0.25 and 0.7.
TEST_F(Lens, BallInvertsTheSceneBySnellsLaw) {
  fill(shells({0, 0, 0}, kRadius));
  for (const bool isParallel : {true, false})
    for (const double behind : {1.6, 3.0}) {
      const FluidView view = isParallel ? orthographic(1.6, ahead()) : ahead();
      const Errors found = errors(view, behind);
      EXPECT_GT(found.pixels, 300u);
      EXPECT_LT(found.mean, 0.08) << (isParallel ? "parallel, " : "perspective, ") << behind << " m behind";
      EXPECT_LT(found.most, 0.25) << (isParallel ? "parallel, " : "perspective, ") << behind << " m behind";
    }
}

// The path within the ball is longer than that of the view ray: by 12 % at 0.6 radii from its middle.
TEST_F(Lens, LightIsAbsorbedAlongTheBentRay) {
  fill(shells({0, 0, 0}, kRadius));
  const FluidView view = orthographic(1.6, ahead());
  FluidLook gray = clear();
  gray.absorption = {1, 1, 1};
  const auto with = through(view, gray), without = through(view, clear());
  double error = 0, straight = 0, pixels = 0;
  for (uint32_t y = 0; y < view.height; ++y)
    for (uint32_t x = 0; x < view.width; ++x) {
      const auto& columns = view.projection.column;
      const double across = ((x + 0.5) / view.width * 2 - 1) / columns[0].x, up = ((y + 0.5) / view.height * 2 - 1) / columns[1].y;
      const double square = (across * across + up * up) / (kRadius * kRadius);
      if (square < 0.55 * 0.55 || square > 0.65 * 0.65) continue;
      const size_t i = size_t{y} * view.width + x;
      const double path = -std::log(with[i][0] / without[i][0]) / (2 * kRadius);
      error += path - std::sqrt(1 - square / (kIndex * kIndex));
      straight += path - std::sqrt(1 - square);
      ++pixels;
    }
  EXPECT_GT(pixels, 200);
  EXPECT_LT(std::abs(error / pixels), 0.03) << "diameters; the view ray's differs by " << straight / pixels;
}

// A wall is there up to the border of the picture; only rays that leave it see the environment.
TEST_F(Lens, RaysThatMeetTheSceneDoNotSeeTheEnvironment) {
  environment_ = EnvironmentPicture{4, 2, std::vector<uint32_t>(8, sharedExponent(0, 1, 0))};
  constexpr double kLow = -0.7;
  const FluidView view = orthographic(1, ahead());
  const auto& columns = view.projection.column;
  const double behind = 3, z = -(kDistance + behind), w = columns[2].w * z + columns[3].w;
  Backdrop red, black;
  red.color = {1, 0, 0, 1};
  red.depths.assign(size_t{view.width} * view.height, static_cast<float>((columns[2].z * z + columns[3].z) / w));
  black.depths = red.depths;
  fill(shells({0, kLow, 0}, kRadius));
  const auto lit = drawn(view, clear(), red, {.color = kFormat}).channels(kFormat);
  const auto dark = drawn(view, clear(), black, {.color = kFormat}).channels(kFormat);
  double met = 0, least = 1, left = 0, most = 0;
  for (uint32_t y = 0; y < view.height; ++y)
    for (uint32_t x = 0; x < view.width; ++x) {
      const Vector from{((x + 0.5) / view.width * 2 - 1) / columns[0].x, ((y + 0.5) / view.height * 2 - 1) / columns[1].y - kLow,
                        kDistance};
      const double r = std::hypot(from.x, from.y) / kRadius;
      if (r < 0.25 || r > 0.6) continue;
      const double end = std::abs(afterBall(from, {0, 0, -1}, behind).y + kLow) * std::abs(columns[1].y);  // 1: the border
      const double share = lit[size_t{y} * view.width + x][0] - dark[size_t{y} * view.width + x][0];
      if (end > 0.9 && end < 0.95) {
        ++met;
        least = std::min(least, share);
      } else if (end > 1.2) {
        ++left;
        most = std::max(most, share);
      }
    }
  EXPECT_GT(met, 20);
  EXPECT_GT(least, 0.9);
  EXPECT_GT(left, 20);
  EXPECT_LT(most, 0.5);
}

// Light that enters a slab head on leaves it head on, whatever the noise of its thickness.
TEST_F(Lens, SlabKeepsTheDirectionOfRays) {
  fill(block({-2, -2, -0.5}, {2, 2, 0.5}));
  const FluidView view = orthographic(1, ahead());
  const auto touching = wallSeen(view, 0.5), apart = wallSeen(view, 3);
  for (const auto* seen : {&touching, &apart}) {
    double most = 0, sum = 0;
    size_t pixels = 0;
    for (uint32_t y = 20; y < kDown - 20; ++y)
      for (uint32_t x = 20; x < kAcross - 20; ++x) {
        const Vector at = (*seen)[size_t{y} * kAcross + x], off = at - Vector{x + 0.5, y + 0.5, 0};
        const double apart_by = std::sqrt(dot(off, off));
        most = std::max(most, apart_by);
        sum += apart_by;
        ++pixels;
      }
    // 2.5 m behind it a pixel is 0.4 degrees; what is left comes from the front, and from noise that is let through in part.
    EXPECT_LT(most, seen == &touching ? 1.5 : 4.0);
    EXPECT_LT(sum / double(pixels), seen == &touching ? 0.5 : 0.6);
  }
}

}  // namespace lens_test
}  // namespace rill::test
