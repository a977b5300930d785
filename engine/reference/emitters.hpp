#pragma once
// What leaves an emitter, in closed form and double precision, where nothing is in the way.
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "rill/scene.hpp"

namespace rill::reference {

/// A mouth and how fluid leaves it. Layers of `points` follow each other at `thickness`, so that the flow is at rest density.
struct EmitterSettings {
  glm::dvec3 center = {0, 0, 0};                  ///< what its motion turns it about, m
  std::vector<glm::dvec3> points;                 ///< of a layer in the mouth, relative to that, m
  glm::dvec3 velocity = {0, 0, 0};                ///< at which particles leave, relative to the mouth, m/s
  double rate = 0;                                ///< layers a second, > 0
  double from = 0, until = 0;                     ///< s
  std::vector<Keyframe> motion = {};              ///< of the mouth
  glm::dvec3 arm = {0, 0, 0};                     ///< m, from `center` to the middle of the mouth
  glm::dvec3 across = {1, 0, 0}, up = {0, 1, 0};  ///< unit vectors of the mouth's plane
  uint32_t shape = 0;                             ///< as EmitterRecord has it
  double halfAcross = 0, halfUp = 0;              ///< m, half its size; of a disc its radius
  double motionSpeed = 0;                         ///< m/s, at most, of the mouth's own motion
};

/// How the frame of a mouth moves.
struct MouthFrame {
  glm::dvec3 center, velocity, angularVelocity;  ///< m, m/s, 1/s
  glm::dquat rotation;
};

/// At time `t` (s).
MouthFrame mouthFrame(const EmitterSettings& emitter, double t);

struct Birth {
  double time = 0;                  ///< s
  glm::dvec3 position = {0, 0, 0};  ///< m, at the asked time
  glm::dvec3 velocity = {0, 0, 0};  ///< m/s
};

/// All births up to time `t` (s), where gravity (m/s^2) alone acts on them, in the order of time. Layer k is born when half of it has
/// left the mouth, where the mouth is then, with its velocity in addition.
std::vector<Birth> births(const EmitterSettings& emitter, double t, const glm::dvec3& gravity);

}  // namespace rill::reference
