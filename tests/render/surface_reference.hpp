#pragma once
// The surface in double precision, from all particles on all rays, without grid, lists or culling: the oracle of the passes from depth
// to pixels.
#include <limits>
#include <vector>

#include "render/surface.hpp"
#include "render/surface_rig.hpp"

namespace rill::test {

/// A camera's samples in double precision: x and y across, z the depth, as SurfacePush has them.
struct Samples {
  explicit Samples(const surface::SurfacePush& camera);

  /// View space of a position as it is stored.
  Vector seen(const Float4& p) const;
  /// The ray through a point of the picture (pixels): its start, and a step of depth 1.
  struct Ray {
    Vector from, along;
    Vector at(double depth) const { return from + along * depth; }
  };
  Ray ray(double x, double y) const;
  Ray ray(int x, int y) const { return ray((x - int(push.margin) + 0.5) * push.step, (y - int(push.margin) + 0.5) * push.step); }
  /// m that a sample is wide at a depth.
  double side(double depth) const;
  double nearest() const;  ///< depth of the section with the near plane
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < columns && y < rows; }
  size_t index(int x, int y) const { return size_t(y) * size_t(columns) + size_t(x); }

  surface::SurfacePush push;
  int columns, rows;
};

class SurfaceReference {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  struct Place {
    double depth = kNone;
    Vector normal;  ///< in view space
  };

  enum class By { Planes, Depth };  ///< Depth: of a filter that leaves the spheres' depth as it is
  SurfaceReference(const surface::SurfacePush& push, const std::vector<Float4>& positions, By by);

  const Samples& samples() const { return samples_; }
  const std::vector<double>& hard() const { return hard_; }  ///< depth of the nearest sphere per sample
  size_t surfaceParticles() const { return centers_.size(); }
  const std::vector<Place>& smooth() const { return smooth_; }  ///< per sample
  /// Surface and coverage of a pixel, also for coverages below 0.5.
  struct Pixel {
    Place place;
    double coverage = 0;
  };
  Pixel pixel(uint32_t x, uint32_t y) const;
  bool closed(int x, int y) const;  ///< spheres leave no gap for two samples around this one

 private:
  struct Plane {
    Vector center, anchor, normal;
    bool ball = false;
  };
  struct Fit {
    double sum = 0;
    Vector mean;
    double values[3];
    Vector least;
  };
  struct Evaluation {
    double depth = kNone, coverage = 0, planeWeight = 0;
    Vector normal;
  };
  /// One of the four samples around a pixel.
  struct Corner {
    Place place;
    Vector point;
    double weight = 0, square = 0;  ///< in the mean; of the distance, samples
  };
  double spacingAt(double z) const;
  double hardRadius(double z) const;
  double sphere(const Vector& center, double radius, const Samples::Ray& ray) const;
  std::vector<Vector> picked(const std::vector<Vector>& centers) const;
  Fit fit(const std::vector<Vector>& centers, const Vector& own, double reach, const Vector* across) const;
  Plane plane(const std::vector<Vector>& centers, const Vector& own) const;
  Evaluation evaluateStep(const Samples::Ray& ray, double depth) const;
  Evaluation evaluate(const Samples::Ray& ray, double depth) const;
  double cover(const Samples::Ray& ray, double depth) const;
  Place sampleOfDepth(int x, int y) const;
  Vector difference(int x, int y, int dx, int dy) const;
  Evaluation evaluateByPlanes(const Samples::Ray& ray, double nearest, double farthest, double own, double filled) const;
  Evaluation evaluateByDepth(const Samples::Ray& ray, double nearest, double farthest, const Corner (&corners)[4], double filled) const;
  double share(double x, double y) const;  ///< share of the samples around that are covered; whole numbers are samples

  Samples samples_;
  std::vector<double> hard_;
  By by_;
  std::vector<Vector> centers_;  ///< of surface particles
  std::vector<Plane> planes_;
  std::vector<Place> smooth_;
};

}  // namespace rill::test
