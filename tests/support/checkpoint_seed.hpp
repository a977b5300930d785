#pragma once
// A small synthetic checkpoint, and a helper to fix the checksum of a modified one.
#include <cstring>
#include <vector>

#include "core/fnv1a.hpp"
#include "fluid/snapshot.hpp"
#include "rill/offline.hpp"
#include "shared/pressure_probe.h"

namespace rill::test {

/// The shape that matches seedCheckpoint().
inline SnapshotShape seedShape() {
  return {.capacity = 6, .solidCount = 1, .listCapacity = 4, .cells = 256, .segments = true, .movingSolids = true};
}

template <class Record>
std::vector<uint32_t> wordsOfRecord(const Record& record) {
  std::vector<uint32_t> all(sizeof record / 4);
  std::memcpy(all.data(), &record, sizeof record);
  return all;
}

/// Six particles: two near a solid, one of them with more neighbors than its list holds; a probe of pressure.
inline offline::Checkpoint seedCheckpoint() {
  offline::Checkpoint c;
  c.rill = "0.1.0";
  c.scene = "seed";
  c.device = "none";
  c.driver = "none";
  c.time_s = 0.1;
  c.frame = 6;
  c.fps = 60;
  c.keys = {{"fluid.spacing", "0.1"}, {"start", "0123456789abcdef"}};
  FluidSnapshot& s = c.fluid;
  FluidControl control{};
  control.count = control.solved = 6;
  control.desiredStep = 1e-3f;
  FluidSums sums{};
  sums.overflow = 1;
  sums.nearSolids = 2;
  s.control = wordsOfRecord(control);
  s.sums = wordsOfRecord(sums);
  s.solids = {1, 2, 3, 0, 0, 0, 1, 0, 0, 0.5f, 0, 0, 0};
  for (uint32_t i = 0; i < 6; ++i) {
    const auto x = static_cast<float>(i);
    s.position.push_back({x, 0.5f, 0.25f});
    s.velocity.push_back({0, -x, 0});
    s.warmAcceleration.push_back({0, 0, x});
    s.warmStart.push_back(-0.125f * x);
    s.id.push_back(5 - i);
    s.cell.push_back(3 * i);
  }
  s.pressures = wordsOfRecord(PressureProbeRecord{.x = 1,
                                                  .y = 0.25f,
                                                  .z = 0.5f,
                                                  .mean = 2500,
                                                  .integralHigh = 250,
                                                  .integralLow = 1e-6f,
                                                  .advance = 12.5f,
                                                  .advanceTime = 5e-3f,
                                                  .covered = 1});
  for (const auto& [particle, solid] : {std::pair<uint32_t, uint16_t>{0, 0}, {5, 0xfffe}}) {
    s.nearSolids.push_back({.particle = particle});
    s.nearSolids.back().solids.fill(0xffff);
    s.nearSolids.back().solids[0] = solid;
  }
  s.listCapacity = 4;
  s.neighborCount = {1, 2, 0, 4, 9, 1};
  s.neighbors = {1, 0, 3, 0, 1, 2, 5, 3};
  c.whitewater.counts.assign(16, 0);
  c.whitewater.counts[0] = 2;
  c.whitewater.place = {{1, 2, 3, 0.5f}, {4, 5, 6, 0}};
  c.whitewater.motion = {{1, 2, 3, 4}, {5, 6, 7, 9}};
  return c;
}

/// The shape that matches seedCheckpointWithBodies().
inline SnapshotShape seedShapeWithBodies() {
  SnapshotShape shape = seedShape();
  shape.solidCount = 3;
  shape.bodyCount = 2;
  shape.contactPoints = 3;
  return shape;
}

/// The same with two bodies, one of which touches the floor.
inline offline::Checkpoint seedCheckpointWithBodies() {
  offline::Checkpoint c = seedCheckpoint();
  FluidSnapshot& s = c.fluid;
  const std::vector<float> pose = s.solids;
  for (uint32_t k = 1; k < 3; ++k) {
    s.solids.insert(s.solids.end(), pose.begin(), pose.end());
    const PoseRecord state{.centerX = 0.5f, .rotationW = 1, .velocityY = -0.25f, .angularZ = 2};
    const BodyRecord body{.state = state,
                          .predicted = state,
                          .radius = 0.5f,
                          .from = 0.5f,
                          .mass = 2,
                          .locked = k,
                          .stiffness = 3,
                          .solid = k,
                          .inertiaXX = 1,
                          .inertiaYY = 1,
                          .inertiaZZ = 1};
    const std::vector<uint32_t> words = wordsOfRecord(body);
    s.bodies.insert(s.bodies.end(), words.begin(), words.end());
  }
  for (const uint32_t partner : {0u, 1u, kWallPartner}) {
    const std::vector<uint32_t> words = wordsOfRecord(SlipRecord{partner, 1e-3f, 0, -1e-4f, 2e-3f});
    s.slips.insert(s.slips.end(), words.begin(), words.end());
  }
  return c;
}

/// Updates the checksum at the end of the file.
inline void seal(std::vector<std::byte>& file) {
  if (file.size() < 8) return;
  Fnv1a hash;
  hash.add(std::span<const std::byte>(file).first(file.size() - 8));
  const uint64_t value = hash.value();
  std::memcpy(file.data() + file.size() - 8, &value, 8);
}

}  // namespace rill::test
