// Sunlight through the fluid against Snell, Fresnel and lens formulas in double precision.
#include "render/caustics.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <optional>

#include "render/surface_rig.hpp"

namespace rill::test {
namespace caustics_test {

using caustics::kCausticFine;

constexpr double kSpace = 0.1;  // kSpacing

struct Photon {
  double u = 0, v = 0;  ///< texels of the map
  double light[3] = {};
  double path = 0;  ///< texels; negative: it lands on a solid; 0: no photon
};

/// The lower (0) or upper (1) half float of a word.
double halfOf(uint32_t word, uint32_t which) { return double{glm::unpackHalf1x16(uint16_t(word >> (16 * which)))}; }

/// What the passes left.
struct Refracted {
  std::vector<Photon> photons;
  std::vector<Float4> surfaces;
  std::vector<uint32_t> sums;
  std::vector<uint32_t> map;
  double unit = 1;
  /// Light of a texel of the map's first level.
  double light(const SunView& view, uint32_t x, uint32_t y, uint32_t channel) const {
    const size_t at = size_t{y} * kCausticFine * view.width + x;
    return halfOf(map.at(2 * at + channel / 2), channel % 2);
  }
  double total(size_t channel) const {
    double sum = 0;
    for (size_t k = channel; k < sums.size(); k += 3) sum += sums[k] / unit;
    return sum;
  }
};

/// Transmittance of unpolarized light from air into `index`, by Fresnel's equations in the angles.
double transmittance(double angle, double index) {
  if (angle < 1e-6) return 1 - std::pow((index - 1) / (index + 1), 2);
  const double inner = std::asin(std::sin(angle) / index);
  const double across = std::sin(angle - inner) / std::sin(angle + inner), within = std::tan(angle - inner) / std::tan(angle + inner);
  return 1 - 0.5 * (across * across + within * within);
}

class CausticsOnGpu : public SurfaceOnGpu {
 protected:
  /// From a sun at this angle (rad) from the zenith, towards -z: `half` m to each side of the origin.
  static SunView sunAt(double angle, double half, double floor) {
    SunView view;
    view.u = {1, 0, 0};
    view.v = {0, std::sin(angle), -std::cos(angle)};
    view.toSun = {0, std::cos(angle), std::sin(angle)};
    view.texel = 0.5 * kSpace;
    view.width = view.height = uint32_t(2 * half / view.texel) + 1;
    view.first_u = view.first_v = -half;
    view.nearest = half;
    view.depths = 3 * half - floor;
    view.floor = true;
    view.low = {-half, floor, -half};
    view.high = {half, half, half};
    return view;
  }
  static FluidLook clear() {
    FluidLook look;
    look.absorption = {0, 0, 0};
    return look;
  }

  /// Twice, with equal bits.
  Refracted refracted(const SunView& view, const FluidLook& look) {
    bringViewShaders(device());
    const auto stage = SurfaceStage::create(device());
    const auto caustics = Caustics::create(device(), false);
    EXPECT_TRUE(stage && caustics);
    Refracted out;
    Graph graph;
    for (int run = 0; run < 2; ++run) {
      fillTransients(graph, run);
      const FluidState fluid = state(graph);
      const surface::SurfacePush push = SurfaceStage::thicknessPush(thicknessView(view), fluid, 1);
      const BufferRef thickness = stage->addThickness(graph, kFluidShadow, fluid, push, {}, nullptr);
      const Caustics::Frame frame = caustics->addTo(graph, fluid, look, view, thickness, double{push.unit});
      const Ticket landings = graph.readback(frame.landings), surfaces = graph.readback(frame.surfaces), sums = graph.readback(frame.sums),
                   map = graph.readback(frame.map);
      GpuTest::run(graph);
      Refracted now;
      now.unit = frame.unit;
      now.surfaces = read<Float4>(graph, surfaces);
      now.sums = read<uint32_t>(graph, sums);
      now.map = read<uint32_t>(graph, map);
      for (const auto words = read<uint32_t>(graph, landings); now.photons.size() < words.size() / 4;) {
        const uint32_t* word = words.data() + 4 * now.photons.size();
        float place[2];
        std::memcpy(place, word, sizeof place);
        now.photons.push_back(
            {double{place[0]}, double{place[1]}, {halfOf(word[2], 0), halfOf(word[2], 1), halfOf(word[3], 0)}, halfOf(word[3], 1)});
      }
      if (run == 1) {
        EXPECT_EQ(out.sums, now.sums);
        EXPECT_EQ(out.map, now.map);
      }
      out = std::move(now);
    }
    return out;
  }

 private:
  /// The view as an orthographic camera whose pixels are its texels.
  static surface::SurfacePush thicknessView(const SunView& view) {
    surface::SurfacePush push{};
    const Double3* axes[3] = {&view.u, &view.v, &view.toSun};
    for (size_t r = 0; r < 3; ++r)
      for (size_t c = 0; c < 3; ++c) push.rows[4 * r + c] = float((r == 2 ? -1 : 1) * (*axes[r])[c]);
    push.rows[3] = float(-view.first_u);
    push.rows[7] = float(-view.first_v);
    push.rows[11] = float(view.nearest);
    for (int r = 0; r < 2; ++r) {
      push.scale[r] = float(0.5 * view.texel * view.width);
      push.shift[r] = 1.0f / float(view.width) - 1.0f;
    }
    push.depth_map[1] = float(1 / view.depths);
    push.near_depth = -1e30f;
    push.width = view.width;
    push.height = view.height;
    return push;
  }
};

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

TEST_F(CausticsOnGpu, FlatSurfaceTransmitsByFresnel) {
  fill(block({-2.2, -1, -5}, {2.2, 0, 3.2}, 0.2));
  for (const double degrees : {0.0, 30.0, 60.0}) {
    const SunView view = sunAt(degrees * kDegree, 2, -1);
    const Refracted seen = refracted(view, clear());
    // Light that lands in the middle of the view, over the light that goes there without fluid
    double sum = 0, count = 0;
    const uint32_t side = kCausticFine * view.width, edge = side / 4;
    for (uint32_t y = edge; y < side - edge; ++y)
      for (uint32_t x = edge; x < side - edge; ++x, ++count) sum += seen.light(view, x, y, 1);
    EXPECT_NEAR(sum / count, transmittance(degrees * kDegree, 1.333), 0.01) << degrees << " degrees";
  }
}

TEST_F(CausticsOnGpu, FlatSurfaceShiftsLightBySnell) {
  fill(block({-2.2, -1, -5}, {2.2, 0, 3.2}, 0.2));
  const double angle = 40 * kDegree, inner = std::asin(std::sin(angle) / 1.333);
  const SunView view = sunAt(angle, 2, -1);
  const Refracted seen = refracted(view, clear());
  double shift = 0, count = 0, path = 0;
  const uint32_t side = kCausticFine * view.width;
  for (uint32_t y = side / 3; y < 2 * side / 3; ++y)
    for (uint32_t x = side / 3; x < 2 * side / 3; ++x, ++count) {
      const Photon& photon = seen.photons[size_t{y} * side + x];
      shift += photon.v - y;
      path += photon.path - 1;
    }
  // Along v the floor's points are as far apart as the cosine of the sun's angle says.
  const double texel = view.texel / kCausticFine;
  EXPECT_NEAR(shift / count * texel, (std::tan(inner) - std::tan(angle)) * std::cos(angle), 0.005);
  EXPECT_NEAR(path / count * texel, 1 / std::cos(inner), 0.01);
}

// As much light lands as enters the fluid: photons that are absorbed by nothing and reflected at both surfaces of a ball alone.
TEST_F(CausticsOnGpu, KeepsEnergy) {
  const double radius = 1;
  fill(shells({0, 0, 0}, radius));
  const SunView view = sunAt(0, 4, -3);
  const Refracted seen = refracted(view, clear());
  // Light that a ball of this size lets through, by rings
  double expected = 0;
  for (int k = 0; k < 1000; ++k) {
    const double r = (k + 0.5) / 1000, angle = std::asin(r);
    expected += 2 * std::numbers::pi * radius * radius * r / 1000 * std::pow(transmittance(angle, 1.333), 2);
  }
  const double texel = view.texel / kCausticFine, landed = seen.total(1) * texel * texel;
  double covered = 0;
  for (uint32_t y = 0; y < kCausticFine * view.height; ++y)
    for (uint32_t x = 0; x < kCausticFine * view.width; ++x) covered += (1 - seen.light(view, x, y, 3)) * texel * texel;
  EXPECT_NEAR(covered / (std::numbers::pi * radius * radius), 1, 0.05);
  EXPECT_NEAR(landed / expected, 1, 0.05);
}

// A ball lens: from its center the paraxial focus is n D / (4 (n - 1)).
TEST_F(CausticsOnGpu, BallFocusesAtItsFocalLength) {
  const double radius = 1, index = 1.333, focal = index * 2 * radius / (4 * (index - 1));
  fill(shells({0, 0, 0}, radius));
  for (const double floor : {-1.6, -2.0, -2.4}) {
    const SunView view = sunAt(0, 3, floor);
    const Refracted seen = refracted(view, clear());
    // Paraxial light lands at the distance r (1 - floor / focal) from the axis.
    double product = 0, square = 0;
    const double texel = view.texel / kCausticFine, middle = (kCausticFine * view.width - 1) / 2.0;
    const uint32_t side = kCausticFine * view.width;
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t x = 0; x < side; ++x) {
        const double u = (x - middle) * texel, v = (y - middle) * texel;
        if (u * u + v * v > 0.0625 * radius * radius) continue;
        const Photon& photon = seen.photons[size_t{y} * side + x];
        product += u * (photon.u - middle) * texel + v * (photon.v - middle) * texel;
        square += u * u + v * v;
      }
    EXPECT_NEAR(-floor / (1 - product / square) / focal, 1, 0.05) << floor;
  }
}

TEST_F(CausticsOnGpu, AbsorbsAlongThePath) {
  fill(block({-2.2, -1, -5}, {2.2, 0, 3.2}, 0.2));
  FluidLook look = clear();
  look.absorption = {1.5f, 0.5f, 0.1f};
  const double angle = 40 * kDegree, inner = std::asin(std::sin(angle) / 1.333), rates[] = {1.5, 0.5, 0.1};
  const SunView view = sunAt(angle, 2, -1);
  const Refracted seen = refracted(view, look);
  const uint32_t side = kCausticFine * view.width, edge = side / 4;
  for (uint32_t c = 0; c < 3; ++c) {
    double sum = 0, count = 0;
    for (uint32_t y = edge; y < side - edge; ++y)
      for (uint32_t x = edge; x < side - edge; ++x, ++count) sum += seen.light(view, x, y, c);
    const double expected = transmittance(angle, 1.333) * std::exp(-rates[c] / std::cos(inner));
    EXPECT_NEAR(sum / count / expected, 1, 0.03) << c;
  }
}

TEST_F(CausticsOnGpu, HandlesParticlesOutOfView) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  fill({{1e9f, 1e9f, 1e9f, 0}, {nan, 0, 0, 0}, {0, infinite, 0, 0}, {1e6f, 0, 0, 0}, {0, -1e6f, 1e6f, 0}});
  const SunView view = sunAt(20 * kDegree, 1, -1);
  const Refracted seen = refracted(view, clear());
  EXPECT_TRUE(std::ranges::all_of(seen.sums, [](uint32_t sum) { return sum == 0; }));
  for (uint32_t y = 0; y < kCausticFine * view.height; ++y)
    for (uint32_t x = 0; x < kCausticFine * view.width; ++x) ASSERT_EQ(seen.light(view, x, y, 3), 1) << x << ", " << y;
}

}  // namespace caustics_test
}  // namespace rill::test
