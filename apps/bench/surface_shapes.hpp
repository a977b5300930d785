#pragma once
// Analytic surfaces with known depth and normal per pixel, and particles that fill the fluid below them.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rill/fluid_renderer.hpp"
#include "rill/vectors.hpp"

namespace rill::bench {

/// Analytic depth and normal at a pixel. View space: x right, y up, z away from the eye; lengths in spacings.
struct ReferencePoint {
  double depth = 0;
  Double3 normal = {0, 0, -1};  ///< unit length, towards the eye
};

/// Largest random displacement of particles along the surface and along its normal, spacings.
struct Jitter {
  double tangential = 0.25, normal = 0.1;
};

class Shape {
 public:
  virtual ~Shape() = default;
  virtual std::string name() const = 0;
  /// Intersects the ray through (x, y, 1); false if it misses.
  virtual bool intersect(double x, double y, ReferencePoint& reference) const = 0;
  /// Positions in view space.
  virtual std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const = 0;
};

/// The shapes at `distance` spacings: a tilted plane, waves of 8 to 60 spacings, two balls, a box corner, a round sheet of one layer
/// that covers a fifth of the picture, and a bent one with a hole.
std::vector<std::unique_ptr<Shape>> shapes(double distance, double tanHalfFovX, double tanHalfFovY);
/// A plane and waves seen at 50 degrees. Requires tanHalfFovX <= 1 / 1.8.
std::vector<std::unique_ptr<Shape>> tiltedShapes(double distance, double tanHalfFovX, double tanHalfFovY);
/// A wave displaced by `traveled` spacings, with the same particles in the same order for every displacement: they follow its height.
std::unique_ptr<Shape> travelingWave(double distance, double tanHalfFovX, double tanHalfFovY, double length, double traveled);

}  // namespace rill::bench
