#include "reference/mouths.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "shared/flow_records.h"

namespace rill::reference {
namespace {

/// An open mouth.
struct Mouth {
  MouthFrame frame;
  glm::dvec3 middle;
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
               .middle = frame.center + frame.rotation * e.arm,
               .normal = frame.rotation * (e.velocity / speed),
               .across = frame.rotation * e.across,
               .up = frame.rotation * e.up,
               .thickness = speed / e.rate,
               .phase = std::min(0.5 + layers, 1.5),
               .strength = std::min(layers, 1.0)};
}

/// Sideways out of a mouth that is a mesh, in its plane: away from the nearest of its points, unless others are there. Nothing if no
/// point is nearer than a spacing.
std::optional<glm::dvec2> outOfPoints(const EmitterSettings& e, const glm::dvec2& place, double spacing) {
  const auto fromNearest = [&](const glm::dvec2& at) {
    glm::dvec2 nearest(1e9);
    for (const glm::dvec3& point : e.points) {
      const glm::dvec2 from = at - glm::dvec2(glm::dot(point - e.arm, e.across), glm::dot(point - e.arm, e.up));
      if (glm::length(from) < glm::length(nearest)) nearest = from;
    }
    return nearest;
  };
  const glm::dvec2 from = fromNearest(place);
  const double apart = glm::length(from);
  if (apart >= spacing) return glm::dvec2(0);
  const glm::dvec2 outward = apart > 0 ? from * ((spacing - apart) / apart) : glm::dvec2(0);
  if (apart > 0 && glm::length(fromNearest(place + outward)) >= 0.8 * spacing) return outward;
  return std::nullopt;
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
  const glm::dvec3 from = x - mouth->middle;
  const double across = glm::dot(from, mouth->across), up = glm::dot(from, mouth->up);
  const LineSample along = slab(halfSpace, glm::dot(from, mouth->normal), back, front);
  double beside = 0;    // density of the cross-section
  glm::dvec3 slope(0);  // and its gradient
  const auto add = [&](double middleAcross, double middleUp, double halfAcross, double halfUp) {
    const LineSample wide = slab(halfSpace, across - middleAcross, -halfAcross, halfAcross);
    const LineSample high = slab(halfSpace, up - middleUp, -halfUp, halfUp);
    beside += wide.value * high.value;
    slope += wide.slope * high.value * mouth->across + wide.value * high.slope * mouth->up;
  };
  const double half = 0.5 * spacing * std::sqrt(spacing / mouth->thickness);  // of a square of the lattice
  if (e.shape == kRectMouth)
    add(0, 0, e.halfAcross, e.halfUp);
  else
    for (const glm::dvec3& point : e.points) add(glm::dot(point - e.arm, e.across), glm::dot(point - e.arm, e.up), half, half);
  const glm::dvec3 gradient = mouth->strength * (along.slope * beside * mouth->normal + along.value * slope);
  return {.value = mouth->strength * along.value * beside, .gradient = {gradient.x, gradient.y, gradient.z}};
}

double shareOfMouthImage(const EmitterSettings& e, double t, const glm::dvec3& image, const Walls& walls, double spacing) {
  const std::optional<Mouth> mouth = openMouth(e, t);
  if (!mouth) return 0;
  const glm::dvec3 back = -0.5 * std::min(mouth->thickness, spacing) * mouth->normal;
  const glm::dvec3 front = (mouth->phase - 0.5) * mouth->thickness * mouth->normal;
  const glm::dvec3 beside = e.halfAcross * glm::abs(mouth->across) + e.halfUp * glm::abs(mouth->up);
  double share = 1;
  for (int a = 0; a < 3; ++a) {
    const double low = mouth->middle[a] + std::min(back[a], front[a]) - beside[a];
    const double high = mouth->middle[a] + std::max(back[a], front[a]) + beside[a];
    const double through = image[a] < walls.lo[a] ? walls.lo[a] - low : image[a] > walls.hi[a] ? high - walls.hi[a] : 0;
    share *= 1 - std::clamp(through / spacing, 0.0, 1.0);
  }
  return share;
}

SolidSample unionOf(const SolidSample& a, const SolidSample& b) {
  SolidSample both = a;
  const double roomOfA = std::max(1 - a.value, 0.0), roomOfB = std::max(1 - b.value, 0.0);
  both.value += b.value * roomOfA;
  for (size_t axis = 0; axis < 3; ++axis) both.gradient[axis] = a.gradient[axis] * roomOfB + b.gradient[axis] * roomOfA;
  return both;
}

Push pushOutOfMouth(const EmitterSettings& e, double t, const glm::dvec3& x, const glm::dvec3& v, double spacing, double dt) {
  const std::optional<Mouth> mouth = openMouth(e, t);
  if (!mouth) return {};
  const glm::dvec3 from = x - mouth->middle;
  const double speed = glm::length(e.velocity), thickness = std::min(mouth->thickness, spacing), along = glm::dot(from, mouth->normal);
  const double forward = mouth->phase * thickness - along, backward = along + thickness;
  const double across = glm::dot(from, mouth->across), up = glm::dot(from, mouth->up);
  glm::dvec2 aside(0);  // in the mouth's plane
  if (e.shape == kDiscMouth) {
    const double radius = std::hypot(across, up), depth = e.halfAcross + spacing - radius;
    aside = std::max(depth, 0.0) * (radius > 0 ? glm::dvec2(across, up) / radius : glm::dvec2(1, 0));
  } else if (e.shape == kRectMouth) {
    const double besideAcross = e.halfAcross + 0.5 * spacing - std::abs(across), besideUp = e.halfUp + 0.5 * spacing - std::abs(up);
    if (besideAcross > 0 && besideUp > 0)
      aside = besideAcross < besideUp ? glm::dvec2(std::copysign(besideAcross, across), 0) : glm::dvec2(0, std::copysign(besideUp, up));
  } else {
    aside = outOfPoints(e, {across, up}, spacing).value_or(glm::dvec2(1e9));
  }
  const double depth = std::min({forward, backward, glm::length(aside)});
  if (depth <= 1e-5 * spacing) return {};
  glm::dvec3 direction = mouth->normal;
  if (depth == backward)
    direction = -mouth->normal;
  else if (depth != forward)
    direction = (aside.x * mouth->across + aside.y * mouth->up) / depth;
  const glm::dvec3 own = mouth->frame.velocity + glm::cross(mouth->frame.angularVelocity, x - mouth->frame.center);
  const double face = std::max(glm::dot(direction, mouth->normal) * speed, 0.0) + glm::dot(direction, own);
  return {direction * std::min(depth, 2 * (speed + glm::length(own)) * dt), direction * std::max(face - glm::dot(v, direction), 0.0)};
}

}  // namespace rill::reference
