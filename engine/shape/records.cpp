#include "shape/records.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#include "core/overloaded.hpp"
#include "shared/body_records.h"

namespace rill {
namespace {

// What shaders/fluid/solid_array.glsl and body_array.glsl rely on.
constexpr size_t kQuadBytes = 16;
static_assert(sizeof(SolidRecord) == kSolidQuads * kQuadBytes && offsetof(SolidRecord, body) == 6 * kQuadBytes);
static_assert(sizeof(BodyRecord) == kBodyQuads * kQuadBytes && offsetof(BodyRecord, mass) == 8 * kQuadBytes &&
              offsetof(BodyRecord, stiffness) == 9 * kQuadBytes && offsetof(BodyRecord, inverseYZ) == 10 * kQuadBytes);

float f(double value) { return static_cast<float>(value); }

uint32_t kindOf(const Shape& shape) {
  return std::visit(Overloaded{[](const BoxShape&) { return kShapeBox; }, [](const SphereShape&) { return kShapeSphere; },
                               [](const MeshShape&) { return kShapeMesh; }},
                    shape);
}

}  // namespace

ShapeRecord recordOf(const Shape& shape) {
  const Double3 half = halfExtents(shape), middle = middleOf(shape);
  return {f(half[0]), f(half[1]), f(half[2]), kindOf(shape), f(middle[0]), f(middle[1]), f(middle[2]), 0};
}

PoseRecord recordOf(const Pose& pose, const Double3& origin) {
  return {f(pose.center[0] - origin[0]), f(pose.center[1] - origin[1]), f(pose.center[2] - origin[2]), f(pose.rotation[0]),
          f(pose.rotation[1]),           f(pose.rotation[2]),           f(pose.rotation[3]),           f(pose.velocity[0]),
          f(pose.velocity[1]),           f(pose.velocity[2]),           f(pose.angularVelocity[0]),    f(pose.angularVelocity[1]),
          f(pose.angularVelocity[2])};
}

PoseRecord baseRecord(const Solid& solid, const Double3& origin) {
  return recordOf(Pose{.center = centerOf(solid), .rotation = solid.rotation}, origin);
}

std::vector<KeyframeRecord> keyframeRecords(const std::vector<Keyframe>& motion) {
  std::vector<KeyframeRecord> records;
  for (size_t k = 0; k < motion.size(); ++k) {
    const Keyframe &key = motion[k], &next = motion[std::min(k + 1, motion.size() - 1)];
    const Double3 turn = turnBetween(key.rotate, next.rotate);
    records.push_back({.x = f(key.translate[0]),
                       .y = f(key.translate[1]),
                       .z = f(key.translate[2]),
                       .at = f(key.at),
                       .rotationX = f(key.rotate[0]),
                       .rotationY = f(key.rotate[1]),
                       .rotationZ = f(key.rotate[2]),
                       .rotationW = f(key.rotate[3]),
                       .turnX = f(turn[0]),
                       .turnY = f(turn[1]),
                       .turnZ = f(turn[2])});
  }
  return records;
}

Double3 centerOf(const PoseRecord& pose) { return {pose.centerX, pose.centerY, pose.centerZ}; }

Quaternion rotationOf(const PoseRecord& pose) { return {pose.rotationX, pose.rotationY, pose.rotationZ, pose.rotationW}; }

std::array<KeyframeRecord, 2> drivenKeyframes(const PoseRecord& from, const PoseRecord& to, double seconds) {
  const Double3 turn = turnBetween(rotationOf(from), rotationOf(to));
  const auto keyframe = [&](const PoseRecord& pose, double at) {
    return KeyframeRecord{.x = pose.centerX,
                          .y = pose.centerY,
                          .z = pose.centerZ,
                          .at = f(at),
                          .rotationX = pose.rotationX,
                          .rotationY = pose.rotationY,
                          .rotationZ = pose.rotationZ,
                          .rotationW = pose.rotationW,
                          .turnX = f(turn.x),
                          .turnY = f(turn.y),
                          .turnZ = f(turn.z)};
  };
  return {keyframe(from, 0), keyframe(to, seconds)};
}

void appendPose(const PoseRecord& pose, std::vector<float>& numbers) {
  const auto all = std::bit_cast<std::array<float, kPoseNumbers>>(pose);
  numbers.insert(numbers.end(), all.begin(), all.end());
}

PoseRecord poseAt(const std::vector<float>& numbers, size_t solid) {
  PoseRecord pose;
  std::memcpy(&pose, numbers.data() + kPoseNumbers * solid, sizeof pose);
  return pose;
}

}  // namespace rill
