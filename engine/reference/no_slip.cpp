// How viscous fluid sticks to solids, in the solve of viscosity, and to bodies, after it. The equations are in docs/notes/slip.md.
#include <glm/geometric.hpp>

#include "reference/solver.hpp"

namespace rill::reference {

std::vector<ReferenceSolver::Adhesion> ReferenceSolver::adhesions(std::span<const Pose> solids, double c, bool ofBodies) const {
  std::vector<Adhesion> all;
  for (size_t i = 0; i < size(); ++i)
    forEachSample(boundaryPlace_[i], solids, [&](size_t n, const SolidSample& own, const Image& image) {
      if (settings.solids[n].slip || settings.solids[n].body.has_value() != ofBodies) return;
      const glm::dvec3 at = image.of(boundaryPlace_[i]), sign = image.sign;
      const double distance = surfaceOf(n, solids[n], at).distance;
      const double length = settings.tabulated ? sampleNoSlip(noSlipTable_, halfSpace_.step, distance) : noSlipLength(kernel_, distance);
      const double strength = c * inverseMass(i) * pairViscosity(i, i) * glm::length(vec(own.gradient)) * length;
      if (strength > 0) all.push_back({i, n, strength, at, settings.noSlipWalls ? sign.x * sign.y * sign.z * sign : sign});
    });
  return all;
}

// An implicit step of the particles at bodies, and of these: v' = v + sum_k a_k (u'_k - v'), and each body's u' is what the reactions make
// of u. For the prediction of u' the other bodies of a particle keep their velocity.
void ReferenceSolver::noSlip(double c, double dt) {
  std::vector<Pose> solids = poses(time_ - dt, dt);
  const std::vector<Adhesion> all = adhesions(solids, c, true), held = adhesions(solids, c, false);
  const auto surface = [&](const Adhesion& a) { return vec(velocityAt(solids[a.solid], {a.at.x, a.at.y, a.at.z})); };
  std::vector<double> sum(size(), 1);
  const auto pulls = [&] {
    std::vector<glm::dvec3> pull = state.velocity;
    for (const Adhesion& a : all) pull[a.particle] += a.strength * a.reverse * surface(a);
    return pull;
  };
  for (const Adhesion& a : all) sum[a.particle] += a.strength;

  const std::vector<glm::dvec3> before = pulls();
  std::vector<Bodies::Held> stuck;
  for (const Adhesion& a : all) {
    const double others = sum[a.particle] - a.strength;
    const glm::dvec3 own = surface(a), free = (before[a.particle] - a.strength * a.reverse * own) / others;
    stuck.push_back({a.solid, mass() / inverseMass(a.particle) * a.strength * others / sum[a.particle], a.at, a.reverse * free - own});
  }
  for (size_t n = 0; n < solids.size(); ++n)
    if (bodies_.isFree(n) && !settings.solids[n].slip) solids[n] = bodies_.stuckPose(n, stuck);

  const std::vector<glm::dvec3> after = pulls();
  for (size_t i = 0; i < size(); ++i) state.velocity[i] = after[i] / sum[i];
  std::vector<Impulse> reactions(solids.size());
  for (const std::vector<Adhesion>* some : {&held, &all})
    for (const Adhesion& a : *some)
      for (std::vector<Impulse>* to : {&reactions, &impulses_})
        addTo(*to, solids, 1 / inverseMass(a.particle))(a.solid, a.strength * (surface(a) - a.reverse * state.velocity[a.particle]), a.at);
  bodies_.accelerate(reactions);
}

}  // namespace rill::reference
