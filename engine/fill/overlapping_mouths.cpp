#include "fill/overlapping_mouths.hpp"

#include <algorithm>
#include <limits>

#include "core/vector_math.hpp"
#include "fill/mouth.hpp"

namespace rill {
namespace {

/// A mouth's points, and the least distance between two of them.
struct Samples {
  std::vector<Double3> points;
  double apart;
  Double3 center;
  double radius = 0;
};

Samples samplesAt(const Mouth& mouth, double spacing) {
  Samples s{.points = samplesOf(mouth, spacing), .apart = std::numeric_limits<double>::max(), .center = centerOf(mouth)};
  for (size_t i = 0; i < s.points.size(); ++i) {
    s.radius = std::max(s.radius, length(minus(s.points[i], s.center)));
    for (size_t k = 0; k < i; ++k) s.apart = std::min(s.apart, length(minus(s.points[i], s.points[k])));
  }
  if (s.points.size() == 1) s.apart = spacing;
  return s;
}

bool overlap(const Samples& a, const Samples& b) {
  // A point in a square lattice has a neighbor within 0.71 of the lattice's spacing; the nearest points of two mouths side by side are
  // half of both spacings apart.
  const double near = 0.75 * std::min(a.apart, b.apart);
  if (length(minus(a.center, b.center)) > a.radius + b.radius + near) return false;
  return std::ranges::any_of(a.points, [&](const Double3& p) {
    return std::ranges::any_of(b.points, [&](const Double3& q) { return length(minus(p, q)) < near; });
  });
}

bool openTogether(const Emitter& a, const Emitter& b) { return (!a.until || b.from < *a.until) && (!b.until || a.from < *b.until); }

}  // namespace

std::vector<std::string> overlappingMouths(const Scene& scene, double spacing) {
  std::vector<std::string> warnings;
  const std::vector<Emitter> emitters = emittersOf(scene);
  std::vector<Samples> samples;
  for (const Emitter& emitter : emitters) samples.push_back(samplesAt(mouthAt(emitter, 0), spacing));
  for (size_t i = 0; i < emitters.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      if (emitters[i].motion.size() > 1 || emitters[k].motion.size() > 1 || !openTogether(emitters[i], emitters[k])) continue;
      if (!overlap(samples[i], samples[k])) continue;
      warnings.push_back(emitterKey(scene, i) + ": its mouth overlaps that of " + emitterKey(scene, k) +
                         "; expected mouths apart, or open at other times: fluid of both in one place springs apart");
      break;
    }
  return warnings;
}

}  // namespace rill
