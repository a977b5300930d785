#include "views/flow_outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "fill/mesh_mouth.hpp"
#include "fill/mouth.hpp"
#include "shape/records.hpp"

namespace rill {
namespace {

using particle_view::LineRecord;

/// Lines of one frame, which keyframes may move.
class Outline {
 public:
  /// `center`: of the frame in the scene, m, relative to the origin.
  Outline(const Double3& center, uint32_t firstKey, uint32_t keyCount, std::vector<LineRecord>& lines) : lines_(lines) {
    const auto f = [](double value) { return static_cast<float>(value); };
    frame_ = {.firstKey = firstKey, .keyCount = keyCount, .centerX = f(center.x), .centerY = f(center.y), .centerZ = f(center.z)};
  }

  /// Ends relative to the center, m.
  void line(const Double3& from, const Double3& to) {
    LineRecord record = frame_;
    record.fromX = static_cast<float>(from.x), record.fromY = static_cast<float>(from.y), record.fromZ = static_cast<float>(from.z);
    record.toX = static_cast<float>(to.x), record.toY = static_cast<float>(to.y), record.toZ = static_cast<float>(to.z);
    lines_.push_back(record);
  }

  /// Around the center; `u` and `v`: two of its radii at a right angle, m.
  void circle(const Double3& u, const Double3& v) {
    constexpr int kParts = 32;
    Double3 last = u;
    for (int k = 1; k <= kParts; ++k) {
      const double angle = 2 * std::numbers::pi * k / kParts;
      const Double3 next = along(along({}, std::cos(angle), u), std::sin(angle), v);
      line(last, next);
      last = next;
    }
  }

  /// Around the center; `u` and `v`: to the middles of two of its sides, m.
  void rectangle(const Double3& u, const Double3& v) {
    const std::array<Double3, 4> corners = {along(u, 1, v), along(u, -1, v), along(along({}, -1, u), -1, v), along(along({}, -1, u), 1, v)};
    for (size_t k = 0; k < 4; ++k) line(corners[k], corners[(k + 1) % 4]);
  }

  void box(const Double3& half) {
    for (size_t axis = 0; axis < 3; ++axis)
      for (int which = 0; which < 4; ++which) {
        Double3 from = half;
        from[(axis + 1) % 3] *= (which & 1) != 0 ? -1 : 1;
        from[(axis + 2) % 3] *= (which & 2) != 0 ? -1 : 1;
        Double3 to = from;
        to[axis] = -half[axis];
        line(from, to);
      }
  }

 private:
  LineRecord frame_ = {};
  std::vector<LineRecord>& lines_;
};

/// With a line from the center in the direction of the flow. `outline`: in the frame of the mouth's pivot.
void addMouth(const Mouth& mouth, Outline outline) {
  std::visit(Overloaded{[&](const DiscMouth& disc) {
                          const Double3 normal = normalized(disc.normal), u = unitAcross(normal);
                          outline.circle(along({}, disc.radius, u), along({}, disc.radius, cross(normal, u)));
                          outline.line({}, along({}, disc.radius, normal));
                        },
                        [&](const RectMouth& rect) {
                          const Double3 normal = normalized(rect.normal), u = normalized(cross(normal, normalized(rect.up)));
                          outline.rectangle(along({}, rect.size.first / 2, u), along({}, rect.size.second / 2, cross(u, normal)));
                          outline.line({}, along({}, std::min(rect.size.first, rect.size.second) / 2, normal));
                        },
                        [&](const MeshMouth& mesh) {
                          const FlatMouth flat = flatMouth(mesh);
                          const Double3 center = minus(flat.center, mesh.translation);
                          const auto at = [&](const MouthPoint& p) { return along(along(center, p[0], flat.across), p[1], flat.up); };
                          for (const auto& [from, to] : flat.outline) outline.line(at(from), at(to));
                          outline.line(center, along(center, std::sqrt(flat.area / std::numbers::pi), flat.normal));
                        }},
             mouth);
}

}  // namespace

std::vector<LineRecord> flowOutlines(const Scene& scene, const Double3& origin, std::vector<KeyframeRecord>& keyframes) {
  std::vector<LineRecord> lines;
  for (const Emitter& emitter : emittersOf(scene)) {
    const auto first = static_cast<uint32_t>(keyframes.size());
    const std::vector<KeyframeRecord> motion = keyframeRecords(emitter.motion);
    keyframes.insert(keyframes.end(), motion.begin(), motion.end());
    addMouth(emitter.mouth, {minus(pivotOf(emitter.mouth), origin), first, static_cast<uint32_t>(motion.size()), lines});
  }
  for (const Drain& drain : scene.drains) {
    if (const auto* sphere = std::get_if<SphereShape>(&drain.shape)) {
      Outline outline(minus(sphere->center, origin), 0, 0, lines);
      const double r = sphere->radius;
      outline.circle({r, 0, 0}, {0, r, 0});
      outline.circle({0, r, 0}, {0, 0, r});
      outline.circle({0, 0, r}, {r, 0, 0});
      continue;
    }
    const auto& box = std::get<BoxShape>(drain.shape);
    const Double3 half = along({}, 0.5, minus(box.max, box.min));
    Outline(minus(along(box.min, 1, half), origin), 0, 0, lines).box(half);
  }
  if (!scene.domain || !scene.domain->outflow) return lines;
  const Domain& domain = *scene.domain;
  const unsigned side = sideBit(domain.outflow->side), across = 2 - side / 2;
  Double3 from = minus(domain.min, origin);
  from[side / 2] = (side % 2 == 1 ? domain.max : domain.min)[side / 2] - origin[side / 2];
  from.y += domain.outflow->level;
  Double3 way;
  way[across] = domain.max[across] - domain.min[across];
  Outline(from, 0, 0, lines).line({}, way);
  return lines;
}

}  // namespace rill
