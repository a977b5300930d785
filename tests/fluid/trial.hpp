#pragma once
// What a test of the solver runs: a scene with its particles, and what it is made of.
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rill/fluid.hpp"
#include "support/random_cloud.hpp"

namespace rill::test {

/// As the device gets it.
inline Float3 narrow(const glm::dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// The three ways to gather neighbors. Storage is what GPUs run: its passes are merged, too.
enum class Gather { Texel, Storage, Grid };
inline constexpr Gather kGathers[] = {Gather::Texel, Gather::Storage, Gather::Grid};
/// All of them; the first alone where the environment has RILL_TEST_GATHERS=first: each takes pipelines of its own.
std::span<const Gather> gathersInTurn();
const char* nameOf(Gather gather);

/// A scene with its particles, and the fixed step that both solvers take.
struct Trial {
  Scene scene;
  Double3 origin = {0, 0, 0};                  ///< m
  std::vector<glm::dvec3> x, v;                ///< m and m/s, relative to the origin; `v` may be empty: at rest
  std::vector<uint8_t> fluids;                 ///< of the particles; empty: all of the first
  std::vector<glm::dvec4> concentration = {};  ///< of the first particles; others have not mixed
  double step = 1e-3;                          ///< s
  Gather gather = Gather::Texel;
  std::vector<BodyPull> pulls = {};  ///< of every advance
  uint32_t capacity = 0;             ///< 0: as many as there are particles
  bool loads = false;                ///< loads on solids are measured
  bool settle = false;               ///< the oracle finds the start's pressure, but parts no particles: what settles should fit its room
  std::optional<bool> mergePasses = {};  ///< without a value: with Gather::Storage
  bool stepwise = false;                 ///< each substep is an advance of its own: the noise damping pass then runs in every one

  double d() const { return scene.fluid.spacing; }
  Scene timedScene() const;  ///< with the step as its longest one
  ParticleSet particles() const;
};

/// Spacing 1/16 m, no walls, gravity; relaxation, regularization and warm start explicit, no artificial viscosity, a fixed step, no bound
/// on the speed to speak of.
Trial trial();
/// Walls from 0 to `size`.
void setWalls(Trial& trial, glm::dvec3 size, SideMask open = 0);

Solid ball(glm::dvec3 center, double radius);
Solid slab(glm::dvec3 low, glm::dvec3 high);

/// Points of a lattice, the first half a spacing from `from`, each moved by up to `jitter` spacings an axis.
std::vector<glm::dvec3> block(glm::ivec3 count, double d, glm::dvec3 from = glm::dvec3(0), double jitter = 0, unsigned seed = 1);
/// Adds particles where there is no solid.
void addOutsideSolids(Trial& trial, const std::vector<glm::dvec3>& points);

}  // namespace rill::test
