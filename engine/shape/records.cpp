#include "shape/records.hpp"

#include <bit>
#include <cstring>

namespace rill {
namespace {

float f(double value) { return static_cast<float>(value); }

}  // namespace

ShapeRecord recordOf(const Shape& shape) {
  const Vec3 half = halfExtents(shape);
  return {f(half[0]), f(half[1]), f(half[2]), std::holds_alternative<SphereShape>(shape) ? kShapeSphere : kShapeBox};
}

PoseRecord recordOf(const Pose& pose, const double origin[3]) {
  return {f(pose.center[0] - origin[0]), f(pose.center[1] - origin[1]), f(pose.center[2] - origin[2]), f(pose.rotation[0]),
          f(pose.rotation[1]),           f(pose.rotation[2]),           f(pose.rotation[3]),           f(pose.velocity[0]),
          f(pose.velocity[1]),           f(pose.velocity[2]),           f(pose.angularVelocity[0]),    f(pose.angularVelocity[1]),
          f(pose.angularVelocity[2])};
}

PoseRecord baseRecord(const Solid& solid, const double origin[3]) {
  return recordOf(Pose{.center = centerOf(solid.shape), .rotation = std::to_array(solid.rotation)}, origin);
}

std::vector<KeyframeRecord> keyframeRecords(const Solid& solid) {
  std::vector<KeyframeRecord> records;
  for (const Keyframe& key : solid.motion)
    records.push_back({.x = f(key.translate[0]), .y = f(key.translate[1]), .z = f(key.translate[2]), .at = f(key.at), .rotationW = 1});
  return records;
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
