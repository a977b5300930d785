#pragma once
// Solids as the device's records.
#include <array>
#include <vector>

#include "shape/pose.hpp"
#include "shared/solid_records.h"

namespace rill {

/// Without the field of a mesh.
ShapeRecord recordOf(const Shape& shape);

/// `origin`: what the record's center is relative to, in the frame of `pose.center`, m.
PoseRecord recordOf(const Pose& pose, const Double3& origin);

/// A solid before any motion.
PoseRecord baseRecord(const Solid& solid, const Double3& origin);

Double3 centerOf(const PoseRecord& pose);
Quaternion rotationOf(const PoseRecord& pose);

/// The motion of a solid or a mouth.
std::vector<KeyframeRecord> keyframeRecords(const std::vector<Keyframe>& motion);

/// A driven solid's motion in an advance of `seconds`.
std::array<KeyframeRecord, 2> drivenKeyframes(const PoseRecord& from, const PoseRecord& to, double seconds);

/// The numbers of a pose, as a FluidSnapshot has them.
inline constexpr size_t kPoseNumbers = sizeof(PoseRecord) / sizeof(float);
void appendPose(const PoseRecord& pose, std::vector<float>& numbers);
PoseRecord poseAt(const std::vector<float>& numbers, size_t solid);

}  // namespace rill
