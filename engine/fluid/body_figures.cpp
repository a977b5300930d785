#include "fluid/body_figures.hpp"

#include "core/vector_math.hpp"
#include "shape/pose.hpp"

namespace rill {
namespace {

/// Twice the rotational energy, J.
double spin(const BodyRecord& r, const BodyMotion& m) {
  const Double3 w = toSolid({.rotation = m.rotation}, m.angularVelocity);
  const Double3 momentum = {r.inertiaXX * w.x + r.inertiaXY * w.y + r.inertiaZX * w.z,
                            r.inertiaXY * w.x + r.inertiaYY * w.y + r.inertiaYZ * w.z,
                            r.inertiaZX * w.x + r.inertiaYZ * w.y + r.inertiaZZ * w.z};
  return dot(w, momentum);
}

}  // namespace

BodyMotion motionOf(const BodyRecord& record, const Double3& origin) {
  const PoseRecord& s = record.state;
  BodyMotion motion{.solid = record.solid,
                    .stopped = record.stopped != 0,
                    .center = {origin.x + s.centerX, origin.y + s.centerY, origin.z + s.centerZ},
                    .rotation = {s.rotationX, s.rotationY, s.rotationZ, s.rotationW}};
  if (record.held != 0) return motion;  // its state has the velocity that it will be released with
  motion.velocity = {s.velocityX, s.velocityY, s.velocityZ};
  motion.angularVelocity = {s.angularX, s.angularY, s.angularZ};
  return motion;
}

BodyFigures figuresOf(std::span<const BodyRecord> records, const Double3& origin, const Double3& gravity) {
  BodyFigures figures;
  for (const BodyRecord& record : records) {
    const BodyMotion m = motionOf(record, origin);
    figures.kinetic_J += 0.5 * (record.mass * dot(m.velocity, m.velocity) + spin(record, m));
    figures.potential_J -= record.mass * dot(gravity, m.center);
    figures.momentum = along(figures.momentum, record.mass, m.velocity);
    figures.stopped += m.stopped;
  }
  return figures;
}

}  // namespace rill
