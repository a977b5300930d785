// Extreme forces, time steps and scales.
#include <cmath>
#include <limits>

#include "bench/experiments/measures.hpp"
#include "bench/mesh_shapes.hpp"
#include "bench/stability/stress_case.hpp"
#include "fluid/settings.hpp"

namespace rill::bench {
namespace {

Scene dam(double d = 0.05) { return tankScene(d, {8 * d, 12 * d, 6 * d}, {20 * d, 20 * d, 6 * d}); }

StressCase make(std::string name, std::string asserts, Scene scene) {
  StressCase c{.name = std::move(name), .asserts = std::move(asserts), .scene = std::move(scene)};
  c.maxSpeed = speedBound(c.scene);
  return c;
}

/// A dam break scaled geometrically to `spacing`, run for the same dimensionless time t sqrt(g/L).
StressCase scaled(const std::string& name, double spacing) {
  StressCase c = make(name, "as at 5 cm: mean error and final energy ratio", dam(spacing));
  c.reference = dam();
  const double time = std::sqrt(spacing / 0.05);
  c.duration_s = 0.5 * time;
  c.frame_s = time / 60;
  return c;
}

/// Water in a cup that gravity, turning ten times a second, shakes. The walls are a spacing thick, or a sheet.
StressCase shakenCup(bool sheet) {
  constexpr double d = 0.05, seconds = 60;
  const Double3 low{4 * d, 2 * d, 4 * d}, high{12 * d, 42 * d, 12 * d};
  Scene scene = tankScene(d, {1, 1, 1}, {16 * d, 44 * d, 16 * d});
  scene.fill[0].shape = BoxShape{low, {high.x, low.y + 6 * d, high.z}};
  for (int k = 1; k < 10 * seconds; ++k)
    scene.gravity_changes.push_back({0.1 * k, {12 * std::sin(2.1 * k), -9.81, 12 * std::cos(3.3 * k)}});
  if (auto mesh = Mesh::create(sheet ? openBox(low, high) : cupMesh(low, high, d), sheet))
    scene.solids.push_back(Solid{.shape = MeshShape{.two_sided = sheet, .mesh = *std::move(mesh)}});
  StressCase c = make(sheet ? "shaken-sheet" : "shaken-cup", "no particle leaves through the walls, which are thin, in 60 s", scene);
  c.duration_s = seconds;
  c.externalWork = true;
  c.fullOnly = true;
  c.check = [low, high](const StressOutcome& o) {
    const Cloud cloud = cloudOf(o.particles, d);
    size_t left = 0;
    for (const Double3& at : cloud.position) left += at.x < low.x || at.x > high.x || at.y < low.y || at.z < low.z || at.z > high.z;
    return left > 0 ? "outside of the cup: found " + std::to_string(left) + " particles, expected none" : std::string();
  };
  return c;
}

StressCase oneSubstepPerFrame(double step) {
  Scene scene = dam();
  scene.solver.time_step = step;
  scene.solver.max_substeps = 1;
  scene.solver.tolerance = 0;
  scene.solver.cfl = 10;
  StressCase c = make("step-" + number(step) + "-s", "one substep per frame: the remaining time is reported as dropped", scene);
  c.check = [](const StressOutcome& o) {
    return o.run.timeDropped_s > 0 ? std::string() : std::string("time_dropped_s: found 0, expected above 0");
  };
  return c;
}

StressCase weightless10S() {
  Scene drop;
  drop.name = "stress";
  drop.fluid.spacing = 0.05;
  for (double& g : drop.gravity) g = 0;
  Fill ball;
  ball.shape = SphereShape{{0, 0, 0}, 0.2};
  ball.velocity[0] = 0.3;
  ball.velocity[1] = -0.1;
  drop.fill.push_back(ball);
  StressCase c = make("weightless-10-s", "momentum is conserved to 1e-5", drop);
  c.maxSpeed = 1;
  c.duration_s = 10;
  c.frame_s = 0.1;
  c.check = [](const StressOutcome& o) {
    const auto &a = o.run.instants.front().stats.momentum, &b = o.run.instants.back().stats.momentum;
    const double change = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / std::hypot(a[0], a[1], a[2]);
    return change > 1e-5 ? "relative change of momentum: found " + number(change) + ", expected at most 1e-5" : std::string();
  };
  return c;
}

StressCase gravity1000() {
  Scene heavy = dam();
  heavy.gravity[1] = -1000;
  heavy.solver.max_substeps = 256;
  StressCase c = make("gravity-1000", "", heavy);
  c.duration_s = 0.1;
  c.frame_s = 1.0 / 600;
  return c;
}

StressCase gravityFlips() {
  Scene flips = dam();
  for (int k = 1; k < 10; ++k) flips.gravity_changes.push_back({0.1 * k, {0, k % 2 ? 9.81 : -9.81, 0}});
  StressCase c = make("gravity-flips", "", flips);
  c.externalWork = true;
  c.duration_s = 1;
  return c;
}

StressCase originAt10Km() {
  Scene far = dam();
  for (int axis = 0; axis < 3; ++axis) {
    far.domain->min[axis] += 1e4;
    far.domain->max[axis] += 1e4;
    auto& box = std::get<BoxShape>(far.fill[0].shape);
    box.min[axis] += 1e4;
    box.max[axis] += 1e4;
  }
  StressCase c = make("origin-at-10-km", "as at the origin: mean error and final energy ratio", far);
  c.reference = dam();
  return c;
}

StressCase column100Layers() {
  constexpr double d = 0.02;
  Scene column = tankScene(d, {10 * d, 100 * d, 10 * d}, {10 * d, 130 * d, 10 * d});
  StressCase c = make("column-100-layers", "level within 1 %; rms speed under 0.01 sqrt(g d) = 4.4 mm/s", column);
  c.duration_s = 2;
  c.fullOnly = true;
  c.check = [](const StressOutcome& o) {
    const Cloud cloud = cloudOf(o.particles, d);
    const double level = surfaceLevel(cloud, 0, 0, 10 * d), speed = rmsSpeed(cloud);
    if (std::abs(level - 2) > 0.02) return "level: found " + number(level, 4) + " m, expected 2 m within 1 %";
    return speed > 0.01 * std::sqrt(9.81 * d) ? "rms speed: found " + number(speed) + " m/s, expected at most 4.4e-3 m/s" : std::string();
  };
  return c;
}

/// A piston compresses the fluid to 80 % of its volume, holds, and retracts.
StressCase crushedTo80Percent() {
  Scene crush = tankScene(0.05, {0.5, 0.5, 0.5}, {0.6, 0.5, 0.5});
  Solid piston;
  piston.shape = BoxShape{{0.5, -0.1, -0.1}, {0.6, 0.6, 0.6}};
  piston.motion = {{0, {0, 0, 0}}, {0.2, {-0.1, 0, 0}}, {0.4, {-0.1, 0, 0}}, {0.5, {0, 0, 0}}};
  crush.solids.push_back(piston);
  StressCase c = make("crushed-to-80-percent", "after release, the speed falls below 2 m/s", crush);
  c.externalWork = true;
  c.duration_s = 1.5;
  c.maxSpeed = 60;
  c.fullOnly = true;
  c.check = [](const StressOutcome& o) {
    const double speed = o.run.instants.back().stats.maxSpeed;
    return speed > 2 ? "maximum speed: found " + number(speed) + " m/s, expected at most 2 m/s" : std::string();
  };
  return c;
}

/// A box closes in on a wall until it touches it. A fall through the room gives 4 m/s.
StressCase boxThatClosesOnAWall() {
  constexpr double d = kTankSpacing;
  Scene closing = tankScene(d, {16 * d, 8 * d, 8 * d}, {16 * d, 16 * d, 12 * d});
  closing.solids = {{.shape = BoxShape{{10 * d, 0, 2 * d}, {14 * d, 3 * d, 6 * d}}}};
  closing.solids[0].motion = {{0, {0, 0, 0}}, {0.8, {0, 0, -2 * d}}};
  StressCase c = make("box-that-closes-on-a-wall", "", closing);
  c.externalWork = true;
  c.duration_s = 1;
  c.maxSpeed = 8;
  return c;
}

/// The long case settles, the short one starts at rest: sloshing exchanges energy with the lattice and looks like drift.
StressCase manySteps(bool longRun) {
  Scene small = tankScene(0.05, longRun ? Double3{0.2, 0.2, 0.2} : Double3{0.4, 0.1, 0.2}, {0.4, 0.4, 0.2});
  const int substeps = longRun ? 100000 : 5000;
  small.solver.time_step = 1.0 / 3840;
  small.solver.tolerance = 0;
  StressCase c = make(std::to_string(substeps) + "-steps", "energy does not drift; a second run gives the same bits", small);
  c.duration_s = substeps / 3840.0;
  c.checksRepeat = true;
  c.frame_s = 1.0 / 60;
  c.fullOnly = longRun;
  return c;
}

}  // namespace

std::vector<StressCase> forceCases() {
  std::vector<StressCase> cases;
  for (const double step : {0.1, 1.0}) cases.push_back(oneSubstepPerFrame(step));
  cases.push_back(weightless10S());
  cases.push_back(gravity1000());
  cases.push_back(gravityFlips());
  cases.push_back(scaled("spacing-0.05-mm", 5e-5));
  cases.push_back(scaled("spacing-50-m", 50));
  cases.back().fullOnly = true;
  cases.push_back(originAt10Km());
  cases.push_back(column100Layers());
  cases.push_back(crushedTo80Percent());
  cases.push_back(boxThatClosesOnAWall());
  for (const bool sheet : {false, true}) cases.push_back(shakenCup(sheet));
  for (const bool longRun : {false, true}) cases.push_back(manySteps(longRun));
  return cases;
}

std::vector<StressCase> sizeCases() {
  std::vector<StressCase> cases;
  const auto line = [](uint64_t count) {
    // A long tank with a narrow cross section.
    std::vector<Float3> points;
    points.reserve(count);
    const uint64_t across = count < 5000 ? 8 : 64, layer = across * across;
    for (uint64_t k = 0; k < count; ++k)
      points.push_back({static_cast<float>(0.05 * (double(k / layer) + 0.5)),
                        static_cast<float>(0.05 * (double(k / across % across) + 0.5)),
                        static_cast<float>(0.05 * (double(k % across) + 0.5))});
    return points;
  };
  const auto sized = [&](uint64_t count, bool longRun) {
    const double across = count < 5000 ? 0.4 : 3.2, length = std::max(1.0, 0.05 * double(count) / (across / 0.05 * across / 0.05) + 1);
    const Scene tank = tankScene(0.05, {0, 0, 0}, {length, across, across});
    StressCase c{.name = "count-" + std::to_string(count), .asserts = "", .scene = tank};
    c.start = particlesAt(line(count));
    c.maxSpeed = speedBound(tank);
    c.duration_s = longRun ? 1.0 / 240 : 1.0 / 60;
    c.frame_s = c.duration_s;
    c.fullOnly = longRun;
    c.mayBeRejected = count > 4'194'304;  // where memory is short
    return c;
  };
  for (const uint64_t count : {0, 1, 63, 64, 65, 4095, 4096, 4097}) {
    cases.push_back(sized(count, false));
    cases.back().fullOnly = count == 63 || count == 4095;
  }
  // Limits: a list buffer of 128 MiB, lavapipe's largest, in whole blocks; 65,535 workgroups of 64; more than 4 x 2^20.
  const uint64_t block = uint64_t{kListBlock} * listCapacity(Scene{}.fluid.smoothing_ratio + kListSkin, true) * kListEntryBytes,
                 buffer = (uint64_t{1} << 27) / block * kListBlock;
  for (const uint64_t count :
       {buffer - 1, buffer, buffer + 1, uint64_t{4'194'240}, uint64_t{4'194'241}, uint64_t{4'194'304}, uint64_t{4'194'305}})
    cases.push_back(sized(count, true));
  return cases;
}

}  // namespace rill::bench
