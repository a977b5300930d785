// A hydraulic jump in a channel without friction: the ratio of its depths against Bélanger's equation.
#include <cmath>

#include "bench/experiments/experiment.hpp"
#include "bench/experiments/inflow.hpp"

namespace rill::bench {
namespace {

constexpr double kJumpDepth = 0.1, kJumpFroude = 3;       // m; of the inflow
constexpr double kJumpFrom = 1.8, kJumpTo = 3.6;          // m along x, at the start
constexpr double kJumpEnd = 7.5, kJumpTop = 0.7;          // m, of the domain
constexpr double kJumpTailwater = 0.93;                   // share of the depth by Bélanger at which the weir would leave the flow
constexpr double kJumpUpstream[2] = {0.4, 1.6};           // m along x
constexpr double kJumpDownstream[2] = {5.5, 6.5};         // m along x: where the speed is uniform, before the surface falls to the weir
constexpr double kJumpSampledFrom = 2.5, kJumpUntil = 5;  // s
constexpr double kJumpSpacing[kLevels] = {kJumpDepth / 5, kJumpDepth / 8, kJumpDepth / 12};

double belanger(double froude) { return 0.5 * (std::sqrt(1 + 8 * froude * froude) - 1); }

double froudeOf(double speed_m_s, double depth_m) { return speed_m_s / std::sqrt(9.81 * depth_m); }

/// Height (m) of a weir over which a flow (m^2/s) leaves a depth; Rehbock 1929.
double weirHeight(double flow_m2_s, double depth_m) {
  double low = 0, high = depth_m;
  for (int k = 0; k < 50; ++k) {
    const double height = (low + high) / 2, head = depth_m - height;
    const double over = 2.0 / 3 * (0.602 + 0.083 * head / height) * std::sqrt(2 * 9.81) * std::pow(head + 0.0012, 1.5);
    (over > flow_m2_s ? low : high) = height;
  }
  return low;
}

// A step at the start would fall as a dam does, over the inflow, and drown it: the depth rises in steps over the length of a jump.
Scene jumpScene(double spacing) {
  constexpr int kSteps = 6;
  const double wide = 4 * spacing, speed = kJumpFroude * std::sqrt(9.81 * kJumpDepth), flow = speed * kJumpDepth;
  const double tailwater = kJumpTailwater * belanger(kJumpFroude) * kJumpDepth, step = (kJumpTo - kJumpFrom) / kSteps;
  Scene scene = boxScene(spacing, {0, 0, 0}, {kJumpEnd, kJumpTop, wide});
  scene.duration = kJumpUntil;
  scene.domain->inflow = Inflow{.side = Axis::MinusX, .level = kJumpDepth, .speed = speed};
  scene.domain->outflow = Outflow{.side = Axis::PlusX, .level = weirHeight(flow, tailwater)};
  const auto fill = [&](double from, double to, double depth) {
    depth = std::round(depth / spacing) * spacing;
    scene.fill.push_back(boxFill({from, 0, 0}, {to, depth, wide}));
    scene.fill.back().velocity = {flow / depth, 0, 0};
  };
  fill(spacing, kJumpFrom, kJumpDepth);
  for (int k = 0; k < kSteps; ++k)
    fill(kJumpFrom + k * step, kJumpFrom + (k + 1) * step, kJumpDepth + (tailwater - kJumpDepth) * (k + 1) / (kSteps + 1));
  fill(kJumpTo, kJumpEnd, tailwater);
  return scene;
}

/// Means over time of one side of the jump.
struct Side {
  TimeMean depth, speed, momentum;

  void add(const SlabMeans& means) {
    depth.add(means.depth());
    speed.add(means.velocity_m_s.x);
    momentum.add(means.momentum_m2_s2);
  }
  /// Momentum of the flow as seen by an observer who moves against it, m^2/s^2.
  double momentumIn(double observer_m_s) const { return momentum.value() + observer_m_s * (2 * speed.value() + observer_m_s); }
};

/// Depth over that of the other side at which pressure and flow, whose momentum (m^2/s^2) is given, balance those of the other side.
/// Bélanger's equation, where speeds are uniform and flows equal.
double balancedRatio(double depth_m, double momentum, double momentumBeyond) {
  const double froude2 = momentum / (9.81 * depth_m), beyond = momentumBeyond / (9.81 * depth_m);
  return std::sqrt(beyond * beyond + 1 + 2 * froude2) - beyond;
}

// The jump may move: with the speed at which it takes up the difference of the flows, it is at rest in its own frame, and Bélanger's
// equation holds for the Froude number there.
Expected<Outcome> hydraulicJump(const Bench& bench, double spacing) {
  Side inflow, tail;
  std::vector<std::pair<double, double>> ratios, upstream, fronts;
  auto run = runSampled(
      bench, jumpScene(spacing), kJumpUntil, 1.0 / 60, [](double) { return true; },
      [&](const Cloud& cloud, double time) {
        const SlabMeans before = slabMeans(cloud, kJumpUpstream[0], kJumpUpstream[1], 0);
        const SlabMeans after = slabMeans(cloud, kJumpDownstream[0], kJumpDownstream[1], 0);
        ratios.emplace_back(time, after.depth() / before.depth());
        upstream.emplace_back(time, before.depth());
        double front = kJumpEnd;  // where the fluid is twice as deep as the inflow
        for (const Double3& x : cloud.position)
          if (x.y > 2 * kJumpDepth) front = std::min(front, x.x);
        fronts.emplace_back(time, front);
        if (time < kJumpSampledFrom) return;
        inflow.add(before);
        tail.add(after);
      });
  if (!run) return run.error();
  const double low = inflow.depth.value(), high = tail.depth.value();
  const double towardsInflow = (inflow.speed.value() * low - tail.speed.value() * high) / (high - low);
  const double froude = froudeOf(inflow.speed.value() + towardsInflow, low);
  const double tailMomentum = tail.momentumIn(towardsInflow), tailSpeed = tail.speed.value() + towardsInflow;
  Outcome outcome;
  outcome.run = std::move(*run);
  outcome.figures.push_back(relativeFigure("Froude number", froude, kJumpFroude));
  outcome.figures.push_back(relativeFigure("depth ratio", high / low, belanger(froude)));
  outcome.figures.push_back(
      relativeFigure("depth ratio, by momentum", high / low, balancedRatio(low, inflow.momentumIn(towardsInflow), tailMomentum)));
  outcome.figures.push_back(plainFigure("momentum over that of uniform speed", tailMomentum / (tailSpeed * tailSpeed)));
  outcome.curves["depth_ratio"] = curveJson(ratios);
  outcome.curves["upstream_depth_m"] = curveJson(upstream);
  outcome.curves["front_m"] = curveJson(fronts);
  return outcome;
}

}  // namespace

std::vector<Experiment> jumpExperiments() {
  std::vector<Experiment> all;
  for (unsigned level = 0; level < kLevels; ++level)
    all.push_back({"hydraulic-jump", level, false, kJumpSpacing[level],
                   [=](const Bench& bench) { return hydraulicJump(bench, kJumpSpacing[level]); }});
  return all;
}

}  // namespace rill::bench
