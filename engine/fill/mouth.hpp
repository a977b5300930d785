#pragma once
// The mouths of emitters as sets of points, and their flow.
#include <string>
#include <vector>

#include "rill/scene.hpp"
#include "shape/pose.hpp"

namespace rill {

/// m^2.
double areaOf(const Mouth& mouth);
/// m, scene coordinates; of a mesh its centroid.
Double3 centerOf(const Mouth& mouth);
/// What its motion turns it about, m, scene coordinates: the center, of a mesh its origin.
Double3 pivotOf(const Mouth& mouth);
/// m^3/s, from `flow` or `speed`.
double flowOf(const Emitter& emitter);

/// The frame of the mouth's pivot at `t` (s); without motion its axes are those of the scene.
Pose mouthPose(const Emitter& emitter, double t);
/// The mouth as its motion leaves it at `t` (s).
Mouth mouthAt(const Emitter& emitter, double t);
/// Bounds the speed of every point of the mouth over its motion, m/s; 0 without motion.
double fastestMouth(const Emitter& emitter);

/// The scene's emitters, then that of the domain's inflow.
std::vector<Emitter> emittersOf(const Scene& scene);
/// The key of one of them, for messages.
std::string emitterKey(const Scene& scene, size_t emitter);

/// Points inside the mouth, about `spacing` (m) apart but at most 16 along each direction; at least one. m, scene coordinates.
std::vector<Double3> samplesOf(const Mouth& mouth, double spacing);

}  // namespace rill
