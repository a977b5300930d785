#pragma once
// Places the particles of fills.
#include <cstdint>
#include <span>
#include <vector>

#include "core/shares.hpp"
#include "fill/fill_source.hpp"
#include "fill/inside_solids.hpp"
#include "fill/point_hash.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

inline constexpr double kFillOverlap = 0.9;  // spacings: smallest distance between particles of two fills

/// Adds particles to a set, leaving out those outside the domain, inside solids, or overlapping others.
class ParticlePlacer {
 public:
  /// `mixes`: some particles start with a mixture.
  ParticlePlacer(const Scene& scene, ParticleSet& out, PointHash* placed, bool mixes)
      : scene_(scene),
        out_(out),
        solids_(scene.solids, scene.fluid.spacing),
        placed_(placed),
        spacing_(scene.fluid.spacing),
        mixes_(mixes),
        diffusing_(diffusingFluids(scene)) {}

  /// `p`: position in scene coordinates, m. `number`: index within the fill. `fluid`: index among the scene's fluids.
  /// `mixed`: what of each diffusing fluid is in it; null: it has not mixed.
  void add(const Double3& p, const Float3& velocity, size_t fill, uint64_t number, uint8_t fluid, FillSource& source,
           const Float4* mixed = nullptr);

 private:
  /// Position relative to the origin, clamped to closed walls against rounding.
  Float3 relative(const Double3& p) const;

  const Scene& scene_;
  ParticleSet& out_;
  InsideSolids solids_;
  PointHash* placed_;
  double spacing_;
  bool mixes_;
  std::vector<size_t> diffusing_;
};

/// Adds the particles of a fill.
void placeFill(const Scene& scene, size_t index, FillSource& source, ParticlePlacer& placer);

}  // namespace rill
