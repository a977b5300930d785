// The springs by which the host pulls bodies in an advance: validated, and copied to the device.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/words.hpp"
#include "fluid/fluid_impl.hpp"

namespace rill {
namespace {

constexpr double kMaxRate = 1e6;  // of a spring, Hz; likewise of its damping ratio

bool areFinite(const Double3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// What is wrong with the numbers of a pull; empty if nothing.
std::string faultOfNumbers(const BodyPull& pull) {
  if (!areFinite(pull.point)) return "point is " + roundedPlace(pull.point) + "; expected finite numbers (m)";
  if (!areFinite(pull.target)) return "target is " + roundedPlace(pull.target) + "; expected finite numbers (m)";
  if (!(pull.frequency_Hz > 0 && pull.frequency_Hz <= kMaxRate))
    return "frequency_Hz is " + shortestNumber(pull.frequency_Hz) + "; expected a number above 0, at most 1e6 (Hz)";
  if (!(pull.dampingRatio >= 0 && pull.dampingRatio <= kMaxRate))
    return "dampingRatio is " + shortestNumber(pull.dampingRatio) + "; expected a number from 0 to 1e6";
  if (!(pull.maxForce > 0)) return "maxForce is " + shortestNumber(pull.maxForce) + "; expected a number above 0 (N)";
  return {};
}

// Farther away is no different: squares stay in the range of floats.
float clamped(double coordinate) { return static_cast<float>(std::clamp(coordinate, double{-kNoWall}, double{kNoWall})); }

}  // namespace

std::string FluidImpl::faultOfPulls(const FluidStep& step) const {
  if (step.pulls.empty()) return {};
  if (step.queued) return "queued is set; expected false where bodies are pulled";
  if (step.pulls.size() > kMaxPulls)
    return "pulls has " + std::to_string(step.pulls.size()) + " entries; expected at most " + std::to_string(kMaxPulls);
  for (size_t k = 0; k < step.pulls.size(); ++k) {
    const BodyPull& pull = step.pulls[k];
    const std::string member = "pulls[" + std::to_string(k) + "].";
    if (pull.solid >= setup.solids.size()) return member + solidOutOfRange(pull.solid);
    if (setup.solids[pull.solid].body == kNoBody)
      return member + "solid is " + std::to_string(pull.solid) + ", which is not a body; expected the index of a solid with a body";
    if (const std::string fault = faultOfNumbers(pull); !fault.empty()) return member + fault;
  }
  return {};
}

void FluidImpl::declarePulls(Graph& graph, std::span<const BodyPull> pulls) {
  std::vector<PullRecord> records;
  for (const BodyPull& pull : pulls) {
    const uint32_t index = setup.solids[pull.solid].body;
    const BodyRecord& body = setup.bodies[index];
    records.push_back({.body = index,
                       .pointX = clamped(pull.point.x - body.offsetX),
                       .pointY = clamped(pull.point.y - body.offsetY),
                       .pointZ = clamped(pull.point.z - body.offsetZ),
                       .targetX = clamped(pull.target.x - origin.x),
                       .targetY = clamped(pull.target.y - origin.y),
                       .targetZ = clamped(pull.target.z - origin.z),
                       .rate = static_cast<float>(2 * std::numbers::pi * pull.frequency_Hz),
                       .dampingRatio = static_cast<float>(pull.dampingRatio),
                       .maxForce = static_cast<float>(std::min(pull.maxForce, double{std::numeric_limits<float>::max()}))});
  }
  graph.pass("pull bodies", [&](Pass& pass) {
    BufferRef& target = ref(FluidArray::Pulls);
    target = pass.write(target, Use::CopyTarget);
    return [records = std::move(records), target = target](Commands& commands) {
      commands.update(target, std::as_bytes(std::span(records)), 0);
    };
  });
}

}  // namespace rill
