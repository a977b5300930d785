// The passes from particles to pixels, with planes and with depth filters, against a reference in double precision without grid, lists
// or culling.
#include <algorithm>
#include <cmath>
#include <set>

#include "render/surface_reference.hpp"
#include "shared/no_depth.h"

namespace rill::test {
namespace {

using surface::SurfacePush;

/// Difference of two surface points: whether both exist, and their distance.
struct Difference {
  double spacing = kSpacing;  ///< m; of a sample where that is wider
  int there = 0, lone = 0, off = 0;

  void add(bool got, double depth, Vector normal, const SurfaceReference::Place& wanted) {
    const bool expected = wanted.depth != SurfaceReference::kNone;
    there += expected;
    lone += got != expected;
    if (!got || !expected) return;
    const double angle = std::acos(std::clamp(dot(normal, wanted.normal), -1.0, 1.0));
    off += !(std::abs(depth - wanted.depth) < 1e-3 * spacing) || !(angle < 0.1 * kDegree);
  }
  /// `share`: one in so many may differ, because rounding may decide thresholds differently.
  void expect(const std::string& what, int least, int share) const {
    EXPECT_GT(there, least) << what;
    EXPECT_LE(lone, there / 200) << what << " of " << there;
    EXPECT_LE(off, there / share) << what << " of " << there;
  }
};

using By = SurfaceReference::By;

class ReferenceSurface : public SurfaceOnGpu, public testing::WithParamInterface<By> {
 protected:
  /// A slanted slab beyond the picture's borders, a ball in front of it, a crease, and drops.
  std::vector<Float4> cloud(double size) {
    std::vector<Float4> all = under({0, -0.9 * size, -4}, unit({0.1, 1, 0.35}), unit({1, -0.1, 0}), unit({-0.035, -0.35, 1}), 1.3 * size);
    for (const auto& part :
         {shells({0.45 * size, 0.2 * size, -3.4}, 0.4 * size), block({-0.9 * size, -0.5 * size, -3.8}, {-0.3 * size, 0.3 * size, -3.2}),
          scattered({-size, -size, -4.5}, {size, size, -2.5}, 60)})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  void compare(const std::string& name, const std::vector<Float4>& positions, const FluidView& view, double samplesASpacing, int least,
               int share = 100, int leastClosed = 100) {
    fill(positions);
    Graph graph;
    const FluidState fluid = state(graph);
    SurfacePush camera = renderer().camera(fluid, view);
    camera.step = sampleStep(camera, kSpacing, view.focus_m, samplesASpacing);
    SurfaceSettings settings{.samples = samplesASpacing};
    if (GetParam() == By::Depth) settings.filter = [](Graph&, BufferRef depth, const SurfacePush&) { return depth; };
    const SurfaceBuffers found = renderer().surface.addTo(graph, fluid, camera, SurfaceMethod::Planes, true, view.focus_m, settings);
    const Ticket pixels = graph.readback(found.pixels), samples = graph.readback(found.samples), tiles = graph.readback(found.tiles),
                 blocks = graph.readback(found.blocks), counters = graph.readback(found.counters);
    run(graph);
    const SurfaceReference wanted(found.push, positions, GetParam());
    const auto counted = read<uint32_t>(graph, counters);
    EXPECT_EQ(counted.at(surface::kBoundHits), 0u) << name;
    EXPECT_NEAR(double(counted.at(surface::kSurfaceCount)), double(wanted.surfaceParticles()), 1e-3 * double(wanted.surfaceParticles()) + 1)
        << name;

    const auto at = [](const std::vector<uint32_t>& words, size_t i) { return unpackPixel(&words[2 * i]); };
    const Difference fresh{std::max(double{kSpacing}, wanted.samples().side(view.focus_m))};
    Difference samplesOff = fresh, pixelsOff = fresh;
    int closed = 0;
    const auto sampleWords = read<uint32_t>(graph, samples), pixelWords = read<uint32_t>(graph, pixels);
    ASSERT_EQ(sampleWords.size(), 2 * wanted.smooth().size());
    for (size_t i = 0; i < wanted.smooth().size(); ++i) {
      const auto [depth, n] = at(sampleWords, i);
      samplesOff.add(std::isfinite(depth), double{depth}, {n[0], n[1], n[2]}, wanted.smooth()[i]);
    }
    samplesOff.expect(name + ", samples", least / int(found.push.step * found.push.step), share);
    for (uint32_t y = 0; y < view.height; ++y)
      for (uint32_t x = 0; x < view.width; ++x) {
        const auto [depth, n] = at(pixelWords, y * view.width + x);
        const auto [place, coverage] = wanted.pixel(x, y);
        pixelsOff.add(std::isfinite(depth), double{depth}, {n[0], n[1], n[2]}, coverage >= 0.5 ? place : SurfaceReference::Place{});
        const uint32_t* words = &pixelWords[2 * (y * view.width + x)];
        const uint32_t fifteenths = (words[0] & 0x7FFFFFFF) == kNoDepthBits ? 0 : words[1] >> 28;
        pixelsOff.off += std::abs(fifteenths / 15.0 - coverage) > 0.05;
        // Amid closed samples there is nothing but fluid.
        const auto before = [&](uint32_t pixel) { return int(std::floor((pixel + 0.5) / found.push.step - 0.5)) + int(found.push.margin); };
        const int left = before(x), top = before(y);
        if (wanted.closed(left, top) && wanted.closed(left + 1, top) && wanted.closed(left, top + 1) && wanted.closed(left + 1, top + 1)) {
          ++closed;
          EXPECT_EQ(fifteenths, 15u) << name << " " << x << " " << y;
        }
      }
    pixelsOff.expect(name + ", pixels", least, share);
    EXPECT_GE(closed, leastClosed) << name;
    listed(name, wanted, read<uint32_t>(graph, tiles), counted[surface::kSurfaceTileCount], surface::kSurfaceTile, true);
    listed(name, wanted, read<uint32_t>(graph, blocks), counted[surface::kSampleBlockCount], surface::kSampleBlock, false);
  }

  /// Each tile of pixels, or block of samples, once, if and only if a sphere covers a sample in it (of a tile: or beside it).
  static void listed(const std::string& name, const SurfaceReference& wanted, const std::vector<uint32_t>& list, uint32_t count,
                     uint32_t side, bool ofPixels) {
    const Samples& samples = wanted.samples();
    const int step = int(samples.push.step), margin = int(samples.push.margin), length = int(side);
    const int width = ofPixels ? int(samples.push.width) : samples.columns, height = ofPixels ? int(samples.push.height) : samples.rows;
    const int columns = (width + length - 1) / length, rows = (height + length - 1) / length;
    std::set<uint32_t> expected;
    for (int k = 0; k < columns * rows; ++k) {
      int first[2] = {k % columns * length, k / columns * length}, last[2] = {first[0] + length - 1, first[1] + length - 1};
      if (ofPixels)
        for (int a = 0; a < 2; ++a) {
          first[a] = first[a] / step - 1 + margin;
          last[a] = last[a] / step + 1 + margin;
        }
      bool covered = false;
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x)
          covered = covered || (samples.has(x, y) && std::isfinite(wanted.hard()[samples.index(x, y)]));
      if (covered) expected.insert(uint32_t(k));
    }
    ASSERT_LE(count, list.size()) << name;
    EXPECT_EQ(std::set<uint32_t>(list.begin(), list.begin() + count), expected) << name;
    EXPECT_EQ(count, expected.size()) << name << ": one is listed twice";
  }
};

TEST_P(ReferenceSurface, MatchesInPerspective) {
  const FluidView view = looking({0.1, 0.2, 0}, {0, 0, -4}, 80, 60);
  for (const double samples : {3.0, 1.5, 0.6}) compare("samples " + std::to_string(samples), cloud(1.0), view, samples, 1500);
}

TEST_P(ReferenceSurface, MatchesInOrthographicViews) {
  compare("parallel", cloud(0.6), orthographic(0.7, looking({0, 0.1, 0}, {0, 0, -4}, 72, 56)), 3, 1500);
}

TEST_P(ReferenceSurface, MatchesNearTheEye) {
  // A spacing is 20 to 60 pixels wide, and some particles lie before the near plane.
  auto all = block({-0.25, -0.25, -1.6}, {0.25, 0.15, -1.1});
  const auto drops = scattered({-0.3, -0.3, -1.0}, {0.3, 0.3, 0.1}, 12);
  all.insert(all.end(), drops.begin(), drops.end());
  compare("near", all, looking({0, 0, 0}, {0, 0, -1.2}, 90, 70), 3, 1500);
}

TEST_P(ReferenceSurface, MatchesWhenCutByTheNearPlane) {
  // A slab that the eye is in, and drops beside and before it.
  auto all = block({-0.8, -0.4, -1.2}, {0.8, 0, 0.3});
  const auto drops = scattered({-0.4, 0.15, -0.6}, {0.4, 0.4, 0.1}, 12);
  all.insert(all.end(), drops.begin(), drops.end());
  compare("cut", all, looking({0, 0.05, 0}, {0, 0, -1.2}, 80, 60), 3, 1500);
  compare("inside", block({0, 0, 0}, {1.4, 1.4, 2.4}, 0), looking({0.6667, 0.6667, 1.3333}, {9.6, 0.6667, 1.3333}, 96, 54), 3, 1500);
  compare("cut, parallel", all, orthographic(0.5, looking({0, 0.1, 0}, {0, 0, -4}, 72, 56)), 3, 1500);
}

// Most tiles are empty, and some hold the rim of a drop alone.
TEST_P(ReferenceSurface, MatchesOnSparseDrops) {
  compare("drops", scattered({-2, -1.5, -4.5}, {2, 1.5, -3.5}, 120), perspective(), 3, 3000, 100, 0);
}

// A particle whose plane is decided differently covers about ten of eight hundred pixels.
TEST_P(ReferenceSurface, MatchesWhenParticlesAreSmallerThanSamples) {
  compare("far", cloud(2.5), looking({0, 0, 8}, {0, 0, -4}, 64, 48), 3, 200, 30);
}

INSTANTIATE_TEST_SUITE_P(Methods, ReferenceSurface, testing::Values(By::Planes, By::Depth),
                         [](const auto& one) { return one.param == By::Planes ? "planes" : "depth"; });

}  // namespace
}  // namespace rill::test
