// Whether a fluid's state fits a scene: shaders read by its indices.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <string>

#include "core/words.hpp"
#include "fluid/arrays.hpp"
#include "fluid/near_solids.hpp"
#include "fluid/neighbor_list.hpp"
#include "fluid/sleep.hpp"
#include "fluid/snapshot.hpp"
#include "fluid/snapshot_words.hpp"
#include "shape/records.hpp"
#include "shared/region_records.h"

namespace rill {
namespace {

Error wrong(std::string what) { return Error{ErrorKind::BadInput, "the state does not fit the scene: " + std::move(what)}; }

Expected<void> checkLength(const char* name, uint64_t entries, uint64_t expected) {
  if (entries == expected) return {};
  return wrong(std::string(name) + " has " + std::to_string(entries) + " entries; expected " + std::to_string(expected));
}

Expected<void> checkLengths(const FluidSnapshot& s, const SnapshotShape& shape) {
  if (auto right = checkLength("control", s.control.size(), sizeof(FluidControl) / 4); !right) return right;
  if (auto right = checkLength("sums", s.sums.size(), sizeof(FluidSums) / 4); !right) return right;
  const uint64_t poses = shape.movingSolids ? uint64_t{kPoseNumbers} * shape.solidCount : 0;
  if (auto right = checkLength("solids", s.solids.size(), poses); !right) return right;
  if (auto right = checkLength("bodies", s.bodies.size(), uint64_t{kBodyWords} * shape.bodyCount); !right) return right;
  if (auto right = checkLength("slips", s.slips.size(), uint64_t{kSlipWords} * shape.contactPoints); !right) return right;
  if (!s.loads.empty())  // they may be of no use to the scene that goes on
    if (auto right = checkLength("loads", s.loads.size(), uint64_t{kLoadNumbers} * shape.solidCount); !right) return right;
  if (auto right = checkLength("flows", s.flows.size(), shape.flowWords); !right) return right;
  if (!s.regions.empty())
    if (auto right = checkLength("regions", s.regions.size(), kRegionWords * shape.regions); !right) return right;
  if (s.pressures.size() % kPressureProbeWords != 0)  // of other probes they are of no use
    return wrong("pressures has " + std::to_string(s.pressures.size()) + " entries; expected a multiple of " +
                 std::to_string(kPressureProbeWords));
  const uint32_t count = readRecord<FluidControl>(s.control).count;
  if (count > shape.capacity)
    return wrong("it has " + std::to_string(count) + " particles; expected at most " + std::to_string(shape.capacity));
  if (auto right = checkLength("fluid", s.fluid.size(), shape.fluids > 1 ? count : 0); !right) return right;
  if (!s.fluid.empty() && *std::ranges::max_element(s.fluid) >= shape.fluids)
    return wrong("it has particles of fluid " + std::to_string(*std::ranges::max_element(s.fluid)) + "; expected an index below " +
                 std::to_string(shape.fluids));
  Expected<void> result;
  if (s.concentration.size() > count)  // of particles that were added there are none
    return wrong("mixture has " + std::to_string(s.concentration.size()) + " entries; expected at most " + std::to_string(count));
  forEachSaved([&](const ArrayRow& row, auto member) {
    if (row.id == FluidArray::Concentration) return;
    // Of a fluid without a warm start, or without regions, there are none.
    const bool absent = row.id == FluidArray::Rest ? s.regions.empty() : row.optional && s.warmAcceleration.empty() && s.warmStart.empty();
    if (result) result = checkLength(row.savedName, (s.*member).size(), absent ? 0 : count);
  });
  return result;
}

/// Marks entries; false for one that is out of range or was there before.
bool markNew(std::vector<bool>& seen, std::span<const uint32_t> entries) {
  for (uint32_t entry : entries) {
    if (entry >= seen.size() || seen[entry]) return false;
    seen[entry] = true;
  }
  return true;
}

Expected<void> checkNear(const FluidSnapshot& s, const FluidSums& sums, const SnapshotShape& shape) {
  if (s.nearSolids.size() != sums.nearSolids || (shape.solidCount == 0 && sums.nearSolids > 0))
    return wrong("the list of particles near solids has another length than its count");
  std::vector<uint32_t> particles;
  for (const NearSolids& near : s.nearSolids) {
    particles.push_back(near.particle);
    if (!listsSolids(near, shape.solidCount)) return wrong("a particle near solids has a list of solids that is not valid");
  }
  std::vector<bool> seen(s.id.size());
  if (!markNew(seen, particles)) return wrong("the list of particles near solids has an index that is out of range or appears twice");
  return {};
}

/// Whether a pose and velocities can be gone on with.
bool valid(const PoseRecord& p) {
  for (const float number : std::bit_cast<std::array<float, sizeof p / sizeof(float)>>(p))
    if (!(std::abs(number) < 1e15F)) return false;
  const float square = p.rotationX * p.rotationX + p.rotationY * p.rotationY + p.rotationZ * p.rotationZ + p.rotationW * p.rotationW;
  return std::abs(square - 1) < 0.01F;
}

Expected<void> checkBodies(const FluidSnapshot& s) {
  for (size_t k = 0; k < s.bodies.size() / kBodyWords; ++k) {
    const auto body = readRecord<BodyRecord>(std::span(s.bodies).subspan(k * kBodyWords));
    if (!valid(body.state) || !valid(body.predicted) || !(body.stiffness >= 0 && body.stiffness < 1e30F))
      return wrong(elementPath("bodies", k) + " has a motion that is not valid; expected finite numbers and a unit quaternion");
    if (!(body.mass > 1e-30F && body.mass < 1e30F)) return wrong(elementPath("bodies", k) + " has a mass that is not above 0 and finite");
  }
  for (size_t k = 0; k < s.slips.size() / kSlipWords; ++k)
    for (size_t word = 1; word < kSlipWords; ++word)
      if (!std::isfinite(std::bit_cast<float>(s.slips[k * kSlipWords + word])))
        return wrong(elementPath("slips", k) + " is not finite; expected finite numbers");
  return {};
}

Expected<void> checkPressures(const FluidSnapshot& s) {
  for (size_t k = 0; k < s.pressures.size() / kPressureProbeWords; ++k) {
    const auto r = readRecord<PressureProbeRecord>(std::span(s.pressures).subspan(k * kPressureProbeWords));
    bool good = r.advanceTime >= 0 && r.covered <= 1;
    for (const float number : {r.x, r.y, r.z, r.mean, r.integralHigh, r.integralLow, r.advance, r.advanceTime})
      good &= std::isfinite(number);
    if (!good) return wrong(elementPath("pressures", k) + " is not valid; expected finite numbers");
  }
  return {};
}

/// Whether an emitter's state can be gone on with: shaders place particles by it.
bool valid(const EmitterRecord& e) {
  for (const float number :
       {e.centerX, e.centerY, e.centerZ, e.speed,      e.rate,   e.normalX,  e.normalY, e.normalZ, e.acrossX,  e.acrossY,     e.acrossZ,
        e.upX,     e.upY,     e.upZ,     e.halfAcross, e.halfUp, e.doneHigh, e.doneLow, e.age,     e.interval, e.blockedHigh, e.blockedLow})
    if (!(std::abs(number) < 1e15F)) return false;
  return e.speed >= 0 && e.rate >= 0 && e.blockedHigh >= 0 && e.opened >= 0 && e.opened <= 1 && e.age >= 0 && e.age < 1e6F &&
         e.interval >= 0 && e.interval < 1e6F && e.due <= 1000000;
}

Expected<void> checkFlows(const FluidSnapshot& s, const SnapshotShape& shape) {
  const auto control = readRecord<FluidControl>(s.control);
  const bool emits = shape.emitterCount > 0;
  if (!(control.emitterSpeed >= 0 && control.emitterSpeed <= (emits ? 1e9F : 0.0F)) || !(control.emissionWait < 2 * kNever))
    return wrong("its control block is not that of a scene with " + std::to_string(shape.emitterCount) + " emitters");
  if (s.flows.empty()) return {};
  const std::span<const uint32_t> words(s.flows);
  constexpr size_t kFlowWords = sizeof(FlowRecord) / 4, kEmitterWords = sizeof(EmitterRecord) / 4;
  const auto ledger = readRecord<FlowRecord>(words);
  if (!std::isfinite(ledger.blockedHigh) || !std::isfinite(ledger.blockedLow))
    return wrong("flows has a blocked time that is not finite; expected a finite number (s)");
  if (ledger.nextId > kMaxIds || (!s.id.empty() && *std::ranges::max_element(s.id) >= ledger.nextId))
    return wrong("the id of its next particle is " + std::to_string(ledger.nextId) + "; expected one above all ids, at most " +
                 std::to_string(kMaxIds));
  for (size_t k = 0; k < shape.emitterCount; ++k)
    if (!valid(readRecord<EmitterRecord>(words.subspan(kFlowWords + k * kEmitterWords))))
      return wrong(elementPath("emitters", k) + " has a state that is not valid; expected finite numbers of at least 0");
  return {};
}

/// Whether a region's state can be gone on with. Its sums are those of no particles.
bool valid(const RegionRecord& r) {
  for (const float number : {r.restShare, r.restForceX, r.restForceY, r.restForceZ})
    if (!(std::abs(number) < 1e15F)) return false;
  const auto sums = {r.particles, r.motion, r.fastest, r.nearSolid};
  const auto vectors = {r.driftX, r.driftY, r.driftZ, r.forceX, r.forceY, r.forceZ};
  return r.state <= kRegionAsleep && r.zone <= kZoneAsleep && r.woken <= 1 && r.moves <= 1 && std::ranges::count(sums, 0u) == 4 &&
         std::ranges::count(vectors, 0) == 6;
}

/// Regions have states that there are, and particles of those asleep come last.
Expected<void> checkRegions(const FluidSnapshot& s, const SnapshotShape& shape) {
  const auto control = readRecord<FluidControl>(s.control);
  const auto time = [](float seconds) { return seconds >= 0 && seconds < 1e15F; };
  if (!time(control.regionTime) || !time(control.sleepStep)) return wrong("its times of regions are not finite numbers of at least 0 (s)");
  const std::span<const uint32_t> words(s.regions);
  for (size_t k = 0; k < words.size() / kRegionWords; ++k)
    if (!valid(readRecord<RegionRecord>(words.subspan(k * kRegionWords, kRegionWords))))
      return wrong(elementPath("regions", k) + " has a state that is not valid");
  const auto last = std::ranges::find(s.rest, uint32_t{kZoneAsleep});
  const auto solved = s.rest.empty() ? std::ptrdiff_t{control.count} : last - s.rest.begin();
  const bool cells = !hasNeighbors(s) || std::ranges::lower_bound(s.cell, static_cast<uint32_t>(shape.cells)) - s.cell.begin() == solved;
  if (solved != std::ptrdiff_t{control.solved} || !cells || std::any_of(last, s.rest.end(), [](uint32_t z) { return z != kZoneAsleep; }) ||
      std::any_of(s.rest.begin(), last, [](uint32_t z) { return z > kZoneAsleep; }))
    return wrong("its particles in regions asleep do not come last");
  return {};
}

/// With surface tension a list begins with far neighbors.
bool isFar(uint32_t neighbor) { return neighbor >= kImageOfNeighbors + kDeepSegment; }
bool farComeFirst(std::span<const uint32_t> neighbors, bool tension) {
  if (neighbors.empty()) return true;
  return isFar(neighbors[0]) == tension && std::ranges::none_of(neighbors.subspan(1), isFar);
}

/// The first neighbor names an image, or is a far one, if any does; images come in order.
bool imagesInOrder(std::span<const uint32_t> neighbors) {
  uint32_t last = 0;
  for (size_t k = 0; k < neighbors.size(); ++k) {
    if (neighbors[k] < kImageOfNeighbors) continue;
    if (k > 0 && (last == 0 || neighbors[k] <= last)) return false;
    last = isFar(neighbors[k]) ? kImageOfNeighbors - 1 : neighbors[k];
  }
  return true;
}

Expected<void> checkNeighbors(const FluidSnapshot& s, const FluidSums& sums, const SnapshotShape& shape) {
  const bool alive = hasNeighbors(s), lists = alive && shape.listCapacity > 0;
  if (s.listCapacity != shape.listCapacity)
    return wrong("its neighbor lists hold " + std::to_string(s.listCapacity) + " entries; expected " + std::to_string(shape.listCapacity));
  if (auto right = checkLength("neighbor counts", s.neighborCount.size(), lists ? s.id.size() : 0); !right) return right;
  uint64_t entries = 0, overflow = 0;
  for (uint32_t n : s.neighborCount) {
    if (n <= shape.listCapacity)
      entries += n;
    else
      ++overflow;
  }
  if (auto right = checkLength("neighbors", s.neighbors.size(), entries); !right) return right;
  if (lists && overflow != sums.overflow) return wrong("its number of overflowed neighbor lists is not that of its neighbor counts");
  const uint32_t images = shape.segments ? kSegmentImages : uint32_t{shape.tension};
  const auto isImage = [&](uint32_t j) {
    return j - kImageOfNeighbors < images || (shape.tension && isFar(j) && j <= kImageOfNeighbors + kFarSegment);
  };
  const auto outOfRange = [&](uint32_t j) { return j < kImageOfNeighbors ? j >= s.id.size() : !isImage(j); };
  if (std::ranges::any_of(s.neighbors, outOfRange)) return wrong("a neighbor index is out of range");
  uint64_t from = 0;
  for (uint32_t i = 0; i < s.neighborCount.size(); ++i) {
    const uint32_t n = s.neighborCount[i];
    if (n > shape.listCapacity) continue;
    const auto neighbors = std::span(s.neighbors).subspan(from, n);
    if (!imagesInOrder(neighbors)) return wrong("the images of a particle's neighbors are not in order");
    if (!farComeFirst(neighbors, shape.tension)) return wrong("far neighbors of a particle do not come first, as surface tension asks for");
    if (listEntries(i, neighbors) > shape.listCapacity)
      return wrong("the neighbors of a particle take more entries than its list has; expected them in increasing order");
    from += n;
  }

  if (auto right = checkLength("cells", s.cell.size(), alive ? s.id.size() : 0); !right) return right;
  if (!std::is_sorted(s.cell.begin(), s.cell.end()) || (!s.cell.empty() && s.cell.back() >= (shape.regions > 0 ? 2 : 1) * shape.cells))
    return wrong("the particles are not sorted by their cells");
  return {};
}

/// A phase before time begins has something left to do, and not more than it starts with.
bool validPhase(const FluidControl& control, const SnapshotShape& shape) {
  const uint32_t left = control.phaseLeft;
  if (control.phase > kPhaseInitialPressure) return false;
  if (control.nextPhase == kPhaseAdvancing) return left == 0;
  if (control.nextPhase == kPhaseSettling) return left > 0 && left <= kSettleSubsteps;
  return control.nextPhase == kPhaseInitialPressure && left > 0 && left <= shape.initialPressureIterations;
}

}  // namespace

Expected<void> checkSnapshot(const FluidSnapshot& snapshot, const SnapshotShape& shape) {
  if (shape.capacity == 0 && snapshot.id.empty()) return {};
  if (auto right = checkLengths(snapshot, shape); !right) return right;
  const auto control = readRecord<FluidControl>(snapshot.control);
  const auto sums = readRecord<FluidSums>(snapshot.sums);
  if (control.listState > kListDue || !validPhase(control, shape) || control.timeLeft != 0 || control.sleep > kAsleep)
    return wrong("its control block is not that of an advance's end");
  std::vector<uint32_t> ids(snapshot.id);
  std::sort(ids.begin(), ids.end());
  if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) return wrong("an id appears twice; expected each once");
  if (!ids.empty() && ids.back() >= kMaxIds)
    return wrong("its largest id is " + std::to_string(ids.back()) + "; expected less than " + std::to_string(kMaxIds));
  if (auto right = checkNear(snapshot, sums, shape); !right) return right;
  if (auto right = checkBodies(snapshot); !right) return right;
  if (auto right = checkPressures(snapshot); !right) return right;
  if (auto right = checkFlows(snapshot, shape); !right) return right;
  if (auto right = checkNeighbors(snapshot, sums, shape); !right) return right;
  return checkRegions(snapshot, shape);
}

}  // namespace rill
