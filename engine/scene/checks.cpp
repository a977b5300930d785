// Rules between the keys of a scene.
#include <cmath>
#include <limits>
#include <unordered_map>

#include "scene/reader.hpp"

namespace rill {

bool Reader::minBelowMax(const std::string& path, const double (&min)[3], const double (&max)[3]) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (min[axis] < max[axis]) continue;
    const std::string low = entryPath(childPath(path, "min"), axis), high = entryPath(childPath(path, "max"), axis);
    return failAtOneOf({high, low}, "max is " + shortNumber(max[axis]) + " and min is " + shortNumber(min[axis]) + " along " + "xyz"[axis] +
                                        "; expected min below max on every axis");
  }
  return true;
}

bool Reader::check(const std::string& path, BoxShape& box) { return minBelowMax(path, box.min, box.max); }
bool Reader::check(const std::string& path, Domain& domain) { return minBelowMax(path, domain.min, domain.max); }

bool Reader::check(const std::string& path, FluidSettings& fluid) {
  if (fluid.spacing <= 0) return true;
  const double mass = fluid.density * fluid.spacing * fluid.spacing * fluid.spacing;
  if (mass >= std::numeric_limits<float>::min() && mass <= std::numeric_limits<float>::max()) return true;
  return failAtOneOf(
      {childPath(path, "spacing"), childPath(path, "density")},
      "a particle's mass, density x spacing^3, would be " + roughNumber(mass) + " kg, which is out of range of a 32-bit float");
}

bool Reader::check(const std::string& path, Solid& solid) {
  double length = 0;
  for (const double part : solid.rotation) length = std::hypot(length, part);
  if (!(length > 0))
    return fail(childPath(path, "rotation"), "the quaternion has zero length; expected one that turns, [0, 0, 0, 1] for none");
  for (double& part : solid.rotation) part /= length;
  return true;
}

bool Reader::check(const std::string& path, Camera& camera) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (static_cast<float>(camera.eye[axis]) != static_cast<float>(camera.target[axis])) return true;
  }
  return failAtOneOf({childPath(path, "target"), childPath(path, "eye")}, "eye and target are the same point; expected two");
}

template <class Timed>
bool Reader::risingTimes(const std::string& path, const std::vector<Timed>& entries) {
  for (size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].at > entries[i - 1].at) continue;
    const std::string here = childPath(entryPath(path, i), "at"), before = childPath(entryPath(path, i - 1), "at");
    return failAtOneOf({here, before}, shortNumber(entries[i].at) + " s does not come after " + shortNumber(entries[i - 1].at) +
                                           " s, the entry before; expected times that rise");
  }
  return true;
}

bool Reader::check(const std::string& path, std::vector<Keyframe>& motion) { return risingTimes(path, motion); }
bool Reader::check(const std::string& path, std::vector<GravityChange>& changes) { return risingTimes(path, changes); }

bool Reader::check(const std::string& path, std::vector<Probe>& probes) {
  std::unordered_map<std::string_view, size_t> seen;
  for (size_t i = 0; i < probes.size(); ++i) {
    const std::string here = childPath(entryPath(path, i), "name");
    if (probes[i].name.empty()) return fail(here, "is empty; expected a name");
    const auto [first, fresh] = seen.emplace(probes[i].name, i);
    if (!fresh)
      return fail(here, inQuotes(probes[i].name) + " is the name of " + entryPath(path, first->second) + " too; expected each name once");
  }
  return true;
}

}  // namespace rill
