// What the host changes of emitters at the begin of an advance: validated, and copied to the device.
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "fluid/flows.hpp"
#include "fluid/fluid_impl.hpp"

namespace rill {
namespace {

constexpr size_t kMouthBytes = offsetof(EmitterRecord, from);

bool isVector(const Double3& v) { return std::abs(v.x) < 1e15 && std::abs(v.y) < 1e15 && std::abs(v.z) < 1e15; }

/// v, turned as the rotation that takes the unit vector `from` to the unit vector `to` the shorter way.
Double3 turnedWith(const Double3& v, const Double3& from, const Double3& to) {
  const Double3 axis = cross(from, to);
  const double cosine = dot(from, to);
  if (cosine < -0.999999) return along(v, -2 * dot(v, from), from);  // any half turn will do
  const Double3 across = cross(axis, v);
  return along(along(v, 1, across), 1 / (1 + cosine), cross(axis, across));
}

/// Whether a target takes a mouth to another place, or turns it, so far that what it displaced was elsewhere.
bool jumps(const EmitterRecord& r, const EmitterTarget& target, const Double3& origin, double spacing) {
  constexpr double kTurn = 0.9;  // cosine
  const Double3 from = {r.centerX, r.centerY, r.centerZ};
  if (target.center && length(minus(minus(*target.center, origin), from)) > spacing / 2) return true;
  return target.normal && dot(normalized(*target.normal), {r.normalX, r.normalY, r.normalZ}) < kTurn;
}

/// The new mouth of an emitter.
void change(EmitterRecord& r, const MouthSize& size, const EmitterTarget& target, const Double3& origin) {
  if (target.center) place(r, minus(*target.center, origin));
  if (target.normal) {
    const Double3 before = {r.normalX, r.normalY, r.normalZ}, normal = normalized(*target.normal);
    const Double3 across = turnedWith({r.acrossX, r.acrossY, r.acrossZ}, before, normal);
    const Double3 part = along(across, -dot(across, normal), normal), straight = normalized(part);
    setAxes(r, normal, straight, cross(straight, normal));
  }
  setFlow(r, size, target.flow);
}

}  // namespace

std::string FluidImpl::faultOfEmitters(const FluidStep& step) const {
  if (step.emitters.empty()) return {};
  if (step.queued) return "queued is set; expected false where emitters are changed";
  for (size_t k = 0; k < step.emitters.size(); ++k) {
    const EmitterTarget& target = step.emitters[k];
    const std::string member = "emitters[" + std::to_string(k) + "].";
    if (target.emitter >= setup.emitters.size())
      return member + "emitter is " + std::to_string(target.emitter) + "; the scene has " + std::to_string(setup.emitters.size()) +
             (setup.emitters.size() == 1 ? " emitter" : " emitters");
    const double speed = target.flow / setup.mouthSizes[target.emitter].area;
    if (!(target.flow >= 0 && speed < 1e9))
      return member + "flow is " + shortestNumber(target.flow) +
             "; expected a number of at least 0 (m^3/s), less than 1e9 m/s in the mouth";
    if (target.center && !isVector(*target.center))
      return member + "center is " + roundedPlace(*target.center) + "; expected finite numbers below 1e15 (m)";
    if (target.normal && !(isVector(*target.normal) && length(*target.normal) > 1e-15))
      return member + "normal is " + roundedPlace(*target.normal) + "; expected a finite vector of a length above 0";
  }
  return {};
}

// The time up to now counts at the old rates.
void FluidImpl::declareEmitters(Graph& graph, const FluidStep& step) {
  if (step.emitters.empty()) return;
  declare(graph, FluidPass::PlanEmission, Start::Always, EmissionPush{0, 0, 0});
  struct Update {
    uint64_t at;
    EmitterRecord record;
    bool jumps;
  };
  std::vector<Update> updates;
  for (const EmitterTarget& target : step.emitters) {
    EmitterRecord& record = setup.emitters[target.emitter];
    const bool far = jumps(record, target, origin, setup.params.spacing);
    change(record, setup.mouthSizes[target.emitter], target, origin);
    updates.push_back({target.emitter * sizeof record, record, far});
  }
  graph.pass("change emitters", [&](Pass& pass) {
    BufferRef& target = ref(FluidArray::Emitters);
    target = pass.write(target, Use::CopyTarget);
    return [updates = std::move(updates), target = target](Commands& commands) {
      for (const Update& update : updates) {
        commands.update(target, std::as_bytes(std::span(&update.record, 1)).first(kMouthBytes), update.at);
        constexpr float kShut = 0;  // it opens anew where it is now
        if (update.jumps) commands.update(target, std::as_bytes(std::span(&kShut, 1)), update.at + offsetof(EmitterRecord, opened));
      }
    };
  });
}

}  // namespace rill
