// The mean of the faces around a sample against its formula, and what it says of even and of torn water.
#include <bit>
#include <cmath>

#include "render/surface_reference.hpp"

namespace rill::test {
namespace {

struct Face {
  double depth = SurfaceReference::kNone;
  Vector normal;
};

/// surface_mean.glsl's: 11, 11 and 10 bits, signed.
Vector unpackedMean(uint32_t bits) {
  const auto part = [&](uint32_t from, uint32_t count) {
    return double(int32_t(bits << (32 - from - count)) >> (32 - count)) / ((1 << (count - 1)) - 1);
  };
  return {part(0, 11), part(11, 11), part(22, 10)};
}

/// One dimension of it: weights (1 - (distance over two spacings)^2)^2, of what lies up to four spacings nearer or farther; what does not
/// counts as nothing.
std::vector<Face> blurred(const Samples& samples, const std::vector<Face>& before, bool vertical) {
  std::vector<Face> after = before;
  for (int y = 0; y < samples.rows; ++y)
    for (int x = 0; x < samples.columns; ++x) {
      Face& own = after[samples.index(x, y)];
      if (own.depth == SurfaceReference::kNone) continue;
      const double side = samples.side(own.depth) / double{kSpacing};
      const int stride = std::max(int(2 / (6 * side) + 0.5), 1);
      double weights = 1;
      for (int k = -6; k <= 6; ++k) {
        const int u = vertical ? x : x + k * stride, v = vertical ? y + k * stride : y;
        if (k == 0 || !samples.has(u, v)) continue;
        const Face& other = before[samples.index(u, v)];
        const double inside = std::pow(std::max(1 - std::pow(0.5 * k * stride * side, 2), 0.0), 2);
        weights += inside;
        if (other.depth == SurfaceReference::kNone) continue;
        own.normal =
            own.normal + other.normal * (inside * std::max(1 - std::pow((other.depth - own.depth) / (4 * double{kSpacing}), 2), 0.0));
      }
      own.normal = own.normal * (1 / weights);
    }
  return after;
}

class MeanFacesOnGpu : public SurfaceOnGpu {
 protected:
  struct Found {
    surface::SurfacePush push;
    std::vector<Face> faces, means;
  };
  Found found(const FluidView& view) {
    Graph graph;
    leaveBehind(graph, 0);
    const FluidState fluid = state(graph);
    const SurfaceBuffers buffers =
        renderer().surface.addTo(graph, fluid, renderer().camera(fluid, view), SurfaceMethod::Planes, false, view.focus_m);
    const Ticket samples = graph.readback(buffers.samples), means = graph.readback(renderer().faces.addTo(graph, buffers));
    run(graph);
    Found out{buffers.push, {}, {}};
    const auto faceWords = read<uint32_t>(graph, samples), meanWords = read<uint32_t>(graph, means);
    for (size_t i = 0; i < faceWords.size() / 2; ++i) {
      const auto [depth, n] = unpackPixel(&faceWords[2 * i]);
      out.faces.push_back({double{depth}, {n[0], n[1], n[2]}});
      out.means.push_back({double{std::bit_cast<float>(meanWords[2 * i])}, unpackedMean(meanWords[2 * i + 1])});
    }
    return out;
  }
};

TEST_F(MeanFacesOnGpu, AreTheirFormula) {
  auto all = block({-1, -1, -4.6}, {0.4, 0.3, -4});
  const auto drops = scattered({-1.5, -1.2, -4.5}, {1.5, 1.2, -3}, 120);
  all.insert(all.end(), drops.begin(), drops.end());
  fill(all);
  const FluidView eye = perspective(4);
  for (const FluidView& view : {eye, orthographic(1.2, eye), looking({0, 0, -2.9}, {0, 0, -6}, 200, 150)}) {
    const Found got = found(view);
    const Samples samples(got.push);
    const auto wanted = blurred(samples, blurred(samples, got.faces, false), true);
    int there = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
      ASSERT_EQ(got.means[i].depth, got.faces[i].depth);
      if (got.faces[i].depth == SurfaceReference::kNone) continue;
      ++there;
      const Vector off = got.means[i].normal - wanted[i].normal;
      ASSERT_LT(std::sqrt(dot(off, off)), 4e-3) << i;  // two roundings to 1 / 1023, of z to 1 / 511
    }
    EXPECT_GT(there, 1000);
  }
}

TEST_F(MeanFacesOnGpu, AreLongOnEvenWaterAndShortOnDrops) {
  const auto lengths = [&](const std::vector<Float4>& particles) {
    fill(particles);
    const Found got = found(perspective());
    const Samples samples(got.push);
    const int margin = int(got.push.margin);
    std::vector<double> all;
    for (int y = margin; y < samples.rows - margin; ++y)
      for (int x = margin; x < samples.columns - margin; ++x) {
        const Face& mean = got.means[samples.index(x, y)];
        if (mean.depth != SurfaceReference::kNone) all.push_back(std::sqrt(dot(mean.normal, mean.normal)));
      }
    return all;
  };
  for (const double length : lengths(under({0, 0, -4}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 5))) ASSERT_GT(length, 0.95);
  std::vector<Float4> apart;
  for (int k = 0; k < 25; ++k) apart.push_back({float(k % 5 - 2) * 0.6f, float(k / 5 - 2) * 0.5f, -4, 0});
  const auto drops = lengths(apart);
  ASSERT_GT(drops.size(), 100u);
  for (const double length : drops) ASSERT_LT(length, 0.2);
}

}  // namespace
}  // namespace rill::test
