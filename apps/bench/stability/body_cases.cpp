// Rigid bodies where contacts and coupling are hard: overlaps, extreme masses and speeds, many of them.
#include <cmath>

#include "bench/mesh_shapes.hpp"
#include "bench/stability/stress_case.hpp"

namespace rill::bench {
namespace {

Solid crate(const Double3& center, double edge, double density, const Double3& velocity = {0, 0, 0}) {
  const double half = edge / 2;
  return {.shape = BoxShape{{center.x - half, center.y - half, center.z - half}, {center.x + half, center.y + half, center.z + half}},
          .friction = 0.4,
          .body = Body{.density = density, .velocity = velocity}};
}

std::string checkBodies(const StressOutcome& o) {
  const BodyFigures& bodies = o.run.instants.back().stats.bodies.value_or(BodyFigures{});
  if (!std::isfinite(bodies.kinetic_J) || !std::isfinite(bodies.potential_J))
    return "energy of bodies: found " + number(bodies.kinetic_J) + " J";
  return bodies.stopped > 0 ? std::to_string(bodies.stopped) + " bodies were stopped" : std::string();
}

StressCase bodyCase(std::string name, std::vector<Solid> solids, double speed) {
  StressCase c{
      .name = std::move(name), .asserts = "bodies stay finite and are not lost", .scene = tankScene(kTankSpacing, {1, 0.4, 1}, {1, 1, 1})};
  c.scene.solids = std::move(solids);
  c.maxSpeed = speedBound(c.scene, speed);
  c.externalWork = true;
  c.check = checkBodies;
  return c;
}

std::vector<Solid> swarm(int edge, double spacing, double size) {
  std::vector<Solid> all;
  all.reserve(static_cast<size_t>(edge) * edge * edge);
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y)
      for (int x = 0; x < edge; ++x)
        all.push_back(crate({spacing * (0.5 + x), spacing * (0.5 + y), spacing * (0.5 + z)}, size, 300 + 200 * ((x + y + z) % 7)));
  return all;
}

}  // namespace

std::vector<StressCase> bodyCases() {
  std::vector<StressCase> cases;
  cases.push_back(bodyCase("bodies-overlapping",
                           {crate({0.5, 0.3, 0.5}, 0.3, 500), crate({0.5, 0.3, 0.5}, 0.3, 500), crate({0.6, 0.4, 0.5}, 0.2, 2000)}, 5));
  cases.push_back(bodyCase("bodies-in-walls", {crate({0, 0.1, 0.5}, 0.3, 500), crate({1, 0.9, 1}, 0.3, 500)}, 5));
  cases.back().fullOnly = true;
  cases.push_back(bodyCase("body-larger-than-the-domain", {crate({0.5, 1.45, 0.5}, 2.5, 500)}, 40));
  cases.back().fullOnly = true;
  for (const double ratio : {1e-3, 1e3}) {
    cases.push_back(bodyCase("body-of-" + number(ratio) + "-of-water", {crate({0.5, 0.4, 0.5}, 0.3, 1000 * ratio)}, 40));
    cases.back().fullOnly = ratio > 1;
  }
  cases.push_back(bodyCase("bodies-mass-ratio-1e6", {crate({0.5, 0.2, 0.5}, 0.3, 1), crate({0.5, 0.52, 0.5}, 0.3, 1e6)}, 40));
  cases.back().fullOnly = true;
  {  // of almost no volume; what has none is refused when the mesh is made
    auto plate = Mesh::create(boxMesh({-0.2, -0.001, -0.2}, {0.2, 0.001, 0.2}));
    const Solid solid{.shape = MeshShape{.mesh = plate ? *plate : nullptr}, .translation = {0.5, 0.6, 0.5}, .body = Body{.density = 500}};
    cases.push_back(bodyCase("body-of-a-thin-mesh", {solid}, 40));
  }
  cases.push_back(bodyCase("body-at-100-m-s", {crate({0.3, 0.7, 0.5}, 0.2, 500, {100, 0, 0})}, 200));
  cases.back().duration_s = 0.1;
  {
    Solid locked = crate({0.5, 0.3, 0.5}, 0.3, 500);
    locked.body->locked = 0b111111;
    cases.push_back(bodyCase("body-locked", {locked, crate({0.5, 0.6, 0.5}, 0.2, 500)}, 5));
    cases.back().fullOnly = true;
  }
  cases.push_back(bodyCase("bodies-gravity-flips", {crate({0.3, 0.5, 0.5}, 0.25, 200), crate({0.7, 0.5, 0.5}, 0.25, 3000)}, 10));
  cases.back().fullOnly = true;
  cases.back().scene.gravity_changes = {{0.2, {0, 9.81, 0}}, {0.35, {20, -9.81, 5}}};
  cases.push_back(bodyCase("bodies-4096", swarm(16, 1.0 / 16, 0.05), 20));
  cases.back().duration_s = 0.03;
  cases.back().fullOnly = true;
  return cases;
}

}  // namespace rill::bench
