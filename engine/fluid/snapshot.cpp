#include "fluid/snapshot.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "fluid/arrays.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/flows.hpp"
#include "fluid/near_solids.hpp"
#include "fluid/neighbor_list.hpp"
#include "fluid/sleep.hpp"
#include "shape/contact_points.hpp"
#include "shape/records.hpp"
#include "shared/region_records.h"

namespace rill {
namespace {

template <class Record>
Record record(std::span<const uint32_t> words) {
  Record r{};
  std::memcpy(&r, words.data(), std::min(words.size_bytes(), sizeof r));
  return r;
}

template <class Record>
std::vector<uint32_t> wordsOf(const Record& r) {
  std::vector<uint32_t> words(sizeof r / 4);
  std::memcpy(words.data(), &r, sizeof r);
  return words;
}

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
  const uint32_t count = record<FluidControl>(s.control).count;
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
    BodyRecord body;
    std::memcpy(&body, s.bodies.data() + k * kBodyWords, sizeof body);
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
    const auto r = record<PressureProbeRecord>(std::span(s.pressures).subspan(k * kPressureProbeWords));
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
       {e.centerX, e.centerY, e.centerZ, e.speed, e.rate,       e.normalX, e.normalY,  e.normalZ, e.acrossX, e.acrossY,
        e.acrossZ, e.upX,     e.upY,     e.upZ,   e.halfAcross, e.halfUp,  e.doneHigh, e.doneLow, e.age,     e.interval})
    if (!(std::abs(number) < 1e15F)) return false;
  return e.speed >= 0 && e.rate >= 0 && e.age >= 0 && e.age < 1e6F && e.interval >= 0 && e.interval < 1e6F && e.due <= 1000000;
}

Expected<void> checkFlows(const FluidSnapshot& s, const SnapshotShape& shape) {
  const auto control = record<FluidControl>(s.control);
  const bool emits = shape.emitterCount > 0;
  if (!(control.emitterSpeed >= 0 && control.emitterSpeed <= (emits ? 1e9F : 0.0F)) || !(control.emissionWait < 2 * kNever))
    return wrong("its control block is not that of a scene with " + std::to_string(shape.emitterCount) + " emitters");
  if (s.flows.empty()) return {};
  const std::span<const uint32_t> words(s.flows);
  constexpr size_t kFlowWords = sizeof(FlowRecord) / 4, kEmitterWords = sizeof(EmitterRecord) / 4;
  const auto ledger = record<FlowRecord>(words);
  if (!std::isfinite(ledger.blockedHigh) || !std::isfinite(ledger.blockedLow))
    return wrong("flows has a blocked time that is not finite; expected a finite number (s)");
  if (ledger.nextId > kMaxIds || (!s.id.empty() && *std::ranges::max_element(s.id) >= ledger.nextId))
    return wrong("the id of its next particle is " + std::to_string(ledger.nextId) + "; expected one above all ids, at most " +
                 std::to_string(kMaxIds));
  for (size_t k = 0; k < shape.emitterCount; ++k)
    if (!valid(record<EmitterRecord>(words.subspan(kFlowWords + k * kEmitterWords))))
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
  const auto control = record<FluidControl>(s.control);
  const auto time = [](float seconds) { return seconds >= 0 && seconds < 1e15F; };
  if (!time(control.regionTime) || !time(control.sleepStep)) return wrong("its times of regions are not finite numbers of at least 0 (s)");
  const std::span<const uint32_t> words(s.regions);
  for (size_t k = 0; k < words.size() / kRegionWords; ++k)
    if (!valid(record<RegionRecord>(words.subspan(k * kRegionWords, kRegionWords))))
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

uint64_t flowWords(const FluidSetup& setup) {
  if (!setup.removes) return 0;
  return (sizeof(FlowRecord) + setup.emitters.size() * sizeof(EmitterRecord) + setup.drains.size() * sizeof(DrainRecord)) / 4;
}

SnapshotShape snapshotShape(const FluidSetup& setup) {
  return {.capacity = setup.params.capacity,
          .solidCount = setup.params.solidCount,
          .bodyCount = setup.params.bodyCount,
          .contactPoints = setup.params.contactPoints,
          .listCapacity = setup.params.listCapacity,
          .emitterCount = setup.params.emitterCount,
          .fluids = setup.fluids,
          .flowWords = flowWords(setup),
          .regions = regionCount(setup.params),
          .cells = setup.grid.cells(),
          .initialPressureIterations = setup.params.initialPressureIterations,
          .segments = setup.walls && !setup.thin,
          .tension = setup.params.tensionRate > 0,
          .movingSolids = setup.movingSolids};
}

bool hasNeighbors(const FluidSnapshot& snapshot) { return record<FluidControl>(snapshot.control).listState == kListValid; }

void forgetNeighbors(FluidSnapshot& s) {
  auto control = record<FluidControl>(s.control);
  auto sums = record<FluidSums>(s.sums);
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
  auto control = record<FluidControl>(s.control);
  auto sums = record<FluidSums>(s.sums);
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
  auto sums = record<FluidSums>(s.sums);
  uint32_t next = s.id.empty() ? 0 : *std::max_element(s.id.begin(), s.id.end()) + 1;
  if (!s.flows.empty()) next = record<FlowRecord>(s.flows).nextId;  // an id is never given twice
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
  auto control = record<FluidControl>(s.control);
  control.count = control.solved = static_cast<uint32_t>(s.id.size());
  s.control = wordsOf(control);
  if (s.flows.empty()) return;
  auto ledger = record<FlowRecord>(s.flows);
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
  auto sums = record<FluidSums>(s.sums);
  sums.bodySpeed = std::max(sums.bodySpeed, std::bit_cast<uint32_t>(fastest));
  s.sums = wordsOf(sums);
}

void addEmitters(FluidSnapshot& s, const Scene& before, const Scene& after, const Double3& origin) {
  forgetNeighbors(s);
  wake(s);
  if (after.emitters.size() <= before.emitters.size()) return;
  if (s.flows.empty()) {  // no particle has come or gone so far
    FlowRecord ledger = firstLedger(static_cast<uint32_t>(s.id.size()), record<FluidSums>(s.sums).nonFinite);
    for (size_t i = 0; i < s.fluid.size(); ++i) {
      ++ledger.filledOf[s.fluid[i]];
      if (std::abs(s.position[i].x) >= kInactiveLimit) ++ledger.inactiveOf[s.fluid[i]];
    }
    if (!s.id.empty()) ledger.nextId = std::max(ledger.nextId, *std::ranges::max_element(s.id) + 1);
    s.flows = wordsOf(ledger);
  }
  const auto control = record<FluidControl>(s.control);
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
  auto control = record<FluidControl>(s.control);
  control.gravityX = static_cast<float>(gravity[0]);
  control.gravityY = static_cast<float>(gravity[1]);
  control.gravityZ = static_cast<float>(gravity[2]);
  s.control = wordsOf(control);
}

Expected<void> checkSnapshot(const FluidSnapshot& snapshot, const SnapshotShape& shape) {
  if (shape.capacity == 0 && snapshot.id.empty()) return {};
  if (auto right = checkLengths(snapshot, shape); !right) return right;
  const auto control = record<FluidControl>(snapshot.control);
  const auto sums = record<FluidSums>(snapshot.sums);
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

void cellStarts(std::span<const uint32_t> cell, std::span<uint32_t> start) {
  size_t i = 0;
  for (size_t key = 0; key < start.size(); ++key) {
    while (i < cell.size() && cell[i] < key) ++i;
    start[key] = static_cast<uint32_t>(i);
  }
}

}  // namespace rill
