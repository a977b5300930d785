#pragma once
// A scene's fills as particles: what a fluid starts from.
//
//   rill::Scene scene;
//   scene.fluid.spacing = 0.04;
//   scene.fill = {rill::Fill{.sphere = rill::SphereShape{{0, 1, 0}, 0.3}}};
//   auto particles = rill::makeParticles(scene);
//   if (!particles) return fail(particles.error().message);
#include <cstdint>
#include <string>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/float3.hpp"
#include "rill/scene.hpp"

namespace rill {

/// Of one Fluid.
inline constexpr uint64_t kMaxParticles = uint64_t{4} << 20;

/// The particles that a scene's fills make, in the order of the fills: what a simulation starts from.
/// Positions are relative to `origin` (the domain's minimum, or the fluid's center rounded to whole spacings), so that a scene far from
/// zero loses no precision.
struct ParticleSet {
  double origin[3] = {0, 0, 0};         ///< m
  std::vector<Float3> positions = {};   ///< m, relative to origin
  std::vector<Float3> velocities = {};  ///< m/s
  uint64_t left_out_overlap = 0;        ///< nearer than 0.9 spacings to an earlier one
  uint64_t left_out_solid = 0;          ///< inside a solid
  uint64_t left_out_domain = 0;         ///< outside the walls
  std::vector<std::string> warnings = {};
};

/// The scene's fills as particles (see ParticleSet), PLY files read. The spacing follows from `fluid.particles` where that is given
/// (`scene.fluid.spacing` is set then). BadInput where a file cannot be read, or a fill was given and no particle is left.
/// Counts are computed in 64 bits and checked against `maxParticles` before anything is allocated.
RILL_API Expected<ParticleSet> makeParticles(Scene& scene, uint64_t maxParticles = kMaxParticles);

}  // namespace rill
