#include "view/touch.hpp"

#include <algorithm>
#include <cmath>

#include "views/bounds.hpp"

namespace rill::view {
namespace {

constexpr double kBall = 0.06;        // radius of the pushing ball, of the scene's longest side
constexpr double kMinBall = 2.5;      // spacings
constexpr double kThrown = 1.2;       // radius of thrown balls, of that radius
constexpr double kPickRadius = 0.75;  // spacings: above 0.71 the spheres of a lattice leave no gap

struct Box {
  Double3 low{}, high{};
  double longest() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }
};

/// The domain, or the bounds of the fluid at the start, extended by their longest side.
Box boxOf(const Session& session) {
  Box room{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  const auto& domain = session.scene().domain;
  const Bounds& fluid = session.runner().firstBounds();
  if (!domain && fluid.empty()) return room;
  for (size_t a = 0; a < 3; ++a) {
    room.low[a] = domain ? domain->min[a] : fluid.min[a];
    room.high[a] = domain ? domain->max[a] : fluid.max[a];
  }
  if (domain) return room;
  const double around = room.longest();
  for (size_t a = 0; a < 3; ++a) {
    room.low[a] -= around;
    room.high[a] += around;
  }
  return room;
}

}  // namespace

double Touch::maxSpeed(const Session& session) { return boxOf(session).longest(); }

double Touch::ballRadius(const Session& session) {
  return std::max(kBall * boxOf(session).longest(), kMinBall * session.scene().fluid.spacing);
}

Expected<bool> Touch::grab(Session& session, const CameraView& eye, const Ray& ray, Hold hold) {
  if (holds())
    if (auto released = release(session); !released) return released.error();
  Runner& runner = session.runner();
  std::vector<Solid> solids = session.scene().solids;
  std::vector<Pose> poses;
  for (uint32_t k = 0; k < solids.size(); ++k) poses.push_back(runner.pose(k));
  std::vector<Float3> positions;  // a solid can be grabbed through fluid
  if (hold == Hold::Fluid) {
    auto present = runner.positions();
    if (!present) return present.error();
    positions = std::move(*present);
  }
  const double spacing = session.scene().fluid.spacing;
  const auto picked = pick(ray, positions, runner.start().origin, kPickRadius * spacing, solids, poses);
  if (!picked || picked->solid.has_value() != (hold == Hold::Solid)) return false;

  point_ = ray.at(picked->distance);
  offset_ = {};
  const double speed = maxSpeed(session);
  uint32_t held = static_cast<uint32_t>(solids.size());
  if (picked->solid) {
    held = *picked->solid;
    for (size_t a = 0; a < 3; ++a) offset_[a] = poses[held].center[a] - point_[a];
    if (solids[held].driven != speed) {
      Double3 moved = poses[held].center;
      for (size_t a = 0; a < 3; ++a) moved[a] -= solidPose(solids[held], 0).center[a];
      translate(solids[held], moved);
      solids[held].rotation = poses[held].rotation;
      solids[held].motion.clear();
      solids[held].driven = speed;
      if (auto done = session.changeSolids(std::move(solids)); !done) return done.error();
    }
  } else {
    const double radius = ballRadius(session);
    const auto before = ray.at(picked->distance - radius - spacing);
    Solid ball;
    ball.shape = SphereShape{before, radius};
    ball.driven = speed;
    solids.push_back(ball);
    if (auto done = session.changeSolids(std::move(solids)); !done) return done.error();
  }
  ball_ = !picked->solid;
  solid_ = held;
  drag(session, eye, ray);
  return true;
}

void Touch::drag(Session& session, const CameraView& eye, const Ray& ray) {
  if (!solid_) return;
  normal_ = cameraBasis(eye).forward;
  const auto distance = hitPlane(ray, point_, normal_);
  if (!distance) return;
  point_ = ray.at(*distance);
  session.runner().setTarget({*solid_, {point_[0] + offset_[0], point_[1] + offset_[1], point_[2] + offset_[2]}});
}

Expected<void> Touch::release(Session& session) {
  if (!solid_) return {};
  solid_.reset();
  session.runner().clearTargets();
  if (!ball_) return {};
  std::vector<Solid> solids = session.scene().solids;
  solids.pop_back();
  return session.changeSolids(std::move(solids));
}

Expected<uint64_t> Touch::throwFluid(Session& session, const Ray& ray) {
  const Box room = boxOf(session);
  const double spacing = session.scene().fluid.spacing;
  const double shortest = std::min({room.high[0] - room.low[0], room.high[1] - room.low[1], room.high[2] - room.low[2]});
  const double radius = std::min(kThrown * ballRadius(session), 0.5 * shortest - spacing);
  const auto enters = entry(ray, room.low, room.high);
  if (!enters || radius <= 0) return Error{ErrorKind::BadInput, "There is no room for fluid there; point into the tank"};
  Fill fill;
  auto& sphere = fill.shape.emplace<SphereShape>();
  sphere.radius = radius;
  const auto inside = ray.at(*enters + radius);
  const double speed = maxSpeed(session);
  for (size_t a = 0; a < 3; ++a) {
    sphere.center[a] = std::clamp(inside[a], room.low[a] + radius + spacing, room.high[a] - radius - spacing);
    fill.velocity[a] = speed * ray.along[a];
  }
  return session.add(fill);
}

}  // namespace rill::view
