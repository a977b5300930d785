#pragma once
// Figures of a particle cloud, independent of the solver's kernel. Computed on the CPU in double precision.
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

/// Particles of one instant, by id.
struct Cloud {
  std::vector<Double3> position;  ///< m
  std::vector<Double3> velocity;  ///< m/s
  double spacing = 0;             ///< m
  std::vector<float> share = {};  ///< of the first fluid that diffuses; empty if none does
  size_t size() const { return position.size(); }
};
Cloud cloudOf(const offline::Particles& particles, double spacing_m);

/// Radius search over points.
class NeighborGrid {
 public:
  /// `points` must outlive the grid; `reach_m` is the largest search radius.
  NeighborGrid(std::span<const Double3> points, double reach_m);
  /// Calls `visit(index, squared distance in m^2)` for every point within `radius_m` (<= reach) of `center`, including coincident ones.
  void within(const Double3& center, double radius_m, const std::function<void(size_t, double)>& visit) const;
  bool anyWithin(const Double3& center, double radius_m) const;

 private:
  using Cell = std::array<int64_t, 3>;
  Cell cellOf(const Double3& point) const;
  static uint64_t keyOf(const Cell& cell);
  std::span<const Double3> points_;
  double cell_;
  std::vector<size_t> order_;                                       // indices grouped by key
  std::unordered_map<uint64_t, std::pair<size_t, size_t>> ranges_;  // ranges of order_
};

/// A box whose `closed` sides (bits -x +x -y +y -z +z) are walls.
struct Walls {
  Double3 min{}, max{};
  unsigned closed = 0;
};
/// Walls of a scene; all sides are open without a domain.
Walls wallsOf(const Scene& scene);

/// Interior particles: farther than `reach_m` from every wall and surrounded by fluid (each of 26 points at that distance and at half of it
/// has a particle within 1.25 spacings).
std::vector<size_t> interiorParticles(const Cloud& cloud, const Walls& walls, double reach_m);

/// Relative density in a Wendland kernel of support `support_m` at the particles `indices`, calibrated to 1 on the cubic rest lattice.
std::vector<double> wideDensity(const Cloud& cloud, std::span<const size_t> indices, double support_m);

/// Mean signed error of wideDensity over the interior, for twice the solver's support.
struct BulkDensity {
  double error = 0;                                ///< mean of rho / rho0 - 1; NaN without interior particles
  double spread = 0;                               ///< standard deviation over the particles
  size_t particles = 0;                            ///< number of interior particles
  std::vector<std::pair<double, double>> profile;  ///< height (m) and mean error, in bins of two spacings
};
BulkDensity bulkDensity(const Cloud& cloud, const Walls& walls, double solver_support_m);

/// Fraction of particles whose nearest neighbor is nearer than half a spacing.
double clumpedFraction(const Cloud& cloud);

/// Mean height of the free surface over `floor_m` for x in [min, max]: surface particles have no others in an upward cone of 37 degrees and
/// two spacings; the surface is half a spacing above their centers. Excludes voids below half of the maximum. NaN without particles.
double surfaceLevel(const Cloud& cloud, double floor_m, double min_x_m, double max_x_m);

/// Position of the front along +x, m: the farthest particle with at least five others within two spacings, plus half a spacing.
double frontAlongX(const Cloud& cloud);

/// Height of the fluid at the wall x = `wall_m`, m over `floor_m`: mean over strips of two spacings along z of the highest particle below
/// the first empty bin of 1.5 spacings, plus half a spacing. Uses particles within 1.5 spacings of the wall.
double heightAtWall(const Cloud& cloud, double wall_m, double floor_m);

/// Root mean square speed, m/s.
double rmsSpeed(const Cloud& cloud);
Double3 meanPosition(const Cloud& cloud);
Double3 meanVelocity(const Cloud& cloud);
/// Angular momentum per unit of mass about the mean position, m^2/s.
Double3 meanAngularMomentum(const Cloud& cloud);

}  // namespace rill::bench
