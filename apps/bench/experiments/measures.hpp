#pragma once
// Figures of a cloud of particles that the solver's own kernel cannot flatter. Double precision, on the CPU.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "bench/scenes.hpp"
#include "rill/offline.hpp"

namespace rill::bench {

/// Particles of one instant, in the order of their birth.
struct Cloud {
  std::vector<Point> position;  ///< m
  std::vector<Point> velocity;  ///< m/s
  double spacing = 0;           ///< m
  size_t size() const { return position.size(); }
};
Cloud cloudOf(const offline::Particles& particles, double spacing_m);

/// Who is within a radius of a point.
class NeighborGrid {
 public:
  /// `points` outlives the grid; no search goes beyond `reach_m`.
  NeighborGrid(std::span<const Point> points, double reach_m);
  /// Calls `visit(index, squared distance in m^2)` for every point within `radius_m` (<= reach) of `center`, one at the center too.
  void within(const Point& center, double radius_m, const std::function<void(size_t, double)>& visit) const;
  bool anyWithin(const Point& center, double radius_m) const;

 private:
  using Cell = std::array<int64_t, 3>;
  Cell cellOf(const Point& point) const;
  static uint64_t keyOf(const Cell& cell);
  std::span<const Point> points_;
  double cell_;
  std::vector<size_t> order_;                                       // indices, those of one key together
  std::unordered_map<uint64_t, std::pair<size_t, size_t>> ranges_;  // of order_
};

/// Walls and fluid: a box of which `closed` sides (bit order -x +x -y +y -z +z) are walls.
struct Walls {
  Point min{}, max{};
  unsigned closed = 0;
};
/// Of a scene; none closed without a domain.
Walls wallsOf(const Scene& scene);

/// Particles deep inside: farther than `reach_m` from every wall, and with fluid all around at that distance and at half of it (each of 26
/// points on either sphere has a particle within 1.25 spacings). No kernel decides who counts.
std::vector<size_t> deepBulk(const Cloud& cloud, const Walls& walls, double reach_m);

/// Density over rest density in a Wendland kernel of support `support_m`, at each of `of`. Scaled so that the cubic rest lattice reads 1.
std::vector<double> wideDensity(const Cloud& cloud, std::span<const size_t> of, double support_m);

/// Mean of the signed error of wideDensity over the deep bulk, for twice the support that the solver uses.
struct BulkDensity {
  double error = 0;                                ///< mean of rho / rho0 - 1; NaN without deep particles
  double spread = 0;                               ///< standard deviation over the particles
  size_t particles = 0;                            ///< that were deep
  std::vector<std::pair<double, double>> profile;  ///< height (m) and mean error, in bins of two spacings
};
BulkDensity bulkDensity(const Cloud& cloud, const Walls& walls, double solver_support_m);

/// Share of particles whose nearest neighbor is nearer than half a spacing.
double clumpedShare(const Cloud& cloud);

/// Mean height of the free surface over the floor at `floor_m`: of the particles within `min` and `max` in x that have nobody above them
/// (in a cone of 37 degrees around the vertical, two spacings long), center plus half a spacing. Heights under half of the highest are
/// no surface but a void, and left out. NaN without particles.
double surfaceLevel(const Cloud& cloud, double floor_m, double min_x_m, double max_x_m);

/// Farthest particle along +x with at least five others within two spacings (a lone drop is no front), plus half a spacing, m.
double frontAlongX(const Cloud& cloud);

/// Height of the wet column at the wall x = `wall_m`: within 1.5 spacings of it, in strips of two spacings along z, up from the floor in
/// bins of 1.5 spacings until one is empty; the highest particle below plus half a spacing; mean of the strips, m over `floor_m`.
double heightAtWall(const Cloud& cloud, double wall_m, double floor_m);

/// Root of the mean squared speed, m/s.
double rmsSpeed(const Cloud& cloud);
Point meanPosition(const Cloud& cloud);
Point meanVelocity(const Cloud& cloud);
/// Per unit of mass, about the mean position, m^2/s.
Point meanSpin(const Cloud& cloud);

}  // namespace rill::bench
