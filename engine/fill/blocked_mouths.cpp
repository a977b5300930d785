#include "fill/blocked_mouths.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "core/words.hpp"
#include "fill/inside_solids.hpp"
#include "fill/mouth.hpp"
#include "fill/walls.hpp"

namespace rill {
namespace {

bool canMove(const Solid& solid) { return !solid.motion.empty() || solid.body || solid.driven > 0; }

/// What covers all points of the mouth; empty if a point is free.
struct Cover {
  std::set<size_t> solids;
  bool walls = false;
};

Cover coverOf(const Mouth& mouth, const Scene& scene, const InsideSolids& solids, double spacing) {
  Cover cover;
  for (const Double3& p : samplesOf(mouth, spacing)) {
    if (beyondWall(scene.domain, p, kWallSlack * spacing)) {
      cover.walls = true;
    } else if (const auto solid = solids.find(p, kWallSlack * spacing)) {
      cover.solids.insert(*solid);
    } else {
      return {};
    }
  }
  return cover;
}

std::string textOf(const Cover& cover, const Scene& scene, bool moves) {
  constexpr size_t kMaxNamed = 3;
  std::string where, until;
  size_t named = 0;
  for (const size_t solid : cover.solids) {
    if (named++ < kMaxNamed) where += (where.empty() ? "inside " : ", ") + elementPath("solids", solid);
    if (canMove(scene.solids[solid])) until = " until a solid moves away";
  }
  if (named > kMaxNamed) where += " and " + grouped(named - kMaxNamed) + " more solids";
  if (moves) until = " until it moves away";
  if (cover.walls) where += std::string(where.empty() ? "" : " and ") + "outside the domain's walls";
  return "its mouth is " + where + "; it is blocked" + until;
}

}  // namespace

std::vector<std::string> blockedMouths(const Scene& scene, double spacing) {
  std::vector<std::string> warnings;
  const std::vector<Emitter> emitters = emittersOf(scene);
  if (emitters.empty()) return warnings;
  const InsideSolids solids(scene.solids, spacing);
  for (size_t i = 0; i < emitters.size(); ++i) {
    const Emitter& emitter = emitters[i];
    const Cover cover = coverOf(mouthAt(emitter, 0), scene, solids, spacing);
    if (cover.walls || !cover.solids.empty())
      warnings.push_back(emitterKey(scene, i) + ": " + textOf(cover, scene, emitter.motion.size() > 1));
  }
  return warnings;
}

}  // namespace rill
