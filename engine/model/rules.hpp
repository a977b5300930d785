#pragma once
// The validation rules of a scene and their messages. The scene reader applies them to JSON values, checkScene() to scenes made in code.
#include <string>
#include <string_view>
#include <vector>

#include "model/fields.hpp"

namespace rill::model {

/// Why a value is invalid: what was found and what was expected.
struct Fault {
  std::string text;
  std::vector<std::string> keys = {};  ///< paths below the value that may be wrong, most likely first; empty: the value itself
};
/// Empty if the value is valid.
using CheckResult = std::optional<Fault>;

/// "at least 0", "above 0 and at most 10"; empty if every number is accepted.
std::string rangeText(const Range& range);
/// " (m/s)"; empty without a unit.
std::string unitText(const Info& info);
/// "a number above 0 and at most 10 (s)".
std::string expectedNumber(const Info& info, bool whole);

/// Checks of one key's value. `found` is the number as shown in the message.
CheckResult checkNumber(const Info& info, double value, bool whole, std::string_view found);
CheckResult checkChoice(const Info& info, std::string_view given);
CheckResult checkFileName(std::string_view given);
CheckResult checkLength(const Info& info, size_t entries);

/// Checks that exactly one of `keys` is given; accepts anything if `keys` is empty.
CheckResult checkOneOf(std::span<const std::string_view> keys, std::span<const std::string_view> given);

/// Checks that a quaternion has unit length, but for rounding.
CheckResult unitQuaternion(const Quaternion& parts, std::string_view key);

// Rules between the keys of an object, or the entries of a list, whose values are valid.
CheckResult checkRules(const BoxShape& box);
CheckResult checkRules(const Domain& domain);
CheckResult checkSides(const Domain& domain);  ///< of its inflow and outflow
CheckResult checkRules(const FluidSettings& fluid);
CheckResult checkRules(const MeshShape& shape);
CheckResult checkRules(const MeshMouth& mouth);
CheckResult checkRules(const Fill& fill);
CheckResult checkRules(const Solid& solid);
CheckResult checkRules(const Body& body);
CheckResult checkRules(const Keyframe& keyframe);
CheckResult checkRules(const DiscMouth& mouth);
CheckResult checkRules(const RectMouth& mouth);
CheckResult checkRules(const Emitter& emitter);
CheckResult checkRules(const Drain& drain);
CheckResult checkRules(const Camera& camera);
CheckResult checkRules(const std::vector<Keyframe>& motion);
CheckResult checkRules(const std::vector<GravityChange>& changes);
CheckResult checkRules(const std::vector<Solid>& solids);
CheckResult checkRules(const std::vector<Probe>& probes);
CheckResult checkRules(const std::vector<FluidMaterial>& fluids);
CheckResult checkRules(const Scene& scene);
/// Of the fluids' masses, how many diffuse, their interfaces, and of the names of fluids in fills, emitters and the inflow.
CheckResult checkFluids(const Scene& scene);
/// Of a key that names a fluid and is given, but empty. In a Scene an empty name is that of no key.
Fault emptyFluidName(const Scene& scene);
/// Adds the names of emitters and drains to `names`; a fault if two of them are the same.
CheckResult collectFlowNames(const Scene& scene, std::vector<std::string_view>& names);
template <class T>
CheckResult checkRules(const T&) {
  return {};
}

}  // namespace rill::model
