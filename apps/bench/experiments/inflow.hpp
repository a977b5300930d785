#pragma once
// Parts of the experiments with emitters: mouths and solids, and means over a part of the fluid.
#include "bench/experiments/measures.hpp"
#include "bench/scenes.hpp"

namespace rill::bench {

/// An emitter at x = `x_m` that fills low .. high (heights, m) and 0 .. wide along z, and flows along +x. In front of a wall: half a
/// spacing, since no center is nearer to a wall.
Emitter inflowAlongX(double x_m, double low_m, double high_m, double wide_m, double speed_m_s);
Solid boxSolid(const Double3& min, const Double3& max, bool slip = true);

/// Means over the particles with x in a range and y above a floor.
struct SlabMeans {
  double particles = 0;
  double height_m = 0;     ///< of the centers, over the floor
  Double3 velocity_m_s{};  ///< NaN without particles, as is the height
  /// Of u^2 - v^2, u along x and v along y: over the square of the mean u it is the flow's momentum over that of uniform speed, less
  /// what vertical motion takes from the pressure.
  double momentum_m2_s2 = 0;
  /// Depth of a column of uniform density: twice the height of its center of mass. Unlike a level it needs no half spacing on top.
  double depth() const { return 2 * height_m; }
};
SlabMeans slabMeans(const Cloud& cloud, double min_x_m, double max_x_m, double floor_m);

/// A mean over instants; NaN without one.
class TimeMean {
 public:
  void add(double value) { sum_ += value, ++count_; }
  double value() const { return sum_ / count_; }

 private:
  double sum_ = 0, count_ = 0;
};

}  // namespace rill::bench
