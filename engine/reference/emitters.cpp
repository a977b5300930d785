#include "reference/emitters.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace rill::reference {
namespace {

glm::dquat quaternion(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

}  // namespace

MouthFrame mouthFrame(const EmitterSettings& e, double t) {
  MouthFrame frame{e.center, {}, {}, {1, 0, 0, 0}};
  size_t next = 0;
  while (next < e.motion.size() && e.motion[next].at <= t) ++next;
  if (e.motion.empty()) return frame;
  const auto moved = [&](size_t k) { return glm::dvec3(e.motion[k].translate.x, e.motion[k].translate.y, e.motion[k].translate.z); };
  const size_t last = next > 0 ? next - 1 : 0;
  frame.center += moved(last);
  frame.rotation = quaternion(e.motion[last].rotate);
  if (next == 0 || next == e.motion.size()) return frame;
  const double span = e.motion[next].at - e.motion[last].at, share = (t - e.motion[last].at) / span;
  glm::dquat by = quaternion(e.motion[next].rotate) * glm::conjugate(frame.rotation);
  if (by.w < 0) by = -by;
  frame.velocity = (moved(next) - moved(last)) / span;
  frame.center += share * span * frame.velocity;
  const double angle = glm::angle(by);
  if (!(angle > 0)) return frame;
  frame.angularVelocity = angle / span * glm::axis(by);
  frame.rotation = glm::angleAxis(share * angle, glm::axis(by)) * frame.rotation;
  return frame;
}

std::vector<Birth> births(const EmitterSettings& e, double t, const glm::dvec3& gravity) {
  std::vector<Birth> all;
  const double end = std::min(t, e.until);
  for (uint64_t layer = 0;; ++layer) {
    const double born = e.from + (static_cast<double>(layer) + 0.5) / e.rate, age = t - born;
    if (born > end) return all;
    const MouthFrame mouth = mouthFrame(e, born);
    for (const glm::dvec3& point : e.points) {
      const glm::dvec3 arm = mouth.rotation * point;
      const glm::dvec3 velocity = mouth.rotation * e.velocity + mouth.velocity + glm::cross(mouth.angularVelocity, arm);
      all.push_back({born, mouth.center + arm + age * velocity + 0.5 * age * age * gravity, velocity + age * gravity});
    }
  }
}

}  // namespace rill::reference
