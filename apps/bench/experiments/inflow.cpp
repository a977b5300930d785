#include "bench/experiments/inflow.hpp"

namespace rill::bench {

Emitter inflowAlongX(double x_m, double low_m, double high_m, double wide_m, double speed_m_s) {
  return {
      .mouth =
          RectMouth{
              .center = {x_m, (low_m + high_m) / 2, wide_m / 2}, .size = {wide_m, high_m - low_m}, .normal = {1, 0, 0}, .up = {0, 1, 0}},
      .speed = speed_m_s};
}

Solid boxSolid(const Double3& min, const Double3& max, bool slip) { return {.shape = BoxShape{min, max}, .slip = slip}; }

SlabMeans slabMeans(const Cloud& cloud, double min_x_m, double max_x_m, double floor_m) {
  SlabMeans means;
  for (size_t i = 0; i < cloud.size(); ++i) {
    const Double3& x = cloud.position[i];
    if (x.x < min_x_m || x.x > max_x_m || x.y < floor_m) continue;
    ++means.particles;
    means.height_m += x.y - floor_m;
    const Double3& u = cloud.velocity[i];
    for (size_t axis = 0; axis < 3; ++axis) means.velocity_m_s[axis] += u[axis];
    means.momentum_m2_s2 += u.x * u.x - u.y * u.y;
  }
  means.height_m /= means.particles;
  means.momentum_m2_s2 /= means.particles;
  for (size_t axis = 0; axis < 3; ++axis) means.velocity_m_s[axis] /= means.particles;
  return means;
}

}  // namespace rill::bench
