// Depth and thickness per sample against all particles on all rays in double precision.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "graph/shader_pass.hpp"
#include "render/particle_count.hpp"
#include "render/surface_reference.hpp"
#include "render/view_push.hpp"
#include "shared/no_depth.h"

namespace rill::test {
namespace {

using surface::SurfacePush;

constexpr double kNothing = SurfaceReference::kNone;

class ParticlesToSamples : public SurfaceOnGpu {
 protected:
  static SurfacePush pushOf(const FluidView& view, uint32_t step, uint32_t count) {
    const Double3 origin = {0, 0, 0};
    SurfacePush push = viewPush(view, origin);
    push.step = step;
    push.spacing = kSpacing;
    push.radius = 0.9f * kSpacing;
    push.count = count;
    push.margin = surface::kMarginSamples;
    return push;
  }
  struct Splatted {
    std::vector<float> depth;
    uint32_t survivors = 0;
  };
  Splatted splatted(const SurfacePush& push) {
    const Samples samples(push);
    const uint64_t groups = (count_ + surface::kSurfaceGroup - 1) / surface::kSurfaceGroup;
    Graph graph;
    const FluidState fluid = state(graph);
    const BufferRef position = fluid.position, count = particleCount(graph, fluid);
    BufferRef occluders = graph.create("occluders", {uint64_t(samples.columns) * uint64_t(samples.rows) * 4});
    BufferRef depth = graph.create("depth", {uint64_t(samples.columns) * uint64_t(samples.rows) * 4});
    BufferRef counters = graph.create("counters", {surface::kSurfaceCounterWords * 4});
    BufferRef survivors = graph.create("survivors", {uint64_t{count_} * 4});
    graph.pass("clear", [&](Pass& pass) {
      for (BufferRef* buffer : {&occluders, &depth, &counters}) *buffer = pass.write(*buffer, Use::CopyTarget, true);
      return [=](Commands& commands) {
        commands.fill(occluders, kNoDepthBits);
        commands.fill(depth, kNoDepthBits);
        commands.fill(counters, 0);
      };
    });
    for (const char* part : {"occlude", "cull", "splat"})
      addDispatch(graph, part, pipeline({.shader = std::string("render/surface_") + part}), groups, push,
                  {{"position", position},
                   {"particle_count", count},
                   {"occluders", occluders},
                   {"counters", counters},
                   {"survivors", survivors},
                   {"depth", depth}});
    const Ticket depthTicket = graph.readback(depth), counterTicket = graph.readback(counters);
    run(graph);
    const auto counts = read<uint32_t>(graph, counterTicket);
    EXPECT_EQ(counts.at(surface::kBoundHits), 0u);
    std::vector<float> depths = read<float>(graph, depthTicket);
    std::ranges::replace(depths, std::bit_cast<float>(kNoDepthBits), float(kNothing));
    return {std::move(depths), counts.at(surface::kSurvivorCount)};
  }

  /// The nearest sphere on a sample's ray, or the near plane where it cuts one. `grown`: of their radius.
  static double nearest(const Samples& samples, const std::vector<Vector>& centers, int x, int y, double grown) {
    const Samples::Ray ray = samples.ray(x, y);
    double best = kNothing;
    for (const Vector& center : centers) {
      const double radius = std::max(double{samples.push.radius}, 0.71 * samples.side(center.z));
      const Vector to = center - ray.from;
      const double a = dot(ray.along, ray.along), b = dot(to, ray.along), c = dot(to, to) - radius * radius * grown * grown;
      if (b * b - a * c <= 0) continue;
      const double half = std::sqrt(b * b - a * c) / a;
      if (b / a + half > samples.nearest()) best = std::min(best, std::max(b / a - half, samples.nearest()));
    }
    return best;
  }
};

TEST_F(ParticlesToSamples, SamplesHoldTheNearestSphere) {
  struct Case {
    FluidView view;
    uint32_t step, count;
    Vector low, high;
    bool hides;  ///< some are behind others
  };
  const FluidView eye = looking({0.1, 0.2, 0.3}, {0.3, 0, -4}, 64, 48);
  const Case cases[] = {
      {eye, 1, 60, {-1.5, -1.2, -3}, {1.5, 1.2, -0.2}, false},      // far apart, some at the near plane, some beside the picture
      {eye, 1, 600, {-0.2, -0.2, -1.2}, {0.4, 0.4, -0.4}, true},    // dense
      {eye, 1, 1500, {-0.2, -0.1, -0.5}, {0.4, 0.4, -0.25}, true},  // denser: only its front is visible
      {eye, 1, 60, {-0.3, -0.2, -0.1}, {0.5, 0.6, 0.7}, false},     // around the eye, cut by the near plane
      {eye, 2, 3000, {-2, -1.5, -5}, {2, 1.5, -1}, false},
      {eye, 1, 3000, {-40, -40, -90}, {40, 40, -30}, false},  // smaller than samples: drawn as large as one
      {orthographic(0.3, eye), 1, 800, {-0.2, -0.05, -4}, {0.4, 0.4, 0}, true},
      {orthographic(1.2, eye), 4, 2000, {-2, -2, -4}, {2, 2, 0}, false},
  };
  for (const Case& one : cases) {
    const auto particles = scattered(one.low, one.high, one.count);
    fill(particles);
    const SurfacePush push = pushOf(one.view, one.step, count_);
    const Samples samples(push);
    std::vector<Vector> centers;
    for (const Float4& p : particles) centers.push_back(samples.seen(p));
    const Splatted got = splatted(push);
    ASSERT_EQ(got.depth.size(), size_t(samples.columns) * size_t(samples.rows));
    if (one.hides) { EXPECT_LT(got.survivors, count_ * 9 / 10) << "hardly any is left out, all are in the picture"; }
    size_t covered = 0;
    for (int y = 0; y < samples.rows; ++y)
      for (int x = 0; x < samples.columns; ++x) {
        // At a rim the square root makes much of the last bits: between spheres a little smaller and a little larger.
        const double nearer = nearest(samples, centers, x, y, 1 + 1e-4), farther = nearest(samples, centers, x, y, 1 - 1e-4);
        const double depth = double{got.depth[size_t(y) * size_t(samples.columns) + size_t(x)]};
        const double slack = 2e-6 * (std::isfinite(depth) ? depth : 0);
        ASSERT_GE(depth, nearer - slack) << x << " " << y << " of step " << one.step;
        ASSERT_LE(depth, farther + slack) << x << " " << y << " of step " << one.step;
        covered += std::isfinite(depth) ? 1 : 0;
      }
    EXPECT_GT(covered, got.depth.size() / 50);
    EXPECT_LT(covered, got.depth.size());
  }
}

TEST_F(ParticlesToSamples, ThicknessIsTheSumOfDiscs) {
  const FluidView eye = looking({0, 0, 0}, {0, 0, -4}, 64, 48);
  std::vector<float> wall(64 * 48);
  for (size_t i = 0; i < wall.size(); ++i) wall[i] = i % 64 < 32 ? 3.0f : 100.0f;  // its left half hides what is farther away
  const auto particles = scattered({-2, -1.5, -5}, {2, 1.5, -1}, 1500);
  fill(particles);
  for (const auto& [view, step] : {std::pair{eye, 1u}, {eye, 8u}, {orthographic(1.2, eye), 2u}, {orthographic(0.3, eye), 4u}})
    for (const bool scene : {false, true}) {
      Graph graph;
      const FluidState fluid = state(graph);
      const SurfacePush push = SurfaceStage::thicknessPush(pushOf(view, step, count_), fluid, step);
      std::vector<float> target;  // as the depth target holds the wall
      for (const float z : wall) target.push_back(push.depth_map[0] + push.depth_map[1] * (push.perspective > 0 ? 1 / z : z));
      const Buffer wallBuffer = upload("wall", target);
      const BufferRef depth = scene ? graph.import("wall", importOf(wallBuffer)) : BufferRef{};
      const Ticket ticket = graph.readback(renderer().surface.addThickness(graph, kFluidThickness, fluid, push, depth, nullptr));
      run(graph);
      const auto counts = read<uint32_t>(graph, ticket);
      const Samples samples(push);
      const size_t cells = size_t(samples.columns) * size_t(samples.rows);
      ASSERT_EQ(counts.size(), scene ? 2 * cells : cells);  // before a scene sums of depths follow
      std::vector<double> wanted(cells), terms(cells), depths(cells);
      const double radius = double{push.radius}, volume = std::pow(double{kSpacing}, 3);
      const auto add = [&](int x, int y, double z, double meters) {
        if (x < 0 || y < 0 || x >= samples.columns || y >= samples.rows) return;
        const auto pixel = [&](int at, uint32_t size) { return std::min(size_t((at + 0.5) * step), size_t(size) - 1); };
        if (scene && z > double{wall[pixel(y, 48) * 64 + pixel(x, 64)]}) return;
        const size_t at = size_t(y) * size_t(samples.columns) + size_t(x);
        wanted[at] += meters;
        depths[at] += meters * z;
        terms[at] += meters > 0 ? 1 : 0;
      };
      for (const Float4& p : particles) {
        const Vector center = samples.seen(p);
        if (!(center.z > double{push.near_depth})) continue;
        const double side = samples.side(center.z);
        if (radius < 1.5 * side) {  // shared among the four samples around
          const double wide = push.perspective > 0 ? center.z : 1;
          const auto sample = [&](double across, int a, uint32_t size) {
            return ((across / wide / double{push.scale[a]} + double{push.shift[a]} + 1) * 0.5 * size) / step - 0.5;
          };
          const double x = sample(center.x, 0, push.width), y = sample(center.y, 1, push.height);
          const double left = std::floor(x), top = std::floor(y);
          for (int k = 0; k < 4; ++k) {
            const double px = k & 1 ? x - left : 1 - (x - left), py = k & 2 ? y - top : 1 - (y - top);
            add(int(left) + (k & 1), int(top) + (k >> 1), center.z, volume / (side * side) * px * py);
          }
          continue;
        }
        for (int y = 0; y < samples.rows; ++y)
          for (int x = 0; x < samples.columns; ++x) {
            const Samples::Ray ray = samples.ray(x, y);
            const Vector to = center - ray.from;
            const double along = dot(to, ray.along), square = dot(to, to) - along * along / dot(ray.along, ray.along);
            const double inside = 1 - square / (radius * radius);
            if (inside > 0) add(x, y, center.z, 3 * volume / (std::numbers::pi * radius * radius) * inside * inside);
          }
      }
      double thickest = 0;
      for (size_t i = 0; i < cells; ++i) {
        // Each term is rounded to a count; the float of it by less.
        ASSERT_NEAR(counts[i] * double{push.unit}, wanted[i], 0.51 * double{push.unit} * terms[i] + 1e-4 * wanted[i])
            << i << " of step " << step << (scene ? " before a wall" : "");
        thickest = std::max(thickest, wanted[i]);
        if (!scene || wanted[i] < 0.2 * double{kSpacing}) continue;
        // Depths are rounded to a fourth of a spacing.
        const double mean = counts[cells + i] / double(counts[i]) * double{kSpacing} / 4;
        ASSERT_NEAR(mean, depths[i] / wanted[i], 0.15 * double{kSpacing}) << i << " of step " << step;
      }
      EXPECT_GT(thickest, double{kSpacing});
    }
}

}  // namespace
}  // namespace rill::test
