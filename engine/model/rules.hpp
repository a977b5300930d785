#pragma once
// What a scene must keep to beyond the types of its members: each rule and its words once. The reader of scene files applies them to what
// JSON says, checkScene() to what a host has made.
#include <string>
#include <string_view>
#include <vector>

#include "model/fields.hpp"

namespace rill::model {

/// What is wrong with a value: what was found, what was expected.
struct Fault {
  std::string text;
  std::vector<std::string> keys = {};  ///< paths below the value that may be to blame, the likeliest first; none: the value itself
};
/// Empty where nothing is wrong.
using Verdict = std::optional<Fault>;

/// "at least 0", "above 0 and at most 10", "a..b" in words; empty where every number is accepted.
std::string rangeText(const Range& range);
/// " (m/s)"; empty where there is none.
std::string unitText(const Info& info);
/// "a number above 0 and at most 10 (s)".
std::string expectedNumber(const Info& info, bool whole);

/// Of one key's value; `found` is the number as messages write it.
Verdict judgeNumber(const Info& info, double value, bool whole, std::string_view found);
Verdict judgeWord(const Info& info, std::string_view given);
Verdict judgeFileName(std::string_view given);
Verdict judgeLength(const Info& info, size_t entries);

/// Of an object, of which one of `keys` must be given. No keys: nothing must.
Verdict judgeOneOf(std::span<const std::string_view> keys, std::span<const std::string_view> given);

// Between the keys of an object, or the entries of a list, whose values have been judged.
Verdict judge(const BoxShape& box);
Verdict judge(const Domain& domain);
Verdict judge(const FluidSettings& fluid);
Verdict judge(const Solid& solid);
Verdict judge(const Camera& camera);
Verdict judge(const std::vector<Keyframe>& motion);
Verdict judge(const std::vector<GravityChange>& changes);
Verdict judge(const std::vector<Probe>& probes);
template <class T>
Verdict judge(const T&) {
  return {};
}

}  // namespace rill::model
