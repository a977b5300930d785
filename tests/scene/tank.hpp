#pragma once
// A scene made in code.
#include "rill/scene.hpp"

namespace rill::test {

/// A tank at rest that uses every kind of object.
inline Scene tank() {
  Scene scene;
  scene.fluid.spacing = 0.1;
  scene.domain = Domain{{0, 0, 0}, {2, 1, 1}, 0};
  Fill block, drop;
  block.shape = BoxShape{{0, 0, 0}, {0.5, 0.5, 0.5}};
  drop.shape = SphereShape{{1.5, 0.5, 0.5}, 0.3};
  scene.fill = {block, drop};
  Solid post, ball;
  post.shape = BoxShape{{0.9, 0, 0.4}, {1, 0.5, 0.6}};
  ball.shape = SphereShape{{1, 0.8, 0.5}, 0.1};
  ball.motion = {Keyframe{0.5, {0, 0, 0}}, Keyframe{1, {0, 0.1, 0}}};
  scene.solids = {post, ball};
  scene.gravity_changes = {GravityChange{1, {0, -5, 0}}, GravityChange{2, {0, -9, 0}}};
  Probe gauge, front;
  gauge.name = "gauge";
  gauge.level = std::pair{0.5, 0.5};
  front.name = "front";
  front.front = Axis::PlusX;
  scene.probes = {gauge, front};
  Emitter tap, slot;
  tap.name = "tap";
  tap.mouth = DiscMouth{{1.5, 0.9, 0.5}, 0.1};
  tap.flow = 0.01;
  tap.from = 0.5;
  slot.mouth = RectMouth{{0, 0.8, 0.5}, {0.2, 0.1}, {1, 0, 0}, {0, 1, 0}};
  slot.speed = 1;
  slot.until = 2;
  scene.emitters = {tap, slot};
  Drain plug;
  plug.name = "plug";
  plug.shape = BoxShape{{1.8, 0, 0}, {2, 0.1, 1}};
  scene.drains = {plug};
  scene.camera = Camera{};
  return scene;
}

}  // namespace rill::test
