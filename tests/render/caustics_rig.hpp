#pragma once
// The passes of sunlight through the fluid, from a sun at an angle, and what they left.
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "render/caustics.hpp"
#include "render/surface_rig.hpp"

namespace rill::test {
namespace caustics_test {

using caustics::kCausticFine;

inline constexpr double kSpace = 0.1;  // kSpacing

struct Photon {
  double u = 0, v = 0;  ///< texels of the map
  double light[3] = {};
  double path = 0;  ///< texels; negative: it lands on a solid; 0: no photon
};

/// The lower (0) or upper (1) half float of a word.
inline double halfOf(uint32_t word, uint32_t which) { return double{glm::unpackHalf1x16(uint16_t(word >> (16 * which)))}; }

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
inline double transmittance(double angle, double index) {
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

}  // namespace caustics_test
}  // namespace rill::test
