#pragma once
// What leaves an emitter, in closed form and double precision, where nothing is in the way.
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "rill/scene.hpp"

namespace rill::reference {

/// A mouth and how fluid leaves it. Layers of `points` follow each other at `thickness`, so that the flow is at rest density.
struct EmitterSettings {
  glm::dvec3 center = {0, 0, 0};      ///< of the mouth, m
  std::vector<glm::dvec3> points;     ///< of a layer in the mouth, relative to its center, m
  glm::dvec3 velocity = {0, 0, 0};    ///< at which particles leave, relative to the mouth, m/s
  double rate = 0;                    ///< layers a second, > 0
  double from = 0, until = 0;         ///< s
  std::vector<Keyframe> motion = {};  ///< of the mouth about its center
};

struct Birth {
  double time = 0;                  ///< s
  glm::dvec3 position = {0, 0, 0};  ///< m, at the asked time
  glm::dvec3 velocity = {0, 0, 0};  ///< m/s
};

/// All births up to time `t` (s), where gravity (m/s^2) alone acts on them, in the order of time. Layer k is born when half of it has
/// left the mouth, where the mouth is then, with its velocity in addition.
std::vector<Birth> births(const EmitterSettings& emitter, double t, const glm::dvec3& gravity);

}  // namespace rill::reference
