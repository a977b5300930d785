#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/words.hpp"
#include "model/name_rules.hpp"

namespace rill::model {
namespace {

bool fitsFloat(double value) {
  if (!std::isfinite(value) || std::abs(value) > std::numeric_limits<float>::max()) return false;
  return value == 0 || std::abs(value) >= std::numeric_limits<float>::denorm_min();
}

CheckResult minBelowMax(const Double3& min, const Double3& max) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (min[axis] < max[axis]) continue;
    return Fault{"max is " + shortestNumber(max[axis]) + " and min is " + shortestNumber(min[axis]) + " along " + "xyz"[axis] +
                     "; expected min below max on every axis",
                 {elementPath("max", axis), elementPath("min", axis)}};
  }
  return {};
}

template <class Timed>
CheckResult increasingTimes(const std::vector<Timed>& entries) {
  for (size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].at > entries[i - 1].at) continue;
    return Fault{"found " + shortestNumber(entries[i].at) + " s after " + shortestNumber(entries[i - 1].at) +
                     " s in the previous entry, expected increasing times",
                 {memberPath(elementPath("", i), "at"), memberPath(elementPath("", i - 1), "at")}};
  }
  return {};
}

CheckResult checkBody(const Solid& solid) {
  if (!solid.body) return {};
  if (!solid.motion.empty()) return Fault{"found a body with keyframes; expected \"body\" or \"motion\", not both", {"body", "motion"}};
  if (solid.driven > 0) return Fault{"found a body that the host drives; expected \"body\" or \"driven\", not both", {"body"}};
  const auto* mesh = std::get_if<MeshShape>(&solid.shape);
  if (mesh && mesh->two_sided) return Fault{"found a body of a two-sided mesh, which has no volume; expected a closed mesh", {"body"}};
  return {};
}

}  // namespace

CheckResult unitQuaternion(const Quaternion& parts, std::string_view key) {
  const double length = std::hypot(std::hypot(parts.x, parts.y, parts.z), parts.w);
  if (!(length > 0))
    return Fault{"the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation", {std::string(key)}};
  constexpr double kTolerance = 1e-3;  // rounding in products of float quaternions
  if (std::abs(length - 1) > kTolerance)
    return Fault{"the quaternion's length is " + roundedNumber(length) + "; expected 1", {std::string(key)}};
  return {};
}

std::string unitText(const Info& info) { return info.unit.empty() ? std::string() : " (" + std::string(info.unit) + ")"; }

std::string rangeText(const Range& range) {
  std::string text;
  if (range.hasLow()) text = (range.low_open ? "above " : range.hasHigh() ? "from " : "at least ") + shortestNumber(range.low);
  if (range.hasHigh()) {
    if (!text.empty()) text += range.low_open ? " and " : " to ";
    if (range.high_open) {
      text += "below ";
    } else if (range.low_open || !range.hasLow()) {
      text += "at most ";
    }
    constexpr double kExact = 9007199254740992.0;  // 2^53; the only larger bound is 2^64 - 1
    text += range.high > kExact ? "18446744073709551615"
            : range.high >= 1e6 ? std::to_string(static_cast<uint64_t>(range.high))
                                : shortestNumber(range.high);
  }
  return text;
}

std::string expectedNumber(const Info& info, bool whole) {
  const std::string range = rangeText(info.range);
  return std::string(whole ? "a whole number" : "a number") +
         (range.empty()              ? ""
          : range.starts_with("at ") ? " of " + range
                                     : " " + range) +
         unitText(info);
}

CheckResult checkNumber(const Info& info, double value, bool whole, std::string_view found) {
  const auto fault = [&](std::string_view what) { return Fault{std::string(found) + std::string(what) + expectedNumber(info, whole)}; };
  if (!std::isfinite(value)) return fault(" is not finite; expected ");
  if (!info.range.contains(value)) return fault(" is out of range; expected ");
  if (!fitsFloat(value)) return fault(" is out of range of a 32-bit float; expected ");
  return {};
}

CheckResult checkChoice(const Info& info, std::string_view given) {
  if (std::ranges::find(info.words, given) != info.words.end()) return {};
  const std::string_view suggestion = nearestWord(given, info.words);
  return Fault{"found the string " + inQuotes(given) + ", expected one of " + quotedList(info.words) +
               (suggestion.empty() ? "" : "; did you mean " + inQuotes(suggestion) + "?")};
}

CheckResult checkFileName(std::string_view given) {
  if (!given.empty() && given.find('\0') == std::string_view::npos) return {};
  return Fault{"found " + inQuotes(given) + ", expected a file name"};
}

CheckResult checkLength(const Info& info, size_t entries) {
  if (info.most == 0 || entries <= info.most) return {};
  return Fault{"found " + grouped(entries) + " entries, expected at most " + grouped(info.most)};
}

CheckResult checkOneOf(std::span<const std::string_view> keys, std::span<const std::string_view> given) {
  if (keys.empty() || given.size() == 1) return {};
  return Fault{"expected exactly one of " + quotedList(keys) + "; found " + (given.empty() ? "none" : quotedList(given))};
}

CheckResult checkRules(const BoxShape& box) { return minBelowMax(box.min, box.max); }

CheckResult checkRules(const Domain& domain) {
  if (domain.open_removes && domain.open == 0)
    return Fault{"found true, but no side is open; expected sides in \"open\", or false", {"open_removes", "open"}};
  if (CheckResult fault = minBelowMax(domain.min, domain.max)) return fault;
  return checkSides(domain);
}

CheckResult checkRules(const MeshShape& shape) {
  if (!shape.mesh) return Fault{"found no mesh; expected one of Mesh::create(), or a file that loadScene() reads", {"mesh"}};
  if (shape.mesh->twoSided() != shape.two_sided)
    return Fault{std::string("found ") + (shape.two_sided ? "true" : "false") + "; expected what the mesh was created with", {"two_sided"}};
  return {};
}

CheckResult checkRules(const Fill& fill) {
  if (const auto* shape = std::get_if<MeshShape>(&fill.shape)) {
    if (shape->two_sided) return Fault{"found true; expected a closed mesh, which can be filled", {"mesh.two_sided"}};
    return unitQuaternion(fill.rotation, "rotation");
  }
  if (fill.translation != Double3{}) return Fault{"found a translation; only a mesh can be translated", {"translation"}};
  if (fill.rotation != Quaternion{0, 0, 0, 1}) return Fault{"found a rotation; only a mesh can be rotated", {"rotation"}};
  return {};
}

CheckResult checkRules(const std::vector<Solid>& solids) { return uniqueNames(solids, "solids", false); }

CheckResult checkRules(const Solid& solid) {
  if (CheckResult fault = unitQuaternion(solid.rotation, "rotation")) return fault;
  // Set by hosts only: JSON has no key for it.
  if (!(solid.driven >= 0) || !fitsFloat(solid.driven))
    return Fault{shortestNumber(solid.driven) + " is out of range; expected a speed of at least 0 (m/s)", {"driven"}};
  if (solid.driven > 0 && !solid.motion.empty())
    return Fault{"found " + shortestNumber(solid.driven) + " for a solid with keyframes; expected 0, or a solid without motion",
                 {"driven"}};
  return checkBody(solid);
}

CheckResult checkRules(const Body& body) {
  for (const auto& [velocity, key, first] : {std::tuple{body.velocity, "velocity", 0U}, {body.angular_velocity, "angular_velocity", 3U}})
    for (unsigned a = 0; a < 3; ++a) {
      constexpr double kFastest = 1e9;
      const std::string where = std::string("along ") + "xyz"[a];
      if (std::abs(velocity[a]) > kFastest) return Fault{"found " + shortestNumber(velocity[a]) + "; expected at most 1e9", {key}};
      if (velocity[a] != 0 && (body.locked >> (first + a) & 1U) != 0)
        return Fault{"found " + shortestNumber(velocity[a]) + " " + where + ", which is locked; expected 0", {key, "locked"}};
    }
  return {};
}

CheckResult checkRules(const Keyframe& keyframe) { return unitQuaternion(keyframe.rotate, "rotate"); }

CheckResult checkRules(const Camera& camera) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (static_cast<float>(camera.eye[axis]) != static_cast<float>(camera.target[axis])) return {};
  }
  return Fault{"eye and target are the same point; expected two different points", {"target", "eye"}};
}

CheckResult checkRules(const std::vector<Keyframe>& motion) { return increasingTimes(motion); }
CheckResult checkRules(const std::vector<GravityChange>& changes) { return increasingTimes(changes); }

CheckResult checkRules(const std::vector<Probe>& probes) { return uniqueNames(probes, "probes", true); }

// What fluids, fills, emitters and probes name exists, and names of emitters and drains are unique.
CheckResult checkRules(const Scene& scene) {
  if (CheckResult fault = checkFluids(scene)) return fault;
  std::vector<std::string_view> solids, flows;
  for (const Solid& solid : scene.solids)
    if (!solid.name.empty()) solids.push_back(solid.name);
  if (CheckResult fault = collectFlowNames(scene, flows)) return fault;
  for (size_t i = 0; i < scene.probes.size(); ++i) {
    const Probe& probe = scene.probes[i];
    const std::string path = elementPath("probes", i);
    if (probe.level || probe.front || probe.pressure) continue;
    CheckResult fault;
    if (!probe.load.empty()) {
      fault = knownName(probe.load, solids, "solid", "a solid", memberPath(path, "load"));
    } else if (!probe.pose.empty()) {
      fault = knownName(probe.pose, solids, "solid", "a solid", memberPath(path, "pose"));
    } else if (!probe.flow.empty()) {
      fault = knownName(probe.flow, flows, "emitter or drain", "an emitter or a drain", memberPath(path, "flow"));
    } else {
      fault = Fault{"found an empty name, expected the name of a solid, an emitter or a drain", {path}};
    }
    if (fault) return fault;
  }
  return {};
}

}  // namespace rill::model
