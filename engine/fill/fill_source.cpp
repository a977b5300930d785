#include "fill/fill_source.hpp"

#include <algorithm>

namespace rill {

FillBounds boundsOf(const FillSource& source) {
  FillBounds bounds;
  if (source.file) {
    for (const Double3& p : source.particles.positions) bounds.add(p.x, p.y, p.z);
  } else if (source.count > 0) {
    const Lattice& l = source.lattice;
    bounds.add(l.first[0], l.first[1], l.first[2]);
    bounds.add(l.first[0] + (l.size[0] - 1) * l.spacing, l.first[1] + (l.size[1] - 1) * l.spacing,
               l.first[2] + (l.size[2] - 1) * l.spacing);
  }
  return bounds;
}

bool mayOverlap(std::span<const FillSource> sources, std::span<const FillBounds> bounds, double distance) {
  constexpr size_t kMaxPairTests = 64;
  if (std::any_of(sources.begin(), sources.end(), [](const FillSource& s) { return s.file.has_value(); })) return true;
  if (sources.size() > kMaxPairTests) return true;
  for (size_t a = 0; a < sources.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      if (bounds[a].near(bounds[b], distance)) return true;
    }
  }
  return false;
}

}  // namespace rill
