#pragma once
// The lattices that box and sphere fills stand for.
#include <cstdint>
#include <span>

#include "rill/scene.hpp"

namespace rill {

/// A box or sphere fill at one spacing. Points are at first + index x spacing on each axis.
struct Lattice {
  double first[3] = {0, 0, 0};  ///< m, in the scene's coordinates
  double along[3] = {0, 0, 0};  ///< points an axis: whole numbers, kept as doubles since a scene may ask for more than 64 bits hold
  double spacing = 0;           ///< m
  double radius = -1;           ///< m, of a sphere about the lattice's center; negative: a box

  double boxCount() const { return along[0] * along[1] * along[2]; }
};

/// The lattice of a fill's box or sphere.
Lattice latticeOf(const Fill& fill, double spacing);

/// How many of the lattice's points belong to the fill; exact for a box, and for a sphere of at most `exactRows` rows of points
/// (a larger one is estimated by its volume, to about one part in a thousand).
double countPoints(const Lattice& lattice, double exactRows);

/// Points of row (j, k) of the lattice that belong to the fill: from `begin` up to `end`.
void rowOf(const Lattice& lattice, uint64_t j, uint64_t k, uint64_t& begin, uint64_t& end);

/// The spacing at which the lattices of `fills` have nearly `target` points (within two per cent of the nearest count that any
/// spacing gives) and fit their boxes well. 0 where no fill is a box or a sphere. Depends on nothing but its arguments.
double spacingFor(std::span<const Fill> fills, double target);

}  // namespace rill
