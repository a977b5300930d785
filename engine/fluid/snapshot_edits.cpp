// Changes to a fluid's state on the host: particles, solids and emitters that are added, gravity.
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/vector_math.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/flows.hpp"
#include "fluid/sleep.hpp"
#include "fluid/snapshot.hpp"
#include "fluid/snapshot_words.hpp"
#include "shape/contact_points.hpp"
#include "shape/records.hpp"
#include "shared/region_records.h"

namespace rill {

void forgetNeighbors(FluidSnapshot& s) {
  auto control = readRecord<FluidControl>(s.control);
  auto sums = readRecord<FluidSums>(s.sums);
  control.listState = kListDue;
  // What the solve goes by is not put in a new order: the pressure found so far has to do.
  if (control.nextPhase == kPhaseInitialPressure) control.nextPhase = kPhaseAdvancing, control.phaseLeft = 0;
  sums.nearSolids = 0;
  s.control = wordsOf(control);
  s.sums = wordsOf(sums);
  s.nearSolids.clear();
  s.neighborCount.clear();
  s.neighbors.clear();
  s.cell.clear();
}

void wake(FluidSnapshot& s) {
  if (!s.regions.empty()) forgetNeighbors(s);  // those asleep have no lists
  auto control = readRecord<FluidControl>(s.control);
  auto sums = readRecord<FluidSums>(s.sums);
  const float ratio = control.sleepStep > 0 ? control.warmStep / control.sleepStep : 1;  // of the steps that multipliers are expressed for
  for (size_t i = 0; i < s.rest.size(); ++i) {
    if (s.rest[i] == kZoneMoves || s.warmStart.empty()) continue;
    if (s.rest[i] == kZoneAsleep) s.warmStart[i] *= ratio * ratio;
    s.warmAcceleration[i] = {-control.gravityX, -control.gravityY, -control.gravityZ, 0};  // what sleeps is in balance
  }
  control.sleep = kAwake;
  control.restShare = 0;
  control.solved = control.count;
  sums.asleep = 0;
  s.control = wordsOf(control);
  s.sums = wordsOf(sums);
  s.regions.clear();
  s.rest.clear();
}

void append(FluidSnapshot& s, std::span<const Float3> positions, std::span<const Float3> velocities, std::span<const uint8_t> fluids) {
  s.fluid.insert(s.fluid.end(), fluids.begin(), fluids.end());
  forgetNeighbors(s);
  wake(s);
  const bool warm = !s.warmStart.empty();
  auto sums = readRecord<FluidSums>(s.sums);
  uint32_t next = s.id.empty() ? 0 : *std::max_element(s.id.begin(), s.id.end()) + 1;
  if (!s.flows.empty()) next = readRecord<FlowRecord>(s.flows).nextId;  // an id is never given twice
  for (size_t k = 0; k < positions.size(); ++k) {
    s.id.push_back(next++);
    s.position.push_back(positions[k]);
    s.velocity.push_back(velocities[k]);
    if (warm) {
      s.warmAcceleration.push_back({});
      s.warmStart.push_back(0);
    }
    const Float3& v = velocities[k];
    sums.speedMax = std::max(sums.speedMax, std::bit_cast<uint32_t>(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)));
  }
  s.sums = wordsOf(sums);
  auto control = readRecord<FluidControl>(s.control);
  control.count = control.solved = static_cast<uint32_t>(s.id.size());
  s.control = wordsOf(control);
  if (s.flows.empty()) return;
  auto ledger = readRecord<FlowRecord>(s.flows);
  ledger.filled += static_cast<uint32_t>(positions.size());
  for (const uint8_t fluid : fluids) ++ledger.filledOf[fluid];
  ledger.nextId = next;
  const std::vector<uint32_t> words = wordsOf(ledger);
  std::ranges::copy(words, s.flows.begin());
}

void replaceSolids(FluidSnapshot& s, std::span<const Solid> before, std::span<const Solid> after, std::span<const Pose> poses,
                   const Double3& origin) {
  forgetNeighbors(s);
  wake(s);
  const FluidSnapshot old = {.solids = s.solids, .bodies = s.bodies, .slips = s.slips};
  s.solids.clear();
  s.bodies.clear();
  s.slips.clear();
  bool moves = false;
  float fastest = 0;
  size_t body = 0, slip = 0;  // of the old ones: words before those of the solid
  for (size_t k = 0; k < after.size(); ++k) {
    const Solid& solid = after[k];
    moves |= solid.driven > 0 || !solid.motion.empty() || solid.body;
    const bool goesOn = k < before.size() && before[k].body && solid.body;
    appendPose(goesOn ? poseAt(old.solids, k) : recordOf(poses[k], origin), s.solids);
    if (!solid.body) continue;
    const size_t slips = kSlipWords * contactPoints(solid.shape).size();
    if (goesOn) {
      s.bodies.insert(s.bodies.end(), &old.bodies[body], &old.bodies[body] + kBodyWords);
      s.slips.insert(s.slips.end(), &old.slips[slip], &old.slips[slip] + slips);
      body += kBodyWords;
      slip += slips;
      continue;
    }
    const BodyRecord fresh = bodyRecord(solid, massOf(solid), static_cast<uint32_t>(k), origin);
    const std::vector<uint32_t> words = wordsOf(fresh);
    s.bodies.insert(s.bodies.end(), words.begin(), words.end());
    s.slips.resize(s.slips.size() + slips);
    fastest = std::max(fastest, static_cast<float>(length(solid.body->velocity) + fresh.radius * length(solid.body->angular_velocity)));
  }
  if (!moves) s.solids.clear();
  if (!s.loads.empty()) s.loads.resize(kLoadNumbers * after.size());
  auto sums = readRecord<FluidSums>(s.sums);
  sums.bodySpeed = std::max(sums.bodySpeed, std::bit_cast<uint32_t>(fastest));
  s.sums = wordsOf(sums);
}

void addEmitters(FluidSnapshot& s, const Scene& before, const Scene& after, const Double3& origin) {
  forgetNeighbors(s);
  wake(s);
  if (after.emitters.size() <= before.emitters.size()) return;
  if (s.flows.empty()) {  // no particle has come or gone so far
    FlowRecord ledger = firstLedger(static_cast<uint32_t>(s.id.size()), readRecord<FluidSums>(s.sums).nonFinite);
    for (size_t i = 0; i < s.fluid.size(); ++i) {
      ++ledger.filledOf[s.fluid[i]];
      if (std::abs(s.position[i].x) >= kInactiveLimit) ++ledger.inactiveOf[s.fluid[i]];
    }
    if (!s.id.empty()) ledger.nextId = std::max(ledger.nextId, *std::ranges::max_element(s.id) + 1);
    s.flows = wordsOf(ledger);
  }
  const auto control = readRecord<FluidControl>(s.control);
  FluidSetup setup;
  if (!addFlows(after, origin, setup)) return;  // the fluid of that scene is refused as well
  std::vector<uint32_t> fresh;
  for (size_t k = before.emitters.size(); k < after.emitters.size(); ++k) {
    EmitterRecord& emitter = setup.emitters[k];
    emitter.speed = emitter.rate = 0;
    emitter.doneHigh = control.timeHigh;
    emitter.doneLow = control.timeLow;
    const std::vector<uint32_t> words = wordsOf(emitter);
    fresh.insert(fresh.end(), words.begin(), words.end());
  }
  const size_t old = (sizeof(FlowRecord) + before.emitters.size() * sizeof(EmitterRecord)) / 4;
  s.flows.insert(s.flows.begin() + static_cast<std::ptrdiff_t>(old), fresh.begin(), fresh.end());
}

void setGravity(FluidSnapshot& s, const Double3& gravity) {
  wake(s);  // in balance with the gravity so far
  auto control = readRecord<FluidControl>(s.control);
  control.gravityX = static_cast<float>(gravity[0]);
  control.gravityY = static_cast<float>(gravity[1]);
  control.gravityZ = static_cast<float>(gravity[2]);
  s.control = wordsOf(control);
}

}  // namespace rill
