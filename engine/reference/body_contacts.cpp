// Contacts of bodies with walls, solids and each other: which there are, their slips, and an iteration of their solve.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "reference/bodies.hpp"

namespace rill::reference {
namespace {

glm::dvec3 tangential(const glm::dvec3& v, const glm::dvec3& normal) { return v - glm::dot(v, normal) * normal; }

}  // namespace

void Bodies::findTouched() {
  for (RigidBody& body : bodies_) {
    body.touched.clear();
    const double reach = body.radius + contactMargin();
    for (size_t k = 0; k < solids_.size(); ++k)
      if (k != body.solid && surface_(k, poses_[k], body.predicted.center).distance <= reach) body.touched.push_back(k);
  }
}

Bodies::Partner Bodies::partnerOf(size_t solid, const glm::dvec3& at, double dt) const {
  const glm::dvec3 velocity = vec(velocityAt(poses_[solid], triple(at)));
  Partner partner{.name = static_cast<int>(solid),
                  .friction = solids_[solid].friction,
                  .restitution = solids_[solid].restitution,
                  .moved = dt * velocity,
                  .before = velocity};
  if (!isFree(solid)) return partner;
  const RigidBody& body = bodies_[index(solid)];
  partner.body = indexOf_[solid];
  partner.before = atRest_ ? glm::dvec3(0) : body.state.velocity + glm::cross(body.state.angularVelocity, at - body.predicted.center);
  return partner;
}

double Bodies::compliance(const Partner& partner, const glm::dvec3& at, const glm::dvec3& direction) const {
  if (partner.body < 0) return 0;
  const RigidBody& body = bodies_[static_cast<size_t>(partner.body)];
  const double w = mobility(body, at, direction);
  return w > 1e-6 / body.mass ? std::max(body.contacts, 1) * w : 0;
}

void Bodies::forEachContact(const RigidBody& body, const ContactPoint& point, double margin, double dt,
                            const std::function<void(const Contact&)>& visit) const {
  const Pose& pose = poses_[body.solid];
  const glm::dvec3 center = vec(pose.center) + vec(toScene(pose, point.center));
  const auto touch = [&](const Partner& own, const Partner& other, const glm::dvec3& at, const glm::dvec3& normal, double depth) {
    if (own.body >= 0 || other.body >= 0) visit({own, other, at, normal, depth});
  };
  for (int side = 0; side < 6; ++side) {
    const int a = side / 2;
    const bool upper = side % 2 == 1;
    const double depth = point.radius - (upper ? walls_.hi[a] - center[a] : center[a] - walls_.lo[a]);
    if (!(depth > -margin)) continue;
    glm::dvec3 normal(0);
    normal[a] = upper ? -1 : 1;
    const glm::dvec3 at = center - point.radius * normal;
    const Partner own = partnerOf(body.solid, at, dt);
    touch(own, {.name = static_cast<int>(solids_.size()) + side, .friction = own.friction}, at, normal, depth);
  }
  for (const size_t k : body.touched) {
    const SurfacePoint surface = surface_(k, poses_[k], center);
    const double depth = point.radius - surface.distance;
    if (!(depth > -margin)) continue;
    const glm::dvec3 at = center - point.radius * vec(surface.normal);
    touch(partnerOf(body.solid, at, dt), partnerOf(k, at, dt), at, vec(surface.normal), depth);
  }
}

void Bodies::countContacts(double dt) {
  for (RigidBody& body : bodies_) body.contacts = 0;
  for (RigidBody& body : bodies_)
    for (size_t p = 0; p < body.points.size(); ++p) {
      const Slip last = body.slips[p];
      Slip next;
      bool persists = false;
      forEachContact(body, body.points[p], contactMargin(), dt, [&](const Contact& c) {
        for (const Partner& partner : {c.own, c.other})
          if (partner.body >= 0) ++bodies_[static_cast<size_t>(partner.body)].contacts;
        if (persists) return;
        persists = last.partner == c.other.name && advanced_;
        glm::dvec3 slipped(0);
        if (persists) {
          slipped = tangential(last.slipped + lastStep_ * (c.own.before - c.other.before), c.normal);
          const double size = glm::length(slipped);
          if (size > last.limit) slipped *= last.limit / size;
        }
        next = {c.other.name, slipped, 0};
      });
      body.slips[p] = next;
    }
}

void Bodies::solveContacts(double dt, double gravity, bool first) {
  std::vector<Impulse> sums(bodies_.size());
  const auto add = [&](const Partner& partner, const glm::dvec3& impulse, const glm::dvec3& at) {
    if (partner.body < 0) return;
    const auto n = static_cast<size_t>(partner.body);
    sums[n].linear += impulse;
    sums[n].angular += glm::cross(at - bodies_[n].predicted.center, impulse);
  };
  for (RigidBody& body : bodies_)
    for (size_t p = 0; p < body.points.size(); ++p)
      forEachContact(body, body.points[p], 0, dt, [&](const Contact& c) {
        Slip& slip = body.slips[p];
        const glm::dvec3 moved = c.own.moved - c.other.moved;
        const double approach = -glm::dot(moved, c.normal), before = glm::dot(c.own.before - c.other.before, c.normal);
        double correction = std::min(c.depth, approach + separationSpeed_ * dt);
        const double restitution = std::max(c.own.restitution, c.other.restitution);
        if (before < -2 * dt * gravity) correction = std::max(correction, approach - restitution * before * dt);
        const double compliant = compliance(c.own, c.at, c.normal) + compliance(c.other, c.at, c.normal);
        if (compliant <= 0 || correction <= 0) return;
        const double impulse = correction / compliant;
        const bool continues = slip.partner == c.other.name;
        glm::dvec3 total = impulse * c.normal, along = tangential(moved + (continues ? slip.slipped : glm::dvec3(0)), c.normal);
        if (const double slipped = glm::length(along); slipped > 0) {
          along /= slipped;
          const double compliantAlong = compliance(c.own, c.at, along) + compliance(c.other, c.at, along);
          const double limit = std::sqrt(c.own.friction * c.other.friction) * impulse * compliantAlong;
          if (continues && first) slip.limit = limit;
          if (compliantAlong > 0) total -= std::min(slipped, limit) / compliantAlong * along;
        }
        add(c.own, total, c.at);
        add(c.other, -total, c.at);
      });
  for (size_t n = 0; n < bodies_.size(); ++n) {
    if (bodies_[n].held) continue;
    push(bodies_[n], sums[n], dt);
    poses_[bodies_[n].solid] = poseOf(bodies_[n], bodies_[n].predicted);
  }
}

}  // namespace rill::reference
