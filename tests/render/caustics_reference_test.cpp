// Rays through the surfaces and beams on the map against references in double precision.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/caustics_rig.hpp"

namespace rill::test {
namespace caustics_test {

// Sums of a channel, by the beams of the photons that the device found.
std::vector<double> splatted(const Refracted& seen, const SunView& view, size_t channel) {
  const int width = int(kCausticFine * view.width), height = int(kCausticFine * view.height);
  const int coarse = int(caustics::kCausticCoarse), coarseWidth = (width + coarse - 1) / coarse,
            coarseHeight = (height + coarse - 1) / coarse;
  std::vector<double> sums(size_t(width) * height + size_t(coarseWidth) * coarseHeight);
  const auto at = [&](int x, int y) -> const Photon* {
    if (x < 0 || y < 0 || x >= width || y >= height) return nullptr;
    return &seen.photons[size_t(y) * width + x];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Photon& own = *at(x, y);
      if (own.path == 0) continue;
      double wide[2] = {};
      for (const bool down : {false, true}) {
        double beam[2] = {down ? 0.0 : 1.0, down ? 1.0 : 0.0};
        for (const int s : {-1, 1}) {
          const Photon* other = at(x + (down ? 0 : s), y + (down ? s : 0));
          if (!other || other->path * own.path <= 0) continue;
          beam[0] = other->u - own.u;
          beam[1] = other->v - own.v;
        }
        for (int k = 0; k < 2; ++k) wide[k] += std::abs(beam[k]);
      }
      const double disc = 0.0093 * std::abs(own.path);
      double place[2] = {own.u, own.v};
      for (double& w : wide) w = std::hypot(w, disc) - 0.5;
      const bool far = std::max(wide[0], wide[1]) > 2.5;
      const int sides[2] = {far ? coarseWidth : width, far ? coarseHeight : height};
      std::vector<double> shares[2];
      int first[2];
      for (int k = 0; k < 2; ++k) {
        if (far) {
          place[k] = (place[k] + 0.5) / coarse - 0.5;
          wide[k] /= coarse;
        }
        wide[k] = std::clamp(wide[k], 1.0, 2.5);
        first[k] = int(std::ceil(place[k] - wide[k]));
        double whole = 0;
        for (int n = first[k]; n <= place[k] + wide[k]; ++n) {
          shares[k].push_back(std::max(1 - std::abs(n - place[k]) / wide[k], 0.0));
          whole += shares[k].back();
        }
        for (double& share : shares[k]) share /= whole;
      }
      for (size_t b = 0; b < shares[1].size(); ++b)
        for (size_t a = 0; a < shares[0].size(); ++a) {
          const int i = first[0] + int(a), j = first[1] + int(b);
          if (i >= 0 && j >= 0 && i < sides[0] && j < sides[1])
            sums[(far ? size_t(width) * height : 0) + size_t(j) * sides[0] + i] += own.light[channel] * shares[0][a] * shares[1][b];
        }
    }
  return sums;
}

TEST_F(CausticsOnGpu, AddsBeamsAsReference) {
  fill(shells({0, 0, 0}, 0.7));
  FluidLook look = clear();
  look.absorption = {1.5f, 0.5f, 0.1f};
  const SunView view = sunAt(30 * kDegree, 2, -2);
  const Refracted seen = refracted(view, look);
  for (size_t c = 0; c < 3; ++c) {
    const auto expected = splatted(seen, view, c);
    double total = 0;
    for (size_t k = 0; k < expected.size(); ++k) {
      // Of each photon a count at most, and the light's eleven bits
      ASSERT_NEAR(seen.sums[3 * k + c] / seen.unit, expected[k], 0.002 * (1 + expected[k])) << k;
      total += expected[k];
    }
    EXPECT_NEAR(seen.total(c) / total, 1, 1e-3);
    EXPECT_GT(total, 100);
  }
}

/// Refraction, landing and light of the rays through the surfaces that the device found, without walls, from a sun in the zenith.
class ReferenceRays {
 public:
  ReferenceRays(const Refracted& seen, const SunView& view, double floor) : seen_(seen), view_(view), floor_(floor) {}

  /// Place in m of the light space and light; none where the surfaces have an edge nearby.
  std::optional<std::array<double, 3>> landing(double a, double b, double index) const {
    const auto first = surface(a, b, 0), below = surface(a, b, 1);
    if (!first || !below) return std::nullopt;
    const Vector normal = unit({(*first)[1], (*first)[2], -1});  // towards the sun
    const double cosine = -normal.z;
    if (cosine < 0.5) return std::nullopt;
    const double lift = 0.3 * kSpace;  // smoothed spheres are this far outside
    const Vector from{a, b, (*first)[0] + lift / cosine};
    const Vector along = refracted({0, 0, 1}, normal, 1 / index);
    // One step of Newton's method from the plane below, as the device takes it
    double path = ((*below)[0] - from.z) / (along.z - (*below)[1] * along.x - (*below)[2] * along.y);
    const Vector there = from + along * path;
    const auto last = surface(there.x, there.y, 1);
    if (!last) return std::nullopt;
    path += ((*last)[0] - there.z) / (along.z - (*last)[1] * along.x - (*last)[2] * along.y);
    const Vector out = unit({-(*last)[1], -(*last)[2], 1});
    if (dot(out, along) < 0.5) return std::nullopt;
    const Vector end = from + along * (path - lift / dot(out, along));
    const Vector onwards = refracted(along, out * -1, index);
    const double ground = view_.nearest - floor_;
    const Vector place = end + onwards * ((ground - end.z) / onwards.z);
    const double leaving = transmittance(std::acos(dot(onwards, out)), index);
    return std::array{place.x, place.y, transmittance(std::acos(cosine), index) * leaving};
  }

 private:
  /// Snell's law for unit vectors: the part across the normal is scaled.
  static Vector refracted(Vector ray, Vector normal, double ratio) {
    const Vector across = (ray - normal * dot(ray, normal)) * ratio;
    return across - normal * std::sqrt(1 - dot(across, across));
  }
  /// Depth and its change per m.
  std::optional<std::array<double, 3>> surface(double a, double b, int side) const {
    const double x = a / view_.texel, y = b / view_.texel;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    std::array<double, 3> sum{};
    double reference = 0;
    for (int k = 0; k < 4; ++k) {
      const int i = left + k % 2, j = top + k / 2;
      const double share = (k % 2 ? x - left : 1 - x + left) * (k / 2 ? y - top : 1 - y + top);
      double z[5];
      for (int n = 0; n < 5; ++n) {
        const int u = i + (n == 1) - (n == 2), v = j + (n == 3) - (n == 4);
        if (u < 0 || v < 0 || u >= int(view_.width) || v >= int(view_.height)) return std::nullopt;
        const Float4& texel = seen_.surfaces[size_t(v) * view_.width + u];
        if (texel.x > 1e20f || texel.z < 0.999f) return std::nullopt;
        z[n] = double{side == 0 ? texel.x : texel.y};
        if (k == 0 && n == 0) reference = z[0];
        if (std::abs(z[n] - reference) > 0.15) return std::nullopt;
      }
      sum[0] += share * z[0];
      sum[1] += share * (z[1] - z[2]) / (2 * view_.texel);
      sum[2] += share * (z[3] - z[4]) / (2 * view_.texel);
    }
    return sum;
  }
  const Refracted& seen_;
  const SunView& view_;
  double floor_;
};

TEST_F(CausticsOnGpu, RefractsAsReference) {
  fill(shells({0, 0, 0}, 1));
  const SunView view = sunAt(0, 3, -2.5);
  const Refracted seen = refracted(view, clear());
  const ReferenceRays reference(seen, view, -2.5);
  const uint32_t side = kCausticFine * view.width;
  uint32_t compared = 0;
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const auto place = [&](double texel) { return ((texel + 0.5) / kCausticFine - 0.5) * view.texel; };
      const auto expected = reference.landing(place(x), place(y), 1.333);
      if (!expected) continue;
      ++compared;
      const Photon& photon = seen.photons[size_t{y} * side + x];
      ASSERT_NEAR(place(photon.u), (*expected)[0], 1e-3) << x << ", " << y;
      ASSERT_NEAR(place(photon.v), (*expected)[1], 1e-3) << x << ", " << y;
      ASSERT_NEAR(photon.light[1], (*expected)[2], 2e-3) << x << ", " << y;
    }
  EXPECT_GT(compared, 1000u);
}

}  // namespace caustics_test
}  // namespace rill::test
