// Starts that no sane scene has: coincident, crushed, outside, not numbers.
#include <cmath>
#include <limits>

#include "bench/stability/stress_case.hpp"

namespace rill::bench {
namespace {

constexpr double kSpacing = 0.05;
constexpr Point kRoom = {1, 1, 1};
constexpr Point kNothing = {0, 0, 0};

Scene room() { return tankScene(kSpacing, kNothing, kRoom); }
Scene weightless(Scene scene) {
  for (double& g : scene.gravity) g = 0;
  return scene;
}

std::vector<Float3> lattice(int x, int y, int z, double spacing, Float3 first) {
  std::vector<Float3> points;
  for (int k = 0; k < z; ++k)
    for (int j = 0; j < y; ++j)
      for (int i = 0; i < x; ++i)
        points.push_back({static_cast<float>(first.x + spacing * i), static_cast<float>(first.y + spacing * j),
                          static_cast<float>(first.z + spacing * k)});
  return points;
}

double apart(const Float3& a, const Float3& b) { return std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z); }

StressCase make(std::string name, std::string asserts, Scene scene, std::optional<ParticleSet> start, double speed = 0) {
  StressCase c{.name = std::move(name), .asserts = std::move(asserts), .scene = std::move(scene), .start = std::move(start)};
  c.maxSpeed = usualSpeed(c.scene, speed);
  return c;
}

}  // namespace

std::vector<StressCase> startCases() {
  std::vector<StressCase> cases;
  {
    Scene open = weightless(room());
    open.domain.reset();
    StressCase c = make("coincident-pair", "they part, with no momentum", open, placed({{0, 0, 0}, {0, 0, 0}}));
    c.maxSpeed = 1;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    c.own = [](const StressOutcome& o) {
      const double distance = apart(o.particles.positions[0], o.particles.positions[1]);
      if (distance < 0.01 * kSpacing) return "they are " + number(distance / kSpacing) + " d apart";
      const auto& p = o.run.instants.back().stats.momentum;
      const double momentum = std::hypot(p[0], p[1], p[2]), scale = 1000 * std::pow(kSpacing, 3);
      return momentum > 1e-5 * scale ? "momentum " + number(momentum) + " kg m/s" : std::string();
    };
    cases.push_back(std::move(c));
  }
  {
    StressCase c = make("thousand-coincident", "they spread", weightless(room()), placed(std::vector<Float3>(1000, {0.5f, 0.5f, 0.5f})));
    c.maxSpeed = 20;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    c.own = [](const StressOutcome& o) {
      double farthest = 0;
      for (const Float3& p : o.particles.positions) farthest = std::max(farthest, apart(p, {0.5f, 0.5f, 0.5f}));
      return farthest < 3 * kSpacing ? "the farthest is " + number(farthest / kSpacing) + " d away" : std::string();
    };
    cases.push_back(std::move(c));
  }
  {
    Scene open = room();
    open.domain.reset();
    StressCase c = make("single-particle", "it falls by the formula, to 1e-3", open, placed({{0, 0, 0}}, {1, 2, 0}));
    c.maxSpeed = 20;
    c.own = [](const StressOutcome& o) {
      const double t = o.run.simulated_s;
      const Float3& p = o.particles.positions[0];
      // Symplectic Euler is ahead of the parabola by g t dt / 2, for steps of one length.
      const double x = 1 * t, y = 2 * t - 0.5 * 9.81 * t * t, ahead = 0.5 * 9.81 * t * t / double(o.run.substeps);
      const double off = std::hypot(p.x - x, p.y - (y - ahead), double(p.z));
      return off > 1e-3 * std::hypot(x, y) ? "off by " + number(off) + " m" : std::string();
    };
    cases.push_back(std::move(c));
  }
  {
    Scene open = weightless(room());
    open.domain.reset();
    const auto h = static_cast<float>(2 * kSpacing);
    StressCase c = make("two-at-h", "nothing moves", open, placed({{0, 0, 0}, {h, 0, 0}}));
    c.maxSpeed = 1e-9;
    cases.push_back(std::move(c));
  }
  {
    ParticleSet set = placed(lattice(8, 8, 8, kSpacing, {0.025f, 0.025f, 0.025f}));
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    set.positions[17].x = nan;
    set.positions[100].y = infinite;
    set.positions[101].z = -infinite;
    set.velocities[200].x = nan;
    set.velocities[300] = {infinite, -infinite, nan};
    StressCase c = make("not-numbers", "the five are parked and counted", room(), set);
    c.parked = 5;
    cases.push_back(std::move(c));
  }
  {
    const double near = kSpacing / std::cbrt(100.0);
    StressCase c = make("compressed-100", "", weightless(room()), placed(lattice(10, 10, 10, near, {0.4f, 0.4f, 0.4f})));
    c.maxSpeed = 20;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    cases.push_back(std::move(c));
  }
  {
    StressCase c = make("outside-the-walls", "they are put inside, and get no speed for it", weightless(room()),
                        placed(lattice(8, 8, 8, kSpacing, {0.9f, -0.2f, 0.3f})));
    c.maxSpeed = 0.1;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    cases.push_back(std::move(c));
  }
  {
    StressCase c = make("far-outside", "a kilometer off", room(), placed(lattice(4, 4, 4, kSpacing, {1000.0f, -1000.0f, 3.0f})));
    c.maxEnergy = std::numeric_limits<double>::infinity();
    cases.push_back(std::move(c));
  }
  {
    StressCase c = make("wall-at-100-m/s", "", room(), placed(lattice(8, 8, 8, kSpacing, {0.3f, 0.3f, 0.3f}), {100, 0, 0}), 100);
    c.duration_s = 0.2;
    cases.push_back(std::move(c));
  }
  {
    Scene sheet = tankScene(kSpacing, {1, 0.05, 1}, {1, 1, 1});
    sheet.fill[0].box->min[1] = 0.5;
    sheet.fill[0].box->max[1] = 0.55;
    cases.push_back(make("thin-sheet", "", sheet, {}));
  }
  {
    Scene overlapping = tankScene(kSpacing, {0.5, 0.5, 0.5}, {1, 1, 1});
    Fill second = overlapping.fill[0];
    for (int axis = 0; axis < 3; ++axis) {
      second.box->min[axis] += 0.27;
      second.box->max[axis] += 0.27;
    }
    overlapping.fill.push_back(second);
    StressCase c = make("overlapping-fills", "", overlapping, {});
    c.maxEnergy = 1.1;  // what they part by lifts them
    cases.push_back(std::move(c));
  }
  {
    StressCase c = make("list-overflow", "lists overflow, and that is counted", room(),
                        placed(lattice(12, 12, 12, 0.4 * kSpacing, {0.1f, 0.05f, 0.1f})));
    c.maxSpeed = 20;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    c.own = [](const StressOutcome& o) {
      return o.run.instants.front().stats.neighbor_overflow > 0 ? std::string() : std::string("no overflow was counted");
    };
    cases.push_back(std::move(c));
  }
  cases.push_back(make("one-cell", "", tankScene(kSpacing, {0.1, 0.1, 0.1}, {0.1, 0.2, 0.1}), {}));
  {
    StressCase c = make("all-in-one-cell", "", weightless(room()), placed(lattice(4, 4, 4, 0.2 * kSpacing, {0.5f, 0.5f, 0.5f})));
    c.maxSpeed = 20;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    cases.push_back(std::move(c));
  }
  {
    StressCase c = make("one-in-each-cell", "all fall freely", room(), placed(lattice(7, 2, 7, 2.5 * kSpacing, {0.1f, 0.6f, 0.1f})));
    c.duration_s = 0.2;
    c.own = [](const StressOutcome& o) {
      const double fallen = 0.5 * 9.81 * 0.04;
      for (size_t k = 0; k < o.particles.positions.size(); ++k) {
        const double from = k / 7 % 2 == 0 ? 0.6 : 0.6 + 2.5 * kSpacing;
        if (std::abs(from - o.particles.positions[k].y - fallen) > 0.05 * fallen) return "particle " + std::to_string(k) + " did not";
      }
      return std::string();
    };
    cases.push_back(std::move(c));
  }
  {
    Scene filled = tankScene(kSpacing, {0.5, 0.5, 0.5}, {1, 1, 1});
    Solid obstacle;
    obstacle.box = BoxShape{{0, 0, 0}, {1, 1, 1}};
    filled.solids.push_back(obstacle);
    StressCase c = make("solid-fills-the-tank", "", filled, {});
    c.mayRefuse = true;
    c.maxEnergy = std::numeric_limits<double>::infinity();
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace rill::bench
