#include "fill/overlapping_mouths.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "fill/mesh_mouth.hpp"
#include "fill/mouth.hpp"

namespace rill {
namespace {

/// The plane of a mouth, its outline in it, and points in it.
struct Outline {
  Double3 center, normal, across, up;
  double radius = 0;                        ///< m, of a circle around the center that encloses it
  std::function<bool(double, double)> has;  ///< coordinates in the plane, m
  std::vector<Double3> samples = {};
};

Outline outlineOf(const Mouth& mouth, double spacing) {
  Outline outline = std::visit(
      Overloaded{
          [](const DiscMouth& disc) {
            const Double3 normal = normalized(disc.normal), across = unitAcross(normal);
            const auto has = [r = disc.radius](double x, double y) { return x * x + y * y < r * r; };
            return Outline{disc.center, normal, across, cross(across, normal), disc.radius, has};
          },
          [](const RectMouth& rect) {
            const Double3 normal = normalized(rect.normal), across = normalized(cross(normal, rect.up));
            const auto has = [size = rect.size](double x, double y) {
              return std::abs(x) < size.first / 2 && std::abs(y) < size.second / 2;
            };
            return Outline{rect.center, normal, across, cross(across, normal), std::hypot(rect.size.first, rect.size.second) / 2, has};
          },
          [](const MeshMouth& mesh) {
            const FlatMouth flat = flatMouth(mesh);
            const auto has = [flat](double x, double y) {
              if (x < flat.low[0] || x > flat.high[0] || y < flat.low[1] || y > flat.high[1]) return false;
              // of this lattice no other point is within the bounds
              return !pointsIn(flat, {.pitch = {2 * (flat.high[0] - flat.low[0]), 2 * (flat.high[1] - flat.low[1])}, .first = {x, y}})
                          .empty();
            };
            double radius = 0;
            for (const auto& edge : flat.outline) radius = std::max(radius, std::hypot(edge[0][0], edge[0][1]));
            return Outline{flat.center, flat.normal, flat.across, flat.up, radius, has};
          }},
      mouth);
  outline.samples = samplesOf(mouth, spacing);
  return outline;
}

/// Whether a point of one mouth is in another, or less than `spacing` before or behind it.
bool reaches(const Outline& from, const Outline& to, double spacing) {
  return std::ranges::any_of(from.samples, [&](const Double3& p) {
    const Double3 off = minus(p, to.center);
    return std::abs(dot(off, to.normal)) < spacing && to.has(dot(off, to.across), dot(off, to.up));
  });
}

bool overlap(const Outline& a, const Outline& b, double spacing) {
  if (length(minus(a.center, b.center)) > a.radius + b.radius + spacing) return false;
  return reaches(a, b, spacing) || reaches(b, a, spacing);
}

bool openTogether(const Emitter& a, const Emitter& b) { return (!a.until || b.from < *a.until) && (!b.until || a.from < *b.until); }

}  // namespace

std::vector<std::string> overlappingMouths(const Scene& scene, double spacing) {
  std::vector<std::string> warnings;
  const std::vector<Emitter> emitters = emittersOf(scene);
  std::vector<Outline> outlines;
  for (const Emitter& emitter : emitters) outlines.push_back(outlineOf(mouthAt(emitter, 0), spacing));
  for (size_t i = 0; i < emitters.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      if (emitters[i].motion.size() > 1 || emitters[k].motion.size() > 1 || !openTogether(emitters[i], emitters[k])) continue;
      if (!overlap(outlines[i], outlines[k], spacing)) continue;
      warnings.push_back(emitterKey(scene, i) + ": its mouth overlaps that of " + emitterKey(scene, k) +
                         "; expected mouths apart, or open at other times: what they emit starts compressed and accelerates apart");
      break;
    }
  return warnings;
}

}  // namespace rill
