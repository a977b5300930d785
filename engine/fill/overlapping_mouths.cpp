#include "fill/overlapping_mouths.hpp"

#include <algorithm>
#include <cmath>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "fill/mesh_mouth.hpp"
#include "fill/mouth.hpp"

namespace rill {
namespace {

/// Whether a point is in a mouth, or less than `spacing` before or behind it.
bool covers(const Mouth& mouth, const Double3& p, double spacing) {
  return std::visit(Overloaded{[&](const DiscMouth& disc) {
                                 const Double3 from = minus(p, disc.center);
                                 const double off = dot(from, normalized(disc.normal));
                                 return std::abs(off) < spacing && dot(from, from) - off * off < disc.radius * disc.radius;
                               },
                               [&](const RectMouth& rect) {
                                 const Double3 from = minus(p, rect.center), normal = normalized(rect.normal);
                                 const Double3 across = normalized(cross(normal, rect.up)), up = cross(across, normal);
                                 return std::abs(dot(from, normal)) < spacing && std::abs(dot(from, across)) < rect.size.first / 2 &&
                                        std::abs(dot(from, up)) < rect.size.second / 2;
                               },
                               [&](const MeshMouth& mesh) {
                                 const FlatMouth flat = flatMouth(mesh);
                                 const Double3 from = minus(p, flat.center);
                                 MouthGrid point{.first = {dot(from, flat.across), dot(from, flat.up)}};  // a lattice that has it alone
                                 for (size_t k = 0; k < 2; ++k) {
                                   if (point.first[k] < flat.low[k] || point.first[k] > flat.high[k]) return false;
                                   point.pitch[k] = 2 * (flat.high[k] - flat.low[k]);
                                 }
                                 return std::abs(dot(from, flat.normal)) < spacing && !pointsIn(flat, point).empty();
                               }},
                    mouth);
}

bool overlap(const Mouth& a, const Mouth& b, double spacing) {
  const auto reaches = [&](const Mouth& from, const Mouth& to) {
    return std::ranges::any_of(samplesOf(from, spacing), [&](const Double3& p) { return covers(to, p, spacing); });
  };
  return reaches(a, b) || reaches(b, a);
}

bool openTogether(const Emitter& a, const Emitter& b) { return (!a.until || b.from < *a.until) && (!b.until || a.from < *b.until); }

}  // namespace

std::vector<std::string> overlappingMouths(const Scene& scene, double spacing) {
  std::vector<std::string> warnings;
  const std::vector<Emitter> emitters = emittersOf(scene);
  for (size_t i = 0; i < emitters.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      if (emitters[i].motion.size() > 1 || emitters[k].motion.size() > 1 || !openTogether(emitters[i], emitters[k])) continue;
      if (!overlap(mouthAt(emitters[i], 0), mouthAt(emitters[k], 0), spacing)) continue;
      warnings.push_back(emitterKey(scene, i) + ": its mouth overlaps that of " + emitterKey(scene, k) +
                         "; expected mouths apart, or open at other times: what they emit starts compressed and accelerates apart");
      break;
    }
  return warnings;
}

}  // namespace rill
