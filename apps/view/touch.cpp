#include "view/touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "shape/mass.hpp"
#include "shared/solid_records.h"
#include "view/scene_box.hpp"

namespace rill::view {
namespace {

constexpr double kBall = 0.06;                  // radius of the pushing ball, of the scene's longest side
constexpr double kMinBall = 2.5;                // spacings
constexpr double kThrown = 1.2;                 // radius of thrown balls, of that radius
constexpr double kPull = 3;                     // Hz, of the spring that pulls bodies
constexpr double kMaxPull = 40;                 // m/s^2, what the spring may accelerate a body by, and
constexpr double kMaxWeights = 6;               // times gravity
constexpr double kCrate = 0.075;                // edge of thrown crates, of the scene's longest side
constexpr double kMinCrate = 5, kMaxCrate = 8;  // spacings
constexpr double kCrateDensity = 500;           // kg/m^3
constexpr int kMaxPlaces = 400;                 // along the ray, that are tried for a thrown crate
constexpr double kPickRadius = 0.75;            // spacings: above 0.71 the spheres of a lattice leave no gap

}  // namespace

double Touch::maxSpeed(const Session& session) { return sceneBox(session).longest(); }

double Touch::ballRadius(const Session& session) {
  return std::max(kBall * sceneBox(session).longest(), kMinBall * session.scene().fluid.spacing);
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
  if (picked->solid && solids[*picked->solid].body) {
    held = *picked->solid;
    const double gravity = length(session.scene().gravity);
    pull_ = {.solid = held,
             .point = localPoint(poses[held], point_),
             .frequency_Hz = kPull,
             .maxForce = massOf(solids[held]).mass * std::max(kMaxPull, kMaxWeights * gravity)};
  } else if (picked->solid) {
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
  kind_ = !picked->solid ? Grabbed::Ball : session.scene().solids[held].body ? Grabbed::Body : Grabbed::Other;
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
  if (kind_ == Grabbed::Body) {
    pull_.target = point_;
    session.runner().setPull(pull_);
    return;
  }
  session.runner().setTarget({*solid_, {point_[0] + offset_[0], point_[1] + offset_[1], point_[2] + offset_[2]}});
}

Expected<void> Touch::release(Session& session) {
  if (!solid_) return {};
  solid_.reset();
  session.runner().clearTargets();
  session.runner().clearPulls();
  if (kind_ != Grabbed::Ball) return {};
  std::vector<Solid> solids = session.scene().solids;
  solids.pop_back();
  return session.changeSolids(std::move(solids));
}

std::optional<std::array<Double3, 2>> Touch::pullLine(const Session& session) const {
  if (!solid_ || kind_ != Grabbed::Body) return std::nullopt;
  const Pose pose = session.runner().pose(*solid_);
  return std::array{along(pose.center, 1, toScene(pose, pull_.point)), pull_.target};
}

Expected<uint64_t> Touch::throwFluid(Session& session, const Ray& ray, const std::string& fluid) {
  const SceneBox room = sceneBox(session);
  const double spacing = session.scene().fluid.spacing;
  const double shortest = std::min({room.high[0] - room.low[0], room.high[1] - room.low[1], room.high[2] - room.low[2]});
  const double radius = std::min(kThrown * ballRadius(session), 0.5 * shortest - spacing);
  const auto enters = entry(ray, room.low, room.high);
  if (!enters || radius <= 0) return Error{ErrorKind::BadInput, "There is no room for fluid there; point into the tank"};
  Fill fill;
  fill.fluid = fluid;
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

double Touch::crateEdge(const Session& session) {
  const double spacing = session.scene().fluid.spacing;
  return std::clamp(kCrate * sceneBox(session).longest(), kMinCrate * spacing, kMaxCrate * spacing);
}

namespace {

/// What a cube would overlap; empty where there is room.
class Room {
 public:
  Room(const Session& session, std::vector<Float3> positions, double edge)
      : session_(session), positions_(std::move(positions)), half_(0.5 * edge) {
    for (uint32_t k = 0; k < session.scene().solids.size(); ++k) poses_.push_back(session.runner().pose(k));
  }
  /// m along the ray.
  double hit(const Ray& ray) const {
    const auto first = pick(ray, positions_, session_.runner().start().origin, kPickRadius * session_.scene().fluid.spacing,
                            session_.scene().solids, poses_);
    return first ? first->distance : std::numeric_limits<double>::infinity();
  }
  std::string obstacleAt(const Double3& center) const {
    const std::vector<Solid>& solids = session_.scene().solids;
    const double spacing = session_.scene().fluid.spacing;
    for (size_t k = 0; k < solids.size(); ++k) {
      const double shell = shellOf(solids[k].shape, spacing);
      if (surfaceAt(solids[k].shape, poses_[k], center).distance - shell < std::sqrt(3.0) * half_)
        return solids[k].name.empty() ? "solids[" + std::to_string(k) + "]" : "the solid " + inQuotes(solids[k].name);
    }
    const Double3& origin = session_.runner().start().origin;
    const double reach = half_ + 0.5 * spacing;
    for (const Float3& p : positions_)
      if (std::abs(p.x + origin.x - center.x) < reach && std::abs(p.y + origin.y - center.y) < reach &&
          std::abs(p.z + origin.z - center.z) < reach)
        return "fluid";
    return {};
  }

 private:
  const Session& session_;
  std::vector<Float3> positions_;
  std::vector<Pose> poses_;
  double half_;
};

}  // namespace

Expected<void> Touch::throwCrate(Session& session, const Ray& ray) {
  const auto refused = [](std::string why) { return Error{ErrorKind::BadInput, "A crate cannot be thrown there: " + std::move(why)}; };
  std::vector<Solid> solids = session.scene().solids;
  if (solids.size() >= kMaxSolids) return refused("the scene has " + grouped(kMaxSolids) + " solids, the most that there may be");
  const SceneBox room = sceneBox(session);
  const double edge = crateEdge(session), spacing = session.scene().fluid.spacing, gap = 0.5 * edge + 0.1 * spacing;
  const auto enters = entry(ray, room.low, room.high);
  if (!enters) return refused("it would miss the scene; point into the tank");
  for (size_t a = 0; a < 3; ++a)
    if (room.high[a] - room.low[a] < 2 * gap) return refused("the tank is narrower than the crate, " + roundedNumber(edge) + " m");
  auto positions = session.runner().positions();
  if (!positions) return positions.error();
  const Room free(session, std::move(*positions), edge);
  const double first = *enters + 0.5 * edge, last = std::min(boxInterval(room.low, room.high, ray.from, ray.along)[1], free.hit(ray));
  std::string obstacle;
  const double step = std::max(0.25 * edge, (last - first) / kMaxPlaces);
  for (int k = 0; k == 0 || (k < kMaxPlaces && first + k * step < last); ++k) {
    Double3 center = ray.at(first + k * step);
    for (size_t a = 0; a < 3; ++a) center[a] = std::clamp(center[a], room.low[a] + gap, room.high[a] - gap);
    const std::string found = free.obstacleAt(center);
    if (obstacle.empty()) obstacle = found;
    if (!found.empty()) continue;
    Solid crate;
    crate.shape = BoxShape{along(center, -0.5 * edge, {1, 1, 1}), along(center, 0.5 * edge, {1, 1, 1})};
    crate.friction = 0.4;
    crate.body = Body{.density = kCrateDensity, .velocity = along({}, maxSpeed(session), ray.along)};
    solids.push_back(std::move(crate));
    return session.changeSolids(std::move(solids));
  }
  return refused("it would overlap " + obstacle);
}

}  // namespace rill::view
