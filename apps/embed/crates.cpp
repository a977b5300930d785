// Crates of a game's own physics engine, Bullet, that float and sink in Rill's water. In each frame the water's loads act on the crates,
// Bullet moves them, and the water gets their poses as targets. Prints how deep they float and how high they rose above their start.
// Usage: crates OUT.ppm
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <rill/fluid.hpp>
#include <rill/fluid_renderer.hpp>
#include <string>
#include <vector>

#include "borrow.hpp"
#include "draw.hpp"
#include "host/cuboids.hpp"

namespace {

constexpr float kFrame = 1.0f / 60, kGravity = 9.81f;          // s, m/s^2
constexpr int kFrames = 200, kMeasured = 60;                   // the last ones are measured
constexpr float kTank[3] = {2, 1, 0.65f}, kDepth = 0.4f;       // m
constexpr float kHalf[3] = {0.16f, 0.1f, 0.16f};               // m, of a crate
constexpr float kVolume = 8 * kHalf[0] * kHalf[1] * kHalf[2];  // m^3
constexpr float kWater = 1000, kDisplaced = kWater * kVolume;  // kg/m^3; kg, of the water that a crate displaces
constexpr float kRatios[] = {0.2f, 0.5f, 1, 2, 5};             // density of the crates over the water's
constexpr float kSpacing = 0.05f;                              // m, of the water's particles

btVector3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
btVector3 vector(const rill::Double3& v) { return {float(v.x), float(v.y), float(v.z)}; }

/// A crate of Bullet. Loads arrive a frame late, which makes a crate oscillate that is lighter than the water that it moves. So while
/// water carries it, it has the mass of the water that it displaces in addition, without weight (README.md: Light bodies).
class Crate {
 public:
  Crate(btDynamicsWorld& world, float ratio, const btVector3& center)
      : world_(world), start_(center.y()), mass_(ratio * kDisplaced), body_(mass_, nullptr, &shape_, inertia(mass_)) {
    body_.setWorldTransform(btTransform(btQuaternion::getIdentity(), center));
    body_.setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(&body_);
  }
  ~Crate() { world_.removeRigidBody(&body_); }
  Crate(const Crate&) = delete;
  Crate& operator=(const Crate&) = delete;

  void apply(const rill::SolidLoad& load) {
    constexpr float kKept = 0.9f;  // a frame: between waves the mass decreases gradually
    const btVector3 force = vector(load.force);
    const float weight = mass_ * kGravity;
    carried_ = std::max(std::min(force.length() / weight, 1.0f), kKept * carried_);
    const float mass = mass_ + carried_ * kDisplaced;
    body_.setMassProps(mass, inertia(mass));  // keeps the velocities, not the momentum
    body_.updateInertiaTensor();
    body_.applyCentralForce(force - btVector3(0, weight, 0));
    body_.applyTorque(vector(load.torque));
  }

  rill::SolidTarget target(uint32_t solid) const {
    const btVector3& c = body_.getCenterOfMassPosition();
    const btQuaternion q = body_.getOrientation();
    return {solid, {c.x(), c.y(), c.z()}, rill::Quaternion{q.x(), q.y(), q.z(), q.w()}};
  }
  host::Cuboid cuboid(const float (&color)[3]) const {
    host::Cuboid out{{-kHalf[0], -kHalf[1], -kHalf[2]}, {kHalf[0], kHalf[1], kHalf[2]}, {color[0], color[1], color[2]}};
    body_.getCenterOfMassTransform().getOpenGLMatrix(out.pose.m[0]);
    return out;
  }
  /// Of an upright crate, as a fraction of its height.
  float draught(float level) const { return std::clamp((level - body_.getCenterOfMassPosition().y()) / (2 * kHalf[1]) + 0.5f, 0.0f, 1.0f); }
  float tilt_deg() const { return std::acos(std::clamp(body_.getCenterOfMassTransform().getBasis()[1].y(), -1.0f, 1.0f)) * 57.29578f; }
  float rise() const { return body_.getCenterOfMassPosition().y() - start_; }  ///< m, above the start
  float speed() const { return body_.getLinearVelocity().length(); }
  /// False for what is not finite, too.
  bool isInside() const {
    const btVector3& c = body_.getCenterOfMassPosition();
    for (int a = 0; a < 3; ++a)
      if (!(c[a] > 0 && c[a] < kTank[a])) return false;
    return true;
  }

 private:
  static btVector3 inertia(float mass) {
    btVector3 out;
    btBoxShape(vector(kHalf)).calculateLocalInertia(mass, out);
    return out;
  }
  // Contacts keep a spacing between solids: water that is pressed into less room than a particle needs is thrown out.
  btBoxShape shape_{vector(kHalf) + btVector3(kSpacing, kSpacing, kSpacing) / 2};
  btDynamicsWorld& world_;
  float start_;               ///< m, height of the center
  float mass_, carried_ = 0;  ///< kg; how much of its weight the water has carried, 0 to 1
  btRigidBody body_;
};

/// Bullet's world: the walls of the tank.
class World {
 public:
  World() {
    dynamics.setGravity({0, 0, 0});  // crates have their weight from apply()
    for (int a = 0; a < 3; ++a)
      for (const float side : {1.0f, -1.0f}) {
        btVector3 normal(0, 0, 0);
        normal[a] = side;
        planes_.push_back(std::make_unique<btStaticPlaneShape>(normal, (side > 0 ? 0 : -kTank[a]) + kSpacing / 2));
        walls_.push_back(std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, planes_.back().get())));
        dynamics.addRigidBody(walls_.back().get());
      }
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::vector<std::unique_ptr<btStaticPlaneShape>> planes_;
  std::vector<std::unique_ptr<btRigidBody>> walls_;

 public:
  btDiscreteDynamicsWorld dynamics{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

/// Where the water's surface is, m, from the volume of the water and of what the crates displace.
float waterLevel(float volume, const std::vector<std::unique_ptr<Crate>>& crates) {
  float level = kDepth;
  for (int k = 0; k < 50; ++k) {
    float all = volume;
    for (const auto& crate : crates) all += kVolume * crate->draught(level);
    level = all / (kTank[0] * kTank[2]);
  }
  return level;
}

/// The water must be where Bullet's time is: a solid jumps to its target when the rest of an advance is dropped.
void expectComplete(const rill::FluidProgress& progress) {
  const double missing = progress.timeLeft_s + progress.timeDropped_s;  // the former would be dropped by the next advance
  if (missing > 0)
    host::fail(("the water has not simulated " + std::to_string(missing) + " s of a frame: raise FluidStep::substeps").c_str());
}

/// The water's solid must be where Bullet's crate is: Rill shortens motions that are faster than Solid::driven.
void expectReached(const rill::Fluid& water, const rill::SolidTarget& target) {
  const rill::Double3 c = water.drivenCenter(target.solid);
  const rill::Quaternion q = water.drivenRotation(target.solid), &to = *target.rotation;
  const double apart = std::hypot(c.x - target.center.x, c.y - target.center.y, c.z - target.center.z);
  const double cosine = std::abs(q.x * to.x + q.y * to.y + q.z * to.z + q.w * to.w);  // of half the angle between them
  if (apart > 1e-4 || cosine < 1 - 1e-5)
    host::fail(("crate " + std::to_string(target.solid) + " is faster than Solid::driven: its solid is " + std::to_string(apart) +
                " m and " + std::to_string(2 * std::acos(std::min(cosine, 1.0))) + " rad from it: raise Solid::driven")
                   .c_str());
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: crates OUT.ppm");
  constexpr uint32_t kWidth = 480, kHeight = 270, kCrates = std::size(kRatios);
  constexpr float kEye[3] = {1.4f, 1, 2.3f}, kTarget[3] = {1, 0.25f, 0.3f};
  RillHost rillHost;
  host::Engine& engine = rillHost.engine;
  auto device = rillHost.borrowDevice();
  host::Image color =
      engine.createImage(VK_FORMAT_R8G8B8A8_SRGB, kWidth, kHeight, rill::kFluidColorUsage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  host::Image depth = engine.createImage(VK_FORMAT_D32_SFLOAT, kWidth, kHeight, rill::kFluidDepthUsage);
  {
    host::Cuboids cuboids(engine, color, depth);
    const host::Matrix clip = host::perspective(40, float(kWidth) / kHeight, 0.1f) * host::lookAt(kEye, kTarget);
    const rill::FluidView view = lookAt(kEye, kTarget, kWidth, kHeight);

    // Each crate is a body in Bullet's world and a driven solid of the scene.
    World world;
    std::vector<std::unique_ptr<Crate>> crates;
    rill::Scene scene;
    scene.fluid.spacing = kSpacing;
    scene.fluid.density = kWater;
    scene.domain = rill::Domain{{0, 0, 0}, {kTank[0], kTank[1], kTank[2]}};
    scene.fill = {rill::Fill{.shape = rill::BoxShape{{0, 0, 0}, {kTank[0], kDepth, kTank[2]}}}};
    for (uint32_t n = 0; n < kCrates; ++n) {
      const float x = 0.22f + 0.39f * float(n), y = kDepth + kHalf[1] + 0.06f, z = kTank[2] / 2;
      crates.push_back(std::make_unique<Crate>(world.dynamics, kRatios[n], btVector3(x, y, z)));
      scene.solids.push_back(
          {.shape = rill::BoxShape{{x - kHalf[0], y - kHalf[1], z - kHalf[2]}, {x + kHalf[0], y + kHalf[1], z + kHalf[2]}}, .driven = 5});
    }
    const auto start = need(rill::makeParticles(scene));
    auto water = need(rill::Fluid::create(device, {.scene = &scene, .particles = &start, .loads = true}));
    auto renderer = need(rill::FluidRenderer::create(device, {color.format, depth.format}));
    const float volume = float(start.positions.size()) * kSpacing * kSpacing * kSpacing;

    rill::Graph graph;
    float draughts[kCrates] = {}, speeds[kCrates] = {};  // sum and maximum over the measured frames
    float rises[kCrates] = {};                           // maximum over all frames
    for (int k = 0; k < kFrames; ++k) {
      engine.wait();  // for the loads of the last frame
      const host::Frame frame = engine.begin();
      device.beginFrame({frame.number, frame.completed});
      expectComplete(water.progress());
      for (uint32_t n = 0; n < kCrates; ++n) crates[n]->apply(water.solidLoads()[n]);
      world.dynamics.stepSimulation(kFrame, 4, kFrame / 4);

      std::vector<rill::SolidTarget> targets;
      std::vector<host::Cuboid> drawn{{{-3, -0.2f, -2}, {5, 0, 3}, {0.42f, 0.36f, 0.30f}}};
      const float level = waterLevel(volume, crates);
      for (uint32_t n = 0; n < kCrates; ++n) {
        if (!crates[n]->isInside()) host::fail("a crate has left the tank");
        const float dark = 1 - 0.18f * float(n);
        targets.push_back(crates[n]->target(n));
        drawn.push_back(crates[n]->cuboid({0.85f * dark, 0.5f * dark, 0.2f * dark}));
        rises[n] = std::max(rises[n], crates[n]->rise());
        if (k < kFrames - kMeasured) continue;
        draughts[n] += crates[n]->draught(level);
        speeds[n] = std::max(speeds[n], crates[n]->speed());
      }

      cuboids.drawFirst(frame, clip, drawn.data(), uint32_t(drawn.size()));
      graph.reset();
      const rill::SceneTargets images{importTarget(graph, "color", color, rill::Use::ColorTarget),
                                      importTarget(graph, "depth", depth, rill::Use::DepthTarget)};
      const rill::FluidState state = water.addTo(graph, {.advance_s = kFrame, .targets = targets});
      for (const rill::SolidTarget& target : targets) expectReached(water, target);
      (void)renderer.addTo(graph, state, images, view);
      need(graph.compile());
      need(graph.prepare(device));
      graph.record(frame.commands);
      engine.end(frame);
    }
    engine.wait();
    for (uint32_t n = 0; n < kCrates; ++n)
      std::printf("density %.1f: draught %.3f of its height, tilt %.1f degrees, %.3f m/s, rise %.3f m\n", double(kRatios[n]),
                  double(draughts[n] / kMeasured), double(crates[n]->tilt_deg()), double(speeds[n]), double(rises[n]));
  }
  engine.save(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, arguments[1]);
  engine.destroy(color);
  engine.destroy(depth);
}
