#pragma once
// The fills of a scene as sources of particles: files and lattices, and where they lie.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "fill/lattice.hpp"
#include "fill/ply_reader.hpp"

namespace rill {

/// A fill and the particles that it describes.
struct FillSource {
  std::optional<PlyFile> file;
  PlyParticles particles;  ///< of the file; empty until it is read
  Lattice lattice;
  double count = 0;  ///< including those left out later
  uint64_t overlap = 0, solid = 0, domain = 0, kept = 0;
};

/// Axis-aligned bounds of particles; empty if low > high.
struct FillBounds {
  Double3 low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Double3 high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};

  bool empty() const { return low[0] > high[0]; }
  void add(double x, double y, double z) {
    const Double3 p = {x, y, z};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  bool near(const FillBounds& other, double distance) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] - other.high[axis] > distance || other.low[axis] - high[axis] > distance) return false;
    }
    return !empty() && !other.empty();
  }
};

FillBounds boundsOf(const FillSource& source);

/// Whether particles of different fills, or of one file, may be closer than allowed. Conservative.
bool mayOverlap(std::span<const FillSource> sources, std::span<const FillBounds> bounds, double distance);

}  // namespace rill
