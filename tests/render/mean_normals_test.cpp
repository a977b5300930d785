// Mean normals and their coherence against formulas in double precision, and on level water, slanted water and drops.
#include <algorithm>
#include <cmath>

#include "render/surface_reference.hpp"

namespace rill::test {
namespace {

struct Face {
  double depth = SurfaceReference::kNone;
  Vector normal;
};

/// As packMean() of surface_mean_normal.glsl: 11, 11 and 10 signed bits.
Vector unpackedMean(uint32_t bits) {
  const auto part = [&](uint32_t from, uint32_t count) {
    return double(int32_t(bits << (32 - from - count)) >> (32 - count)) / ((1 << (count - 1)) - 1);
  };
  return {part(0, 11), part(11, 11), part(22, 10)};
}

/// One dimension of the mean: weights (1 - (distance / 2 spacings)^2)^2 times 1 - (depth difference / allowed difference)^2.
std::vector<Vector> blurred(const Samples& samples, const std::vector<Face>& faces, const std::vector<Vector>& before, bool vertical) {
  std::vector<Vector> after = before;
  for (int y = 0; y < samples.rows; ++y)
    for (int x = 0; x < samples.columns; ++x) {
      const Face& own = faces[samples.index(x, y)];
      if (own.depth == SurfaceReference::kNone) continue;
      const double spacing = std::max(double{kSpacing}, 1.2 * samples.side(own.depth)), side = samples.side(own.depth) / spacing;
      const int stride = std::max(static_cast<int>(std::lround(2 / (12 * side))), 1);
      const double slant = 1 / std::max(-dot(own.normal, unit(samples.ray(x, y).along)), 0.04);
      double weights = 1;
      Vector& sum = after[samples.index(x, y)];
      for (int k = -12; k <= 12; ++k) {
        const int u = vertical ? x : x + k * stride, v = vertical ? y + k * stride : y;
        if (k == 0 || !samples.has(u, v)) continue;
        const double off = std::abs(k) * stride * side, inside = std::pow(std::max(1 - off * off / 4, 0.0), 2);
        weights += inside;
        const double depth = faces[samples.index(u, v)].depth, change = 4 * spacing * (1 + 0.25 * off * slant);
        if (depth == SurfaceReference::kNone || std::abs(depth - own.depth) >= change) continue;
        sum = sum + before[samples.index(u, v)] * (inside * (1 - std::pow((depth - own.depth) / change, 2)));
      }
      sum = sum * (1 / weights);
    }
  return after;
}

/// One dimension of the smoothing of coherence over 1.5 spacings at any depth. Directions are kept.
std::vector<Vector> smoothedCoherence(const Samples& samples, const std::vector<Face>& faces, const std::vector<Vector>& before,
                                      bool vertical) {
  const auto size = [](const Vector& v) { return std::sqrt(dot(v, v)); };
  std::vector<Vector> after = before;
  for (int y = 0; y < samples.rows; ++y)
    for (int x = 0; x < samples.columns; ++x) {
      const double depth = faces[samples.index(x, y)].depth;
      if (depth == SurfaceReference::kNone) continue;
      const double side = samples.side(depth) / std::max(double{kSpacing}, 1.2 * samples.side(depth)) / 1.5;  // of the reach
      const int stride = std::max(static_cast<int>(std::lround(1 / (12 * side))), 1);
      double sum = 0, weights = 0;
      for (int k = -12; k <= 12; ++k) {
        const int u = vertical ? x : x + k * stride, v = vertical ? y + k * stride : y;
        if (!samples.has(u, v) || faces[samples.index(u, v)].depth == SurfaceReference::kNone) continue;
        const double inside = std::pow(std::max(1 - std::pow(k * stride * side, 2), 0.0), 2);
        sum += inside * size(before[samples.index(u, v)]);
        weights += inside;
      }
      const Vector& own = before[samples.index(x, y)];
      after[samples.index(x, y)] = size(own) > 1e-3 ? own * (sum / weights / size(own)) : Vector{};
    }
  return after;
}

class MeanNormalsOnGpu : public SurfaceOnGpu {
 protected:
  struct Found {
    surface::SurfacePush push;
    std::vector<Face> faces;
    std::vector<Vector> means;
  };
  Found found(const FluidView& view, SurfaceMethod method = SurfaceMethod::Planes) {
    Graph graph;
    fillTransients(graph, 0);
    const FluidState fluid = state(graph);
    const SurfaceBuffers buffers = renderer().surface.addTo(graph, fluid, renderer().camera(fluid, view), method, false, view.focus_m);
    const Ticket samples = graph.readback(buffers.samples), means = graph.readback(renderer().meanNormals.addTo(graph, buffers));
    run(graph);
    Found out{buffers.push, {}, {}};
    const auto faceWords = read<uint32_t>(graph, samples), meanWords = read<uint32_t>(graph, means);
    EXPECT_EQ(meanWords.size(), faceWords.size() / 2);
    for (size_t i = 0; i < meanWords.size(); ++i) {
      const auto [depth, n] = unpackPixel(&faceWords[2 * i]);
      out.faces.push_back({double{depth}, {n[0], n[1], n[2]}});
      out.means.push_back(unpackedMean(meanWords[i]));
    }
    return out;
  }
};

TEST_F(MeanNormalsOnGpu, MatchesReference) {
  auto all = block({-1, -1, -4.6}, {0.4, 0.3, -4});
  const auto drops = scattered({-1.5, -1.2, -4.5}, {1.5, 1.2, -3}, 120);
  all.insert(all.end(), drops.begin(), drops.end());
  fill(all);
  const FluidView eye = perspective(4);
  for (const FluidView& view :
       {eye, orthographic(1.2, eye), looking({0, 0, -2.9}, {0, 0, -6}, 200, 150), looking({0, 0, 60}, {0, 0, -4}, 200, 150)}) {
    const Found got = found(view);
    const Samples samples(got.push);
    std::vector<Vector> own;
    for (const Face& face : got.faces) own.push_back(face.normal);
    const auto mean = blurred(samples, got.faces, blurred(samples, got.faces, own, false), true);
    const auto wanted = smoothedCoherence(samples, got.faces, smoothedCoherence(samples, got.faces, mean, false), true);
    int compared = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (got.faces[i].depth == SurfaceReference::kNone) continue;
      ++compared;
      const Vector off = got.means[i] - wanted[i];
      // Four roundings to 1 / 1023 (z: 1 / 511); scaling a short vector's direction scales its rounding.
      const double shortest = std::max(std::sqrt(dot(mean[i], mean[i])), 1e-2);
      ASSERT_LT(std::sqrt(dot(off, off)), 6e-3 + 4e-3 * std::sqrt(dot(wanted[i], wanted[i])) / shortest) << i;
    }
    EXPECT_GT(compared, 50);
  }
}

class Coherence : public MeanNormalsOnGpu {
 protected:
  /// The coherence of all samples of the picture that hold fluid.
  std::vector<double> coherence(const std::vector<Float4>& particles, const FluidView& view, SurfaceMethod method = SurfaceMethod::Planes) {
    fill(particles);
    const Found got = found(view, method);
    const Samples samples(got.push);
    const int margin = int(got.push.margin);
    std::vector<double> all;
    for (int y = margin; y < samples.rows - margin; ++y)
      for (int x = margin; x < samples.columns - margin; ++x) {
        const size_t i = samples.index(x, y);
        if (got.faces[i].depth != SurfaceReference::kNone) all.push_back(std::sqrt(dot(got.means[i], got.means[i])));
      }
    return all;
  }
};

TEST_F(Coherence, IsOneOnLevelWater) {
  for (const SurfaceMethod method : {SurfaceMethod::Planes, SurfaceMethod::CurvatureFlow, SurfaceMethod::NarrowRange}) {
    const auto even = coherence(under({0, 0, -4}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 5), perspective(), method);
    ASSERT_GT(even.size(), 1000u);
    for (const double length : even) ASSERT_GT(length, 0.95) << int(method);
  }
}

// Level water at flat angles refracts (in full from 0.7) and is not white (from 0.5); below about eight degrees refraction fades.
TEST_F(Coherence, IsHighOnLevelWaterAtFlatAngles) {
  for (const auto& [degrees, low, middle] : {std::array{20.0, 0.6, 0.7}, std::array{10.0, 0.6, 0.7}, std::array{6.0, 0.3, 0.55}}) {
    const double angle = degrees * kDegree;
    const FluidView view = orthographic(0.3, looking({0, 6 * std::sin(angle), 6 * std::cos(angle)}, {0, 0, 0}, 120, 90));
    auto flat = coherence(under({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 5.5), view);
    ASSERT_GT(flat.size(), 300u) << degrees;
    std::sort(flat.begin(), flat.end());
    EXPECT_GT(flat[flat.size() / 20], low) << degrees;
    EXPECT_GT(flat[flat.size() / 2], middle) << degrees;
  }
}

TEST_F(Coherence, IsLowOnSingleDrops) {
  std::vector<Float4> apart;
  apart.reserve(25);
  for (int row = -2; row <= 2; ++row)
    for (int column = -2; column <= 2; ++column) apart.push_back({float(column) * 0.6f, float(row) * 0.5f, -4, 0});
  const auto drops = coherence(apart, perspective());
  ASSERT_GT(drops.size(), 100u);
  for (const double length : drops) ASSERT_LT(length, 0.2);
}

}  // namespace
}  // namespace rill::test
