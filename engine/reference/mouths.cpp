#include "reference/mouths.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "shared/flow_records.h"

namespace rill::reference {
namespace {

/// An open mouth.
struct Mouth {
  MouthFrame frame;
  glm::dvec3 normal, across, up;
  double thickness = 0;  ///< m, of a layer
  double phase = 0;      ///< of the layer that leaves next, in layers
  double strength = 0;
};

std::optional<Mouth> openMouth(const EmitterSettings& e, double t) {
  if (!(e.rate > 0) || t <= e.from || t > e.until) return std::nullopt;
  const double layers = e.rate * (t - e.from), speed = glm::length(e.velocity);
  const MouthFrame frame = mouthFrame(e, t);
  return Mouth{.frame = frame,
               .normal = frame.rotation * (e.velocity / speed),
               .across = frame.rotation * e.across,
               .up = frame.rotation * e.up,
               .thickness = speed / e.rate,
               .phase = std::min(0.5 + layers, 1.5),
               .strength = std::min(layers, 1.0)};
}

LineSample slab(const HalfSpace& halfSpace, double x, double low, double high) {
  const LineSample near = halfSpace(x - high), far = halfSpace(x - low);
  return {near.value - far.value, near.slope - far.slope};
}

}  // namespace

SolidSample densityOfMouth(const EmitterSettings& e, double t, const glm::dvec3& x, double spacing, const HalfSpace& halfSpace) {
  const std::optional<Mouth> mouth = openMouth(e, t);
  if (!mouth || mouth->thickness > double{kThickestLayer} * spacing) return {};
  const double back = -0.5 * std::min(mouth->thickness, spacing), front = (mouth->phase - 0.5) * mouth->thickness;
  if (front <= back) return {};
  const glm::dvec3 from = x - mouth->frame.center;
  const double across = glm::dot(from, mouth->across), up = glm::dot(from, mouth->up);
  const LineSample along = slab(halfSpace, glm::dot(from, mouth->normal), back, front);
  double beside = 0;    // density of the cross-section
  glm::dvec3 slope(0);  // and its gradient
  if (e.isDisc) {
    const double radius = std::hypot(across, up), around = 1 - 2 * halfSpace(e.halfAcross).value;
    const LineSample radial = slab(halfSpace, radius, -e.halfAcross, e.halfAcross);
    beside = around * radial.value;
    if (radius > 0) slope = around * radial.slope / radius * (across * mouth->across + up * mouth->up);
  } else {
    const LineSample wide = slab(halfSpace, across, -e.halfAcross, e.halfAcross), high = slab(halfSpace, up, -e.halfUp, e.halfUp);
    beside = wide.value * high.value;
    slope = wide.slope * high.value * mouth->across + wide.value * high.slope * mouth->up;
  }
  const glm::dvec3 gradient = mouth->strength * (along.slope * beside * mouth->normal + along.value * slope);
  return {.value = mouth->strength * along.value * beside, .gradient = {gradient.x, gradient.y, gradient.z}};
}

SolidSample unionOf(const SolidSample& a, const SolidSample& b) {
  SolidSample both = a;
  both.value += b.value * (1 - a.value);
  for (size_t axis = 0; axis < 3; ++axis) both.gradient[axis] = a.gradient[axis] * (1 - b.value) + b.gradient[axis] * (1 - a.value);
  return both;
}

Push pushOutOfMouth(const EmitterSettings& e, double t, const glm::dvec3& x, const glm::dvec3& v, double spacing, double dt) {
  const std::optional<Mouth> mouth = openMouth(e, t);
  if (!mouth) return {};
  const glm::dvec3 from = x - mouth->frame.center;
  const double speed = glm::length(e.velocity), thickness = std::min(mouth->thickness, spacing), along = glm::dot(from, mouth->normal);
  const double margin = e.isDisc ? spacing : 0.5 * spacing, across = glm::dot(from, mouth->across), up = glm::dot(from, mouth->up);
  const double forward = mouth->phase * thickness - along, backward = along + thickness, radius = std::hypot(across, up);
  const double besideAcross = e.halfAcross + margin - std::abs(across), besideUp = e.halfUp + margin - std::abs(up);
  const double aside = e.isDisc ? e.halfAcross + margin - radius : std::min(besideAcross, besideUp);
  const double depth = std::min({forward, backward, aside});
  if (depth <= 1e-5 * spacing) return {};
  glm::dvec3 direction = mouth->normal;
  if (depth == backward)
    direction = -mouth->normal;
  else if (depth != forward && e.isDisc)
    direction = radius > 0 ? (across * mouth->across + up * mouth->up) / radius : mouth->across;
  else if (depth != forward)
    direction = besideAcross < besideUp ? (across < 0 ? -1.0 : 1.0) * mouth->across : (up < 0 ? -1.0 : 1.0) * mouth->up;
  const glm::dvec3 own = mouth->frame.velocity + glm::cross(mouth->frame.angularVelocity, from);
  const double face = std::max(glm::dot(direction, mouth->normal) * speed, 0.0) + glm::dot(direction, own);
  return {direction * std::min(depth, 2 * (speed + glm::length(own)) * dt), direction * std::max(face - glm::dot(v, direction), 0.0)};
}

}  // namespace rill::reference
