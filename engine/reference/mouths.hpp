#pragma once
// What open mouths do to fluid beside them, in double precision, until their first layers are born: what has not left the mouth yet
// counts in the density, and keeps other particles out of its place. See docs/notes/flows.md.
#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "reference/emitters.hpp"
#include "reference/images.hpp"
#include "sph/half_space.hpp"
#include "sph/solid_scale.hpp"

namespace rill::reference {

/// F of sph/half_space.hpp.
using HalfSpace = std::function<LineSample(double distance)>;

/// What the fluid in the mouth displaces at `x` (m) at time `t` (s), without images behind walls; `spacing`: m.
SolidSample densityOfMouth(const EmitterSettings& emitter, double t, const glm::dvec3& x, double spacing, const HalfSpace& halfSpace);

/// The share of an image of the mouth that counts, which has x at `image`: of a mouth that reaches through a wall the part behind it counts
/// itself, so that its image fades within a spacing.
double shareOfMouthImage(const EmitterSettings& emitter, double t, const glm::dvec3& image, const Walls& walls, double spacing);

/// The density of two overlapping things as that of their union; `a` may be more than 1 where solids overlap.
SolidSample unionOf(const SolidSample& a, const SolidSample& b);

struct Push {
  glm::dvec3 displacement = {0, 0, 0};  ///< m
  glm::dvec3 velocity = {0, 0, 0};      ///< m/s, to be added
};

/// Out of the place of the layer that leaves next, for a particle with velocity `v`, at the end of a substep of `dt` (s).
Push pushOutOfMouth(const EmitterSettings& emitter, double t, const glm::dvec3& x, const glm::dvec3& v, double spacing, double dt);

}  // namespace rill::reference
