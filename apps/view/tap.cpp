#include "view/tap.hpp"

#include <algorithm>
#include <numbers>

#include "core/vector_math.hpp"
#include "model/flow_fields.hpp"
#include "shape/shape.hpp"
#include "view/scene_box.hpp"

namespace rill::view {
namespace {

constexpr double kTapRadius = 0.025;            // of the scene's longest side, within
constexpr double kMinMouth = 2, kMaxMouth = 4;  // spacings
constexpr double kTapSpeed = 0.5;               // of the scene's longest side per second
constexpr double kTapHeight = 0.25;             // above the point that it pours at, of the longest side
constexpr double kPours_s = 20;                 // how long there is room for what it adds, for
constexpr uint64_t kMaxTapParticles = 100'000;  // at most
constexpr double kTapPickRadius = 0.75;         // spacings, as of Touch

/// Direction of gravity at the present, a unit vector; without gravity `otherwise`.
Double3 gravityDirection(const Session& session, const Double3& otherwise) {
  Double3 gravity = session.scene().gravity;
  for (const GravityChange& change : session.scene().gravity_changes)
    if (change.at <= session.runner().time_s()) gravity = change.value;
  const double strength = length(gravity);
  return strength > 0 ? along({}, 1 / strength, gravity) : otherwise;
}

/// The first hit of the ray, else where it leaves the scene.
Expected<Double3> aimedAt(Session& session, const Ray& ray) {
  Runner& runner = session.runner();
  auto positions = runner.positions();
  if (!positions) return positions.error();
  const std::vector<Solid>& solids = session.scene().solids;
  std::vector<Pose> poses;
  for (uint32_t k = 0; k < solids.size(); ++k) poses.push_back(runner.pose(k));
  const double radius = kTapPickRadius * session.scene().fluid.spacing;
  if (const auto hit = pick(ray, *positions, runner.start().origin, radius, solids, poses)) return ray.at(hit->distance);
  const SceneBox box = sceneBox(session);
  if (!entry(ray, box.low, box.high)) return Error{ErrorKind::BadInput, "The tap would be outside the scene; point into the tank"};
  return ray.at(boxInterval(box.low, box.high, ray.from, ray.along)[1]);
}

}  // namespace

double Tap::radius(const Session& session) {
  const double spacing = session.scene().fluid.spacing;
  return std::clamp(kTapRadius * sceneBox(session).longest(), kMinMouth * spacing, kMaxMouth * spacing);
}

double Tap::defaultFlow(const Session& session) {
  return std::numbers::pi * radius(session) * radius(session) * kTapSpeed * sceneBox(session).longest();
}

Expected<void> Tap::open(Session& session, const Ray& ray, double flow, const std::string& fluid) {
  const auto point = aimedAt(session, ray);
  if (!point) return point.error();
  if (!session.runner().tap()) {
    if (session.scene().emitters.size() >= model::kMaxEmitters)
      return Error{ErrorKind::BadInput,
                   "The scene has " + std::to_string(model::kMaxEmitters) + " emitters, the most that there may be; a tap cannot be added"};
    Emitter emitter;
    emitter.mouth = DiscMouth{.radius = radius(session)};
    emitter.flow = defaultFlow(session);
    emitter.fluid = fluid;
    const double spacing = session.scene().fluid.spacing, rate = emitter.flow / (spacing * spacing * spacing);
    const uint64_t room = std::clamp<uint64_t>(static_cast<uint64_t>(std::min(kPours_s * rate, 1e9)), 1, kMaxTapParticles);
    if (auto added = session.addTap(emitter, room); !added) return added;
  } else if (auto changed = session.changeTap(fluid); !changed) {
    return changed;
  }
  open_ = true;
  flow_ = flow > 0 ? flow : defaultFlow(session);
  point_ = *point;
  down_ = gravityDirection(session, ray.along);
  pour(session);
  return {};
}

void Tap::pour(Session& session) {
  const SceneBox box = sceneBox(session);
  const Double3 above = along(point_, -kTapHeight * box.longest(), down_);
  const Double3 center = box.clamped(above, radius(session) + session.scene().fluid.spacing), way = minus(point_, center);
  const double spacing = session.scene().fluid.spacing;
  session.runner().setEmitter(
      {.emitter = *session.runner().tap(), .flow = flow_, .center = center, .normal = length(way) > spacing ? way : down_});
}

void Tap::move(Session& session, const CameraView& eye, const Ray& ray) {
  if (!open_) return;
  const auto distance = hitPlane(ray, point_, cameraBasis(eye).forward);
  if (!distance) return;
  point_ = sceneBox(session).clamped(ray.at(*distance), 0);
  pour(session);
}

void Tap::close(Session& session) {
  if (!open_) return;
  open_ = false;
  session.runner().setEmitter({.emitter = *session.runner().tap()});
}

}  // namespace rill::view
