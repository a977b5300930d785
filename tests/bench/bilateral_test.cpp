// The bilateral filter on the GPU against a CPU reference.
#include "bench/bilateral.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "support/gpu_test.hpp"

namespace rill::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kColumns = 37, kRows = 29;

class BilateralOnGpu : public GpuTest {
 protected:
  /// One sample per pixel, four per spacing at a depth of 1 m.
  static surface::SurfacePush view() {
    surface::SurfacePush push{};
    push.perspective = 1;
    push.width = kColumns;
    push.height = kRows;
    push.scale[0] = push.scale[1] = 0.5f;
    push.step = 1;
    push.spacing = 4 * 2 * 0.5f / kRows;
    return push;
  }
  /// A slanted surface with noise, a step and a hole.
  static std::vector<float> picture() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> noise(-0.03f, 0.03f);
    std::vector<float> depth;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        const bool hole = std::hypot(x - 25, y - 8) < 3;
        depth.push_back(hole ? kInfinity : 1 + 0.002f * float(x) + (x > 18 ? 0.5f : 0.0f) + noise(random));
      }
    return depth;
  }
  static std::vector<float> onCpu(const std::vector<float>& before, const bench::BilateralSettings& settings, bool columns, bool rows) {
    const surface::SurfacePush push = view();
    std::vector<float> after = before;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        const double z = before[size_t(y * kColumns + x)];
        if (!std::isfinite(z)) continue;
        const double side = 2 * push.scale[1] / kRows * z / push.spacing;  // sample size, spacings
        const int reach = std::max(1, int(2.3 * settings.sigma / side));
        double sum = 0, weights = 0;
        for (int v = rows ? -reach : 0; v <= (rows ? reach : 0); ++v)
          for (int u = columns ? -reach : 0; u <= (columns ? reach : 0); ++u) {
            if (x + u < 0 || x + u >= kColumns || y + v < 0 || y + v >= kRows) continue;
            const double other = before[size_t((y + v) * kColumns + x + u)];
            if (!std::isfinite(other)) continue;
            const double along = (other - z) / push.spacing / settings.range;
            const double w = std::exp(-0.5 * ((u * u + v * v) * side * side / (settings.sigma * settings.sigma) + along * along));
            sum += w / other;
            weights += w;
          }
        after[size_t(y * kColumns + x)] = float(weights / sum);
      }
    return after;
  }
  std::vector<float> onGpu(const std::vector<float>& before, const bench::BilateralSettings& settings) {
    const auto bilateral = bench::Bilateral::create(device());
    EXPECT_TRUE(bilateral) << bilateral.error().message;
    const Buffer depth = upload("depth", before);
    Graph graph;
    const BufferRef after = bilateral->filter(settings)(graph, graph.import("depth", importOf(depth)), view());
    const Ticket ticket = graph.readback(after);
    run(graph);
    return read<float>(graph, ticket);
  }
  static void expectSame(const std::vector<float>& found, const std::vector<float>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i)
      if (std::isfinite(expected[i]))
        EXPECT_NEAR(found[i], expected[i], 1e-5) << i % kColumns << ", " << i / kColumns;
      else
        EXPECT_EQ(found[i], kInfinity) << i;
  }
};

TEST_F(BilateralOnGpu, MatchesCpuIn2D) {
  for (const double range : {0.3, 1.0}) {
    const bench::BilateralSettings settings{.sigma = 0.9, .range = range, .separable = false};
    expectSame(onGpu(picture(), settings), onCpu(picture(), settings, true, true));
  }
}

TEST_F(BilateralOnGpu, MatchesCpuWhenSeparable) {
  const bench::BilateralSettings settings{.sigma = 1.3, .range = 0.5};
  expectSame(onGpu(picture(), settings), onCpu(onCpu(picture(), settings, true, false), settings, false, true));
}

TEST_F(BilateralOnGpu, KeepsPlanesAndSteps) {
  std::vector<float> step;
  for (int i = 0; i < kColumns * kRows; ++i) step.push_back(i % kColumns > 18 ? 1.5f : 1.0f);
  expectSame(onGpu(step, {.range = 0.3}), step);  // a step of 3.6 spacings, 12 standard deviations
}

}  // namespace
}  // namespace rill::test
