// Emitters and drains where they are hard: too much, too fast, in each other's way, under fluid and in solids.
#include <cmath>
#include <random>
#include <tuple>

#include "bench/stability/stress_case.hpp"

namespace rill::bench {
namespace {

Emitter tap(const Double3& center, double radius, const Double3& normal, double speed) {
  return {.mouth = DiscMouth{center, radius, normal}, .speed = speed};
}

StressCase flowCase(std::string name, const Double3& fluid, std::vector<Emitter> emitters, std::vector<Drain> drains = {}) {
  StressCase c{.name = std::move(name), .asserts = "the ledger closes", .scene = tankScene(kTankSpacing, fluid, {1, 1, 1})};
  double speed = 0;
  for (const Emitter& emitter : emitters) speed = std::max(speed, emitter.speed);
  c.scene.fluid.capacity = 20000;
  c.scene.emitters = std::move(emitters);
  c.scene.drains = std::move(drains);
  c.maxSpeed = speedBound(c.scene, 2 * speed);
  c.externalWork = true;
  return c;
}

std::string expectEmitted(const StressOutcome& o, bool any) {
  const uint64_t emitted = o.run.instants.back().stats.ledger.emitted;
  if ((emitted > 0) == any) return {};
  return "emitted: found " + std::to_string(emitted) + ", expected " + (any ? "more than 0" : "0");
}

/// A jet that falls back into its basin, which a drain keeps at its level, for ten minutes.
StressCase endlessFountain() {
  StressCase c = flowCase("fountain-for-10-minutes", {1, 0.2, 1}, {tap({0.5, 0.3, 0.5}, 0.08, {0, 1, 0}, 2)},
                          {{.shape = BoxShape{{0, 0.25, 0}, {1, 0.4, 0.1}}}});
  c.asserts = "as much leaves as comes; as many particles and substeps at the end as at the start";
  c.duration_s = 600;
  c.frame_s = 0.25;
  c.fullOnly = true;
  c.check = [](const StressOutcome& o) -> std::string {
    const auto& all = o.run.instants;
    const auto mean = [&](size_t first, size_t last, auto figure) {
      double sum = 0;
      for (size_t k = first; k < last; ++k) sum += figure(all[k].stats);
      return sum / double(last - first);
    };
    const size_t n = all.size(), tenth = n / 10;
    const auto particles = [](const offline::Stats& s) { return double(s.particles); };
    const auto substeps = [](const offline::Stats& s) { return double(s.substeps); };
    for (const auto& [what, early, late] : {std::tuple{"particles", mean(tenth, 2 * tenth, particles), mean(n - tenth, n, particles)},
                                            {"substeps", mean(tenth, 2 * tenth, substeps), mean(n - tenth, n, substeps)}})
      if (!(std::abs(late / early - 1) < 0.05))
        return std::string(what) + ": found " + number(late) + " in the last tenth, expected " + number(early);
    const FluidLedger& l = all.back().stats.ledger;
    return l.emitted > 100 * l.filled ? std::string() : "emitted: found " + std::to_string(l.emitted) + ", expected 100 times the fill";
  };
  return c;
}

}  // namespace

void addRandomFlows(Scene& scene, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) { return low + (high - low) * double(random() >> 11) * 0x1p-53; };
  const Domain& domain = *scene.domain;
  const double d = scene.fluid.spacing, speed = std::sqrt(10 * d);
  const auto place = [&] {
    return Double3{uniform(domain.min.x, domain.max.x), uniform(domain.min.y, domain.max.y), uniform(domain.min.z, domain.max.z)};
  };
  const auto direction = [&] { return Double3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; };
  for (uint64_t k = random() % 4; k > 0; --k) {
    Emitter emitter{.speed = speed * std::pow(10.0, uniform(-2, 1)), .from = uniform(0, 1) * 0.01};
    if (random() % 2 == 0)
      emitter.mouth = DiscMouth{place(), d * uniform(0.1, 4), direction()};
    else
      emitter.mouth = RectMouth{place(), {d * uniform(0.1, 6), d * uniform(0.1, 6)}, direction(), direction()};
    scene.emitters.push_back(emitter);
  }
  for (uint64_t k = random() % 3; k > 0; --k) {
    const Double3 at = place();
    const double size = d * uniform(0.3, 4);
    scene.drains.push_back({.shape = SphereShape{at, size}});
    if (random() % 2 == 0) scene.drains.back().shape = BoxShape{at, {at.x + size, at.y + size, at.z + size}};
  }
  scene.fluid.capacity = random() % 2 == 0 ? 20000 : 0;
  if (random() % 2 == 0) scene.domain->open = static_cast<SideMask>(random() % 64);
  scene.domain->open_removes = scene.domain->open != 0;
  if ((scene.domain->open & 3U) == 0 && random() % 2 == 0)
    scene.domain->outflow = Outflow{.level = (domain.max.y - domain.min.y) * uniform(0.1, 0.9)};
  for (Emitter& emitter : scene.emitters) {
    if (random() % 3 != 0) continue;
    const double way = speed * 0.1 * uniform(0, 3), angle = uniform(0, 3);
    const Double3 to = direction();
    emitter.motion = {{.at = 0}, {.at = 0.1, .translate = {way * to.x, way * to.y, way * to.z}}};
    emitter.motion[1].rotate = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
  }
}

std::vector<StressCase> flowCases() {
  const Double3 none = {0, 0, 0}, half = {1, 0.5, 1};
  std::vector<StressCase> cases;
  cases.push_back(flowCase("tap-100-m/s", none, {tap({0.5, 0.9, 0.5}, 0.1, {0, -1, 0}, 100)}));
  cases.back().fullOnly = true;
  cases.push_back(
      flowCase("taps-against-each-other", none, {tap({0.3, 0.5, 0.5}, 0.1, {1, 0, 0}, 3), tap({0.7, 0.5, 0.5}, 0.1, {-1, 0, 0}, 3)}));
  cases.push_back(
      flowCase("taps-at-one-place", half, {tap({0.5, 0.25, 0.5}, 0.15, {1, 0, 0}, 1), tap({0.5, 0.25, 0.5}, 0.15, {0, 1, 0}, 1)}));
  cases.back().fullOnly = true;
  cases.push_back(flowCase("tap-into-a-corner", half, {tap({0.1, 0.1, 0.1}, 0.1, {-1, -1, -1}, 2)}));
  cases.back().fullOnly = true;
  cases.push_back(flowCase("tap-along-a-wall", half, {tap({0.5, 0.2, 0}, 0.2, {1, 0, 0}, 1)}));
  cases.back().fullOnly = true;
  cases.push_back(flowCase("mouth-larger-than-the-domain", none, {tap({0.5, 0.5, 0.5}, 3, {0, -1, 0}, 1)}));
  cases.push_back(flowCase("mouth-of-a-hundredth-spacing", half, {tap({0.5, 0.8, 0.5}, 0.0005, {0, -1, 0}, 2)}));
  {
    Emitter hose = tap({0.5, 0.9, 0.5}, 0.1, {0, -1, 0}, 2);
    for (int k = 0; k <= 16; ++k) {
      const double angle = 0.7 * (k % 4 == 1 ? 1 : k % 4 == 3 ? -1 : 0);
      hose.motion.push_back({.at = 0.1 * k, .translate = {0.3 * std::sin(angle), 0, 0}});
      hose.motion.back().rotate = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
    }
    cases.push_back(flowCase("hose-that-swings", half, {hose}));
    hose.motion = {{.at = 0.2}, {.at = 0.4, .translate = {0, -0.8, 0}}, {.at = 0.6, .translate = {-1, -0.8, 0}}};
    cases.push_back(flowCase("tap-that-dives-and-leaves", half, {hose}));
    cases.back().fullOnly = true;
  }
  cases.push_back(
      flowCase("tap-in-a-drain", none, {tap({0.5, 0.9, 0.5}, 0.1, {0, -1, 0}, 1)}, {{.shape = SphereShape{{0.5, 0.8, 0.5}, 0.3}}}));
  cases.push_back(flowCase("drain-of-everything", half, {}, {{.shape = BoxShape{{-1, -1, -1}, {2, 2, 2}}, .from = 0.2}}));
  cases.back().check = [](const StressOutcome& o) {
    const uint64_t left = o.run.instants.back().stats.particles;
    return left == 0 ? std::string() : "particles: found " + std::to_string(left) + ", expected 0";
  };
  {
    StressCase c = flowCase("tap-inside-a-solid", half, {tap({0.5, 0.5, 0.5}, 0.1, {0, -1, 0}, 1)});
    c.scene.solids = {{.shape = SphereShape{{0.5, 0.5, 0.5}, 0.3}}};
    c.check = [](const StressOutcome& o) { return expectEmitted(o, false); };
    cases.push_back(c);
  }
  {
    StressCase c = flowCase("tank-that-is-overfilled", {1, 1, 1}, {tap({0.5, 0.5, 0.5}, 0.1, {0, -1, 0}, 1)});
    c.fullOnly = true;
    c.check = [](const StressOutcome& o) { return expectEmitted(o, true); };
    c.maxSpeed *= 4;
    cases.push_back(c);
  }
  {
    StressCase c = flowCase("tap-at-full-capacity", half, {tap({0.5, 0.9, 0.5}, 0.2, {0, -1, 0}, 2)});
    c.scene.fluid.capacity = 4010;
    cases.push_back(c);
  }
  cases.push_back(endlessFountain());
  return cases;
}

}  // namespace rill::bench
