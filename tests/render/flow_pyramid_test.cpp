// Curvature flow from coarse to fine against a reference in double precision, level by level.
#include <bit>

#include "render/curvature_flow.hpp"
#include "render/flow_reference.hpp"
#include "render/view_push.hpp"

namespace rill::test {
namespace {

using surface::SurfacePush;

/// A level of the pyramid: its samples and how they are seen.
struct Level {
  SurfacePush push;
  Map map;
};

double linear(const SurfacePush& push, double z) { return push.perspective > 0 ? 1 / z : z; }

/// The mean of those of four samples that are on the nearest surface.
Level coarser(const Level& fine) {
  Level out{fine.push, Map(0, 0, 0)};
  out.push.step *= 2;
  out.push.margin /= 2;
  out.map = Map(int((out.push.width + out.push.step - 1) / out.push.step + 2 * out.push.margin),
                int((out.push.height + out.push.step - 1) / out.push.step + 2 * out.push.margin), kNone);
  for (int y = 0; y < out.map.rows; ++y)
    for (int x = 0; x < out.map.columns; ++x) {
      double nearest = double{kNone}, sum = 0, count = 0;
      const auto at = [&](int k) {
        const int u = 2 * x + k % 2, v = 2 * y + k / 2;
        return fine.map.has(u, v) ? double{fine.map.at(u, v)} : double{kNone};
      };
      for (int k = 0; k < 4; ++k) nearest = std::min(nearest, at(k));
      if (!isDepth(nearest)) continue;
      for (int k = 0; k < 4; ++k)
        if (at(k) - nearest < edgeAt(out.push, nearest)) {
          sum += linear(out.push, at(k));
          ++count;
        }
      out.map.at(x, y) = float(linear(out.push, sum / count));
    }
  return out;
}

Level flowing(Level level, int steps, double time) {
  level.push.smoothing = float(time);
  for (int k = 0; k < steps; ++k) {
    const Map before = level.map;
    for (int y = 0; y < before.rows; ++y)
      for (int x = 0; x < before.columns; ++x)
        if (before.at(x, y) != kNone) level.map.at(x, y) = float(flowed(before, level.push, x, y, double{surface::kFlowStable}, k).z);
  }
  return level;
}

/// Interpolates the coarser level; at an edge its displacement.
Level finer(const Level& fine, const Level& started, const Level& flowed) {
  Level out = fine;
  for (int y = 0; y < fine.map.rows; ++y)
    for (int x = 0; x < fine.map.columns; ++x) {
      const double z = double{fine.map.at(x, y)};
      if (!isDepth(z)) continue;
      const double atX = 0.5 * x - 0.25, atY = 0.5 * y - 0.25;
      double sum = 0, moved = 0, weights = 0;
      for (int v = int(std::floor(atY)); v <= int(std::floor(atY)) + 1; ++v)
        for (int u = int(std::floor(atX)); u <= int(std::floor(atX)) + 1; ++u) {
          const int cu = std::clamp(u, 0, flowed.map.columns - 1), cv = std::clamp(v, 0, flowed.map.rows - 1);
          const double now = double{flowed.map.at(cu, cv)}, w = (1 - std::abs(atX - u)) * (1 - std::abs(atY - v));
          if (!(std::abs(now - z) < edgeAt(fine.push, z))) continue;
          sum += w * linear(fine.push, now);
          moved += w * (now - double{started.map.at(cu, cv)});
          weights += w;
        }
      if (weights > 0.999)
        out.map.at(x, y) = float(linear(fine.push, sum / weights));
      else if (weights > 0)
        out.map.at(x, y) = float(z + moved / weights);
    }
  return out;
}

class FlowPyramid : public SurfaceOnGpu {
 protected:
  static constexpr uint32_t kAcross = 67, kDown = 45, kMargin = surface::kMarginSamples;  // not whole blocks on any level

  /// Of samples `side` m wide four meters away; two surfaces, one a band before the other, and holes.
  Level scene(bool inPerspective, double side) {
    const double half = 0.5 * side * kDown;
    const FluidView eye = looking({0, 0, 0}, {0, 0, -4}, kAcross, kDown);
    FluidView view = orthographic(half, eye);
    if (inPerspective) {
      view = eye;
      view.projection.column[0].x = static_cast<float>(4 / half * view.height / view.width);
      view.projection.column[1].y = static_cast<float>(-4 / half);
    }
    SurfacePush push = viewPush(view, {});
    push.step = 1;
    push.margin = kMargin;
    push.spacing = kSpacing;
    std::uniform_real_distribution<double> bump(-0.2 * kH, 0.2 * kH), any(0, 1);
    Map map(int(kAcross + 2 * kMargin), int(kDown + 2 * kMargin), kNone);
    for (int y = 0; y < map.rows; ++y)
      for (int x = 0; x < map.columns; ++x) {
        if (any(random_) < 0.02 || (x > 60 && y > 40)) continue;
        const double plane = 4 + 0.3 * side * x - 0.2 * side * y, band = 3.3 + 0.1 * side * x;
        map.at(x, y) = float((std::abs(x - y) < 9 ? band : plane) + bump(random_));
      }
    return {push, map};
  }

  Map onDevice(const Level& level, double side, double time, uint32_t maxLevels, bool asTexels) {
    auto flow = CurvatureFlow::create(device(), asTexels);
    EXPECT_TRUE(flow);
    constexpr int kBlock = surface::kSampleBlock;
    const int columns = (level.map.columns + kBlock - 1) / kBlock, rows = (level.map.rows + kBlock - 1) / kBlock;
    std::vector<uint32_t> listed;
    for (int block = columns * rows; block-- > 0;) {  // in any order, and those alone that hold a sample
      bool any = false;
      for (int k = 0; k < kBlock * kBlock; ++k) {
        const int x = block % columns * kBlock + k % kBlock, y = block / columns * kBlock + k / kBlock;
        any = any || (level.map.has(x, y) && level.map.at(x, y) != kNone);
      }
      if (any) listed.push_back(uint32_t(block));
    }
    std::vector<uint32_t> counts(surface::kSurfaceCounterWords), groups(surface::kSurfaceArgumentWords);
    counts[surface::kSampleBlockCount] = groups[surface::kSampleBlockArguments] = uint32_t(listed.size());
    groups[surface::kSampleBlockArguments + 1] = groups[surface::kSampleBlockArguments + 2] = 1;
    const Buffer depth = upload("depth", level.map.z), blocks = upload("blocks", listed), counters = upload("counters", counts),
                 arguments = upload("arguments", groups);
    Graph graph;
    fillTransients(graph, 0);
    SurfaceBuffers surface;
    surface.blocks = graph.import("blocks", importOf(blocks));
    surface.counters = graph.import("counters", importOf(counters));
    surface.arguments = graph.import("arguments", importOf(arguments));
    surface.push = level.push;
    const Ticket ticket = graph.readback(flow->addTo(graph, graph.import("depth", importOf(depth)), surface, side, time, maxLevels));
    run(graph);
    Map out = level.map;
    out.z = read<float>(graph, ticket);
    return out;
  }
};

TEST_F(FlowPyramid, MatchesReferenceOnEachLevel) {
  const struct {
    double sideInSpacings, time;
    uint32_t maxLevels, levels;
    int coarsestSteps;
  } cases[] = {{0.3, 0.9, 2, 1, 6}, {0.15, 0.9, 2, 2, 6}, {0.15, 0.9, 1, 1, 23}, {0.3, 0.9, 0, 0, 23}, {0.5, 0.5, 2, 0, 5}};
  for (const bool inPerspective : {false, true})
    for (const auto& one : cases) {
      const double side = one.sideInSpacings * kH, time = one.time * kH * kH;
      std::vector<Level> levels{scene(inPerspective, side)};
      for (uint32_t l = 0; l < one.levels; ++l) levels.push_back(coarser(levels.back()));
      Level wanted = flowing(levels.back(), one.coarsestSteps, time);
      for (uint32_t l = one.levels; l-- > 0;) {
        const double area = std::pow(side * (1 << l), 2);
        const int all = int(std::ceil(time / (double{surface::kFlowStable} * area)));
        wanted = flowing(finer(levels[l], levels[l + 1], wanted), std::min(all, 4), time);
      }
      const Map got = onDevice(levels[0], side, one.time, one.maxLevels, false);
      EXPECT_TRUE(onDevice(levels[0], side, one.time, one.maxLevels, true).z == got.z) << "texels";
      int there = 0, off = 0, early = 0;  // early: on the coarsest level its time is over before the last step
      for (const float z : levels.back().map.z)
        if (z != kNone)
          early +=
              std::ceil(time / (double{surface::kFlowStable} * std::pow(sideAt(levels.back().push, double{z}), 2))) < one.coarsestSteps;
      if (inPerspective) { EXPECT_GT(early, 10) << one.sideInSpacings; }
      double moved = 0;
      for (size_t i = 0; i < got.z.size(); ++i) {
        ASSERT_EQ(got.z[i] == kNone, wanted.map.z[i] == kNone) << i;
        if (got.z[i] == kNone) continue;
        ++there;
        off += std::abs(double{got.z[i]} - double{wanted.map.z[i]}) > 1e-3 * kH;
        moved += std::abs(double{got.z[i]} - double{levels[0].map.z[i]}) / kH;
      }
      EXPECT_GT(moved / there, 0.05) << one.sideInSpacings;
      EXPECT_LT(off, there / 100) << one.sideInSpacings << " spacings a sample, of "
                                  << there;  // where an edge is decided otherwise in floats
    }
}

}  // namespace
}  // namespace rill::test
