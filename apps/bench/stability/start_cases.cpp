// Degenerate initial states: coincident, compressed, outside the domain, non-finite.
#include <cmath>
#include <limits>

#include "bench/stability/stress_case.hpp"

namespace rill::bench {
namespace {

constexpr double kStartSpacing = 0.05;
constexpr Double3 kRoom = {1, 1, 1};
constexpr Double3 kNoFluid = {0, 0, 0};

Scene room() { return tankScene(kStartSpacing, kNoFluid, kRoom); }
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

double distanceBetween(const Float3& a, const Float3& b) { return std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z); }

StressCase make(std::string name, std::string asserts, Scene scene, std::optional<ParticleSet> start, double speed = 0) {
  StressCase c{.name = std::move(name), .asserts = std::move(asserts), .scene = std::move(scene), .start = std::move(start)};
  c.maxSpeed = speedBound(c.scene, speed);
  return c;
}

StressCase coincidentPair() {
  Scene open = weightless(room());
  open.domain.reset();
  StressCase c = make("coincident-pair", "the particles separate with zero total momentum", open, particlesAt({{0, 0, 0}, {0, 0, 0}}));
  c.maxSpeed = 1;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  c.check = [](const StressOutcome& o) {
    const double distance = distanceBetween(o.particles.positions[0], o.particles.positions[1]);
    if (distance < 0.01 * kStartSpacing) return "distance: found " + number(distance / kStartSpacing) + " d, expected at least 0.01 d";
    const auto& p = o.run.instants.back().stats.momentum;
    const double momentum = std::hypot(p[0], p[1], p[2]), scale = 1000 * std::pow(kStartSpacing, 3);
    return momentum > 1e-5 * scale ? "momentum: found " + number(momentum) + " kg m/s, expected zero" : std::string();
  };
  return c;
}

StressCase thousandCoincident() {
  StressCase c =
      make("thousand-coincident", "the particles spread", weightless(room()), particlesAt(std::vector<Float3>(1000, {0.5f, 0.5f, 0.5f})));
  c.maxSpeed = 20;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  c.check = [](const StressOutcome& o) {
    double farthest = 0;
    for (const Float3& p : o.particles.positions) farthest = std::max(farthest, distanceBetween(p, {0.5f, 0.5f, 0.5f}));
    return farthest < 3 * kStartSpacing ? "farthest particle: found " + number(farthest / kStartSpacing) + " d, expected at least 3 d"
                                        : std::string();
  };
  return c;
}

StressCase singleParticle() {
  Scene open = room();
  open.domain.reset();
  StressCase c = make("single-particle", "free fall within 1e-3 of the analytic trajectory", open, particlesAt({{0, 0, 0}}, {1, 2, 0}));
  c.maxSpeed = 20;
  c.check = [](const StressOutcome& o) {
    const double t = o.run.simulated_s;
    const Float3& p = o.particles.positions[0];
    // With constant steps, symplectic Euler leads the parabola by g t dt / 2.
    const double x = 1 * t, y = 2 * t - 0.5 * 9.81 * t * t, ahead = 0.5 * 9.81 * t * t / double(o.run.substeps);
    const double error = std::hypot(p.x - x, p.y - (y - ahead), double(p.z));
    return error > 1e-3 * std::hypot(x, y) ? "position error: found " + number(error) + " m, expected at most 1e-3 of the distance"
                                           : std::string();
  };
  return c;
}

StressCase twoAtH() {
  Scene open = weightless(room());
  open.domain.reset();
  const auto h = static_cast<float>(2 * kStartSpacing);
  StressCase c = make("two-at-h", "particles at the support radius do not interact", open, particlesAt({{0, 0, 0}, {h, 0, 0}}));
  c.maxSpeed = 1e-9;
  return c;
}

StressCase notNumbers() {
  ParticleSet set = particlesAt(lattice(8, 8, 8, kStartSpacing, {0.025f, 0.025f, 0.025f}));
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  set.positions[17].x = nan;
  set.positions[100].y = infinite;
  set.positions[101].z = -infinite;
  set.velocities[200].x = nan;
  set.velocities[300] = {infinite, -infinite, nan};
  StressCase c = make("not-numbers", "five non-finite particles become inactive and are counted", room(), set);
  c.inactive = 5;
  return c;
}

StressCase compressed100() {
  const double near = kStartSpacing / std::cbrt(100.0);
  StressCase c = make("compressed-100", "", weightless(room()), particlesAt(lattice(10, 10, 10, near, {0.4f, 0.4f, 0.4f})));
  c.maxSpeed = 20;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  return c;
}

StressCase outsideTheWalls() {
  StressCase c = make("outside-the-walls", "particles outside are moved inside without gaining speed", weightless(room()),
                      particlesAt(lattice(8, 8, 8, kStartSpacing, {0.9f, -0.2f, 0.3f})));
  c.maxSpeed = 0.1;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  return c;
}

StressCase farOutside() {
  StressCase c = make("far-outside", "particles start a kilometer outside", room(),
                      particlesAt(lattice(4, 4, 4, kStartSpacing, {1000.0f, -1000.0f, 3.0f})));
  c.maxEnergy = std::numeric_limits<double>::infinity();
  return c;
}

StressCase wallAt100MetersASecond() {
  StressCase c = make("wall-at-100-m/s", "", room(), particlesAt(lattice(8, 8, 8, kStartSpacing, {0.3f, 0.3f, 0.3f}), {100, 0, 0}), 100);
  c.duration_s = 0.2;
  return c;
}

StressCase thinSheet() {
  Scene sheet = tankScene(kStartSpacing, {1, 0.05, 1}, {1, 1, 1});
  std::get<BoxShape>(sheet.fill[0].shape).min[1] = 0.5;
  std::get<BoxShape>(sheet.fill[0].shape).max[1] = 0.55;
  return make("thin-sheet", "", sheet, {});
}

StressCase overlappingFills() {
  Scene overlapping = tankScene(kStartSpacing, {0.5, 0.5, 0.5}, {1, 1, 1});
  Fill second = overlapping.fill[0];
  for (int axis = 0; axis < 3; ++axis) {
    std::get<BoxShape>(second.shape).min[axis] += 0.27;
    std::get<BoxShape>(second.shape).max[axis] += 0.27;
  }
  overlapping.fill.push_back(second);
  StressCase c = make("overlapping-fills", "", overlapping, {});
  c.maxEnergy = 1.1;  // separating the overlap adds potential energy
  return c;
}

StressCase listOverflow() {
  StressCase c = make("list-overflow", "overflowing neighbor lists are counted", room(),
                      particlesAt(lattice(12, 12, 12, 0.4 * kStartSpacing, {0.1f, 0.05f, 0.1f})));
  c.maxSpeed = 20;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  c.check = [](const StressOutcome& o) {
    return o.run.instants.front().stats.neighborOverflow > 0 ? std::string() : std::string("neighbor_overflow: found 0, expected above 0");
  };
  return c;
}

StressCase oneCell() { return make("one-cell", "", tankScene(kStartSpacing, {0.1, 0.1, 0.1}, {0.1, 0.2, 0.1}), {}); }

StressCase allInOneCell() {
  StressCase c = make("all-in-one-cell", "", weightless(room()), particlesAt(lattice(4, 4, 4, 0.2 * kStartSpacing, {0.5f, 0.5f, 0.5f})));
  c.maxSpeed = 20;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  return c;
}

StressCase oneInEachCell() {
  StressCase c = make("one-in-each-cell", "isolated particles fall freely", room(),
                      particlesAt(lattice(7, 2, 7, 2.5 * kStartSpacing, {0.1f, 0.6f, 0.1f})));
  c.duration_s = 0.2;
  c.check = [](const StressOutcome& o) {
    const double fallen = 0.5 * 9.81 * 0.04;
    for (size_t k = 0; k < o.particles.positions.size(); ++k) {
      const double from = k / 7 % 2 == 0 ? 0.6 : 0.6 + 2.5 * kStartSpacing;
      if (std::abs(from - o.particles.positions[k].y - fallen) > 0.05 * fallen)
        return "particle " + std::to_string(k) + " does not fall freely";
    }
    return std::string();
  };
  return c;
}

StressCase solidFillsTheTank() {
  Scene filled = tankScene(kStartSpacing, {0.5, 0.5, 0.5}, {1, 1, 1});
  Solid obstacle;
  obstacle.shape = BoxShape{{0, 0, 0}, {1, 1, 1}};
  filled.solids.push_back(obstacle);
  StressCase c = make("solid-fills-the-tank", "", filled, {});
  c.mayBeRejected = true;
  c.maxEnergy = std::numeric_limits<double>::infinity();
  return c;
}

}  // namespace

std::vector<StressCase> startCases() {
  return {coincidentPair(),  thousandCoincident(), singleParticle(),         twoAtH(),           notNumbers(),       compressed100(),
          outsideTheWalls(), farOutside(),         wallAt100MetersASecond(), thinSheet(),        overlappingFills(), listOverflow(),
          oneCell(),         allInOneCell(),       oneInEachCell(),          solidFillsTheTank()};
}

}  // namespace rill::bench
