// Single steps of the depth filters against their formulas in double precision, and the stability limit of the flow.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "graph/shader_pass.hpp"
#include "render/curvature_flow.hpp"
#include "render/flow_reference.hpp"
#include "render/view_push.hpp"

namespace rill::test {
namespace {

using surface::SurfacePush;

class DepthFilters : public SurfaceOnGpu {
 protected:
  static constexpr int kColumns = 45, kRows = 37;  // not multiples of a workgroup
  static constexpr uint32_t kStep = 2, kMargin = surface::kMarginSamples;

  /// Of a picture whose samples are `side` m wide, in perspective four meters away.
  static SurfacePush pushOf(bool inPerspective, double side) {
    const FluidView eye = looking({0, 0, 0}, {0, 0, -4}, (kColumns - 2 * kMargin) * kStep, (kRows - 2 * kMargin) * kStep);
    const double half = 0.5 * side * (kRows - 2 * kMargin);
    FluidView view = orthographic(half, eye);
    if (inPerspective) {
      view = eye;
      view.projection.column[0].x = static_cast<float>(4 / half * view.height / view.width);
      view.projection.column[1].y = static_cast<float>(-4 / half);
    }
    const Double3 origin = {0, 0, 0};
    SurfacePush push = viewPush(view, origin);
    push.step = kStep;
    push.margin = kMargin;
    push.spacing = kSpacing;
    push.smoothing = 1e9f;  // of the flow, m^2: what is stable
    return push;
  }
  static Vector pointAt(const SurfacePush& push, int x, int y, double z) {
    const double wide = push.perspective > 0 ? z : 1;
    return {((x - int(kMargin) + 0.5) * push.step / push.width * 2 - 1) * double{push.scale[0]} * wide,
            ((y - int(kMargin) + 0.5) * push.step / push.height * 2 - 1) * double{push.scale[1]} * wide, z};
  }

  /// Through storage buffers over all blocks of samples, and through texel buffers over blocks with fluid only: equal results.
  Map filtered(std::string_view shader, const Map& before, const SurfacePush& push, uint32_t passes = 1,
               SpecializationConstants constants = {}) {
    Map all = filteredIn(shader, allBlocks(before, false), before, push, passes, constants);
    const Map some = filteredIn(std::string(shader) + "_texel", allBlocks(before, true), before, push, passes, constants);
    EXPECT_TRUE(some.z == all.z) << shader;
    return all;
  }
  static std::vector<uint32_t> allBlocks(const Map& map, bool covered) {
    constexpr int kBlock = surface::kSampleBlock;
    const int columns = (map.columns + kBlock - 1) / kBlock, rows = (map.rows + kBlock - 1) / kBlock;
    std::vector<uint32_t> blocks;
    for (int block = 0; block < columns * rows; ++block) {
      bool any = !covered;
      for (int y = block / columns * kBlock; y < std::min((block / columns + 1) * kBlock, map.rows); ++y)
        for (int x = block % columns * kBlock; x < std::min((block % columns + 1) * kBlock, map.columns); ++x)
          any = any || map.at(x, y) != kNone;
      if (any) blocks.push_back(uint32_t(block));
    }
    return blocks;
  }
  Map filteredIn(std::string_view shader, const std::vector<uint32_t>& listed, const Map& before, const SurfacePush& push, uint32_t passes,
                 SpecializationConstants constants) {
    const ComputePipeline* filter = pipeline({.shader = shader, .constants = constants});
    const Buffer source = upload("before", before.z);
    std::vector<uint32_t> counts(surface::kSurfaceCounterWords);
    counts[surface::kSampleBlockCount] = uint32_t(listed.size());
    const Buffer list = upload("blocks", listed.empty() ? std::vector<uint32_t>(1) : listed), counted = upload("counters", counts);
    Graph graph;
    BufferRef from = graph.import("before", importOf(source)), counters = graph.import("counters", importOf(counted)),
              blocks = graph.import("blocks", importOf(list));
    for (uint32_t k = 0; k < passes; ++k) {
      BufferRef to = graph.create("after", {before.z.size() * 4});
      addFill(graph, "clear", {{&to, std::bit_cast<uint32_t>(kNone)}});
      graph.pass("filter", [&](Pass& pass) {
        const Kernel kernel = bindNamed(pass, filter, {{"before", from}, {"after", to}, {"counters", counters}, {"blocks", blocks}});
        return [kernel, groups = listed.size(), own = FlowPush{push, k}, bytes = filter->pushBytes](Commands& commands) {
          commands.dispatch(kernel, groups, std::as_bytes(std::span(&own, 1)).first(bytes));  // a filter without steps has no number of it
        };
      });
      from = to;
    }
    const Ticket ticket = graph.readback(from);
    run(graph);
    Map after = before;
    after.z = read<float>(graph, ticket);
    EXPECT_EQ(after.z.size(), before.z.size());
    return after;
  }

  /// Two rough surfaces with holes: one slanted, one a band in front of it.
  Map rough(double side, double noise) {
    std::uniform_real_distribution<double> bump(-noise, noise), any(0, 1);
    Map map(kColumns, kRows, kNone);
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        if (any(random_) < 0.06) continue;
        const double plane = 4 + 0.3 * side * x - 0.2 * side * y, band = 3.4 + 0.1 * side * x;
        map.at(x, y) = float((std::abs(x - y) < 6 ? band : plane) + bump(random_));
      }
    return map;
  }

  template <class Formula>
  void compare(const std::string& name, const Map& before, const Map& after, const Formula& formula, bool cuts) {
    int unclear = 0, cut = 0, moved = 0;
    for (int y = 0; y < before.rows; ++y)
      for (int x = 0; x < before.columns; ++x) {
        if (before.at(x, y) == kNone) {
          ASSERT_EQ(after.at(x, y), kNone) << x << " " << y;
          continue;
        }
        const Wanted wanted = formula(x, y);
        if (wanted.margin < 1e-4) {
          ++unclear;
          continue;
        }
        ASSERT_NEAR(double{after.at(x, y)}, wanted.z, 1e-4 * kH) << x << " " << y << " of " << name;
        cut += wanted.cut ? 1 : 0;
        moved += std::abs(wanted.z - double{before.at(x, y)}) > 1e-2 * kH ? 1 : 0;
      }
    EXPECT_LT(unclear, before.columns * before.rows / 20);
    EXPECT_GT(moved, before.columns * before.rows / 2);
    if (cuts) { EXPECT_GT(cut, 0) << "the bound was not tried"; }
  }
};

TEST_F(DepthFilters, FlowStepMatchesReference) {
  for (const bool inPerspective : {false, true})
    for (const double time : {1e9, 1e-4}) {  // as long as is stable, and less
      const double side = kH / 4;
      SurfacePush push = pushOf(inPerspective, side);
      push.smoothing = static_cast<float>(time);
      const Map before = rough(side, 0.25 * kH), after = filtered("render/surface_flow", before, push);
      compare(
          inPerspective ? "perspective" : "parallel rays", before, after,
          [&](int x, int y) { return flowed(before, push, x, y, double{surface::kFlowStable}); }, time > 1);
    }
}

// Analytic shapes: a plane stays, a ball shrinks by time over radius along its normals.
TEST_F(DepthFilters, FlowKeepsPlanesAndShrinksBalls) {
  const double side = kH / 4;
  for (const bool inPerspective : {false, true}) {
    const SurfacePush push = pushOf(inPerspective, side);
    const Vector normal = unit({0.4, -0.3, 1}), across = normal * (1 / dot(normal, {0, 0, 4}));  // n.p = n.(0, 0, 4)
    Map plane(kColumns, kRows, 0);
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        const Vector ray = pointAt(push, x, y, 1);
        plane.at(x, y) = float(inPerspective ? 1 / dot(across, ray) : (1 - across.x * ray.x - across.y * ray.y) / across.z);
      }
    const Map after = filtered("render/surface_flow", plane, push, 10);
    for (int y = 12; y < kRows - 12; ++y)  // a step carries the border's bend one sample inwards
      for (int x = 12; x < kColumns - 12; ++x) ASSERT_NEAR(after.at(x, y), plane.at(x, y), 2e-5 * kH) << x << " " << y;
  }
  SurfacePush push = pushOf(false, side);
  push.smoothing = float(0.2 * side * side);
  const double radius = 1.2;
  Map ball(kColumns, kRows, 0);
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const Vector p = pointAt(push, x, y, 0);
      ball.at(x, y) = float(5 - std::sqrt(radius * radius - p.x * p.x - p.y * p.y));
    }
  const Map after = filtered("render/surface_flow", ball, push);
  for (int y = 1; y < kRows - 1; ++y)
    for (int x = 1; x < kColumns - 1; ++x) {
      const Vector p = pointAt(push, x, y, 0);
      const double slant = std::sqrt(1 - (p.x * p.x + p.y * p.y) / (radius * radius));  // of the normal to the ray
      const double shrunk = double{push.smoothing} / radius / slant;
      ASSERT_NEAR(double{after.at(x, y)} - double{ball.at(x, y)}, shrunk, 0.05 * shrunk) << x << " " << y;
    }
}

// The limit of an explicit step is half a squared sample: the highest frequency changes by 1 - 2 share / limit per step.
TEST_F(DepthFilters, FlowIsStableUpToItsLimitOnly) {
  const double side = kH / 4, limit = 0.5;
  EXPECT_LT(double{surface::kFlowStable}, limit);
  const SurfacePush push = pushOf(false, side);
  std::uniform_real_distribution<double> bump(-1, 1);
  const auto roughness = [](const Map& map) {
    double sum = 0;
    for (const float z : map.z) sum += std::pow(double{z} - 4, 2);
    return std::sqrt(sum / double(map.z.size())) / kH;
  };
  const auto start = [&](double size) {
    Map map(kColumns, kRows, 0);
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x)
        map.at(x, y) = float(4 + size * kH * ((x + y) % 2 == 0 ? 1 : -1) + 0.5 * size * kH * bump(random_));
    return map;
  };
  const auto flow = [&](const Map& from, uint32_t steps, double share) {
    const uint32_t constants[] = {std::bit_cast<uint32_t>(float(share))};
    return roughness(filtered("render/surface_flow", from, push, steps, constants));
  };
  for (const double size : {0.01, 0.3}) {  // small, and so rough that bounds and edges take part
    const Map map = start(size);
    double before = roughness(map);
    for (const uint32_t steps : {1u, 10u, 100u, 400u}) {
      const double after = flow(map, steps, 0.95 * limit);
      EXPECT_LT(after, before) << size << " after " << steps;
      before = after;
    }
    EXPECT_LT(before, 0.1 * size);
    // The default step, for any total time.
    EXPECT_LT(roughness(filtered("render/surface_flow", map, push, 400)), 0.1 * size);
  }
  const Map map = start(0.001);
  EXPECT_GT(flow(map, 40, 1.05 * limit), 20 * roughness(map));  // 1.1^40 = 45
  EXPECT_GT(flow(map, 4, 2.05 * limit), 50 * roughness(map));   // 3.1^4 = 92
}

// A Gaussian in one direction over pairs of samples: a pair counts where neither is a hole or more before this one than two meters a meter
// aside; one that lies behind counts as at most a spacing behind, and two meters a meter aside.
Wanted narrowed(const Map& map, const SurfacePush& push, int x, int y, bool vertical) {
  constexpr double kReach = 3 / 1.3, kFront = 2, kBehind = 1, kSlant = 2;
  const double z = double{map.at(x, y)}, side = sideAt(push, z), sigma = double{push.smoothing} * kH;
  const auto linear = [&](double depth) { return push.perspective > 0 ? 1 / depth : depth; };
  Wanted wanted;
  const double reach = kReach * sigma / side;
  if (reach > 1 && reach < 24) wanted.margin = std::abs(reach - std::round(reach));
  const int taps = std::clamp(int(reach), 1, 24);
  double sum = linear(z), weights = 1;
  for (int k = 1; k <= taps; ++k) {
    const double away = k * side;
    bool counts = true;
    double pair = 0;
    for (const int s : {-k, k}) {
      const int u = vertical ? x : x + s, v = vertical ? y + s : y;
      const double other = map.has(u, v) ? double{map.at(u, v)} : double{kNone};
      if (isDepth(other)) wanted.margin = std::min(wanted.margin, std::abs(other - (z - kFront * away)));
      counts = counts && isDepth(other) && other > z - kFront * away;
      const double farthest = z + kBehind * kH + kSlant * away;
      wanted.cut = wanted.cut || (isDepth(other) && other > farthest);
      pair += linear(std::min(other, farthest));
    }
    if (!counts) continue;
    const double weight = std::exp(-away * away / (2 * sigma * sigma));
    sum += weight * pair;
    weights += 2 * weight;
  }
  wanted.z = linear(sum / weights);
  return wanted;
}

TEST_F(DepthFilters, NarrowRangePassMatchesReference) {
  for (const bool inPerspective : {false, true})
    for (const uint32_t vertical : {0u, 1u})
      for (const double sigma : {SurfaceSettings{}.narrow_sigma, 1.3})  // spacings: what is shipped, and wider
        for (const double part : {0.17, 1.4, 0.07}) {                   // of sigma: 13 taps, one, and as many as there may be
          const double side = part * sigma * kH;
          SurfacePush push = pushOf(inPerspective, side);
          push.smoothing = static_cast<float>(sigma);
          const uint32_t constants[] = {vertical};
          const Map before = rough(side, 0.2 * kH), after = filtered("render/surface_narrow", before, push, 1, constants);
          const std::string name =
              std::string(vertical ? "down" : "across") + ", sigma " + std::to_string(sigma) + ", samples of " + std::to_string(side);
          compare(
              name, before, after, [&](int x, int y) { return narrowed(before, push, x, y, vertical != 0); }, true);
        }
}

}  // namespace
}  // namespace rill::test
