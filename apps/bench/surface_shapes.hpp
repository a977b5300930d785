#pragma once
// Surfaces whose depth and normal are known in every pixel, and particles that fill what is under them.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rill/float3.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill::bench {

/// View space: x right, y up, z away from the eye; lengths in spacings.
struct Truth {
  double depth = 0;
  double normal[3] = {0, 0, -1};  ///< towards the eye
};

/// How far from where they should be particles are, in spacings: along the surface, across it.
struct Jitter {
  double along = 0.25, across = 0.1;
};

class Shape {
 public:
  virtual ~Shape() = default;
  virtual std::string name() const = 0;
  /// Where the ray through (x, y, 1) meets it; false: nowhere.
  virtual bool hit(double x, double y, Truth& truth) const = 0;
  /// Positions in view space.
  virtual std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const = 0;
};

/// What the bench looks at from `distance` spacings away: a tilted plane, waves of 8 to 60 spacings, two balls, the corner of a box, a
/// round sheet of one layer over a fifth of the picture. `tangentX`, `tangentY`: of half the field of view.
std::vector<std::unique_ptr<Shape>> shapes(double distance, double tangentX, double tangentY);
/// A plane and waves that lean away at 50 degrees, for fields of view up to 1 / 1.8 of half a picture's width.
std::vector<std::unique_ptr<Shape>> tiltedShapes(double distance, double tangentX, double tangentY);
/// A wave that has moved on by `traveled` spacings, with the same particles in the same order: they ride up and down on it.
std::unique_ptr<Shape> traveledWave(double distance, double tangentX, double tangentY, double length, double traveled);

}  // namespace rill::bench
