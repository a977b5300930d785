// What the device holds before the first step of a fluid that goes on from a snapshot.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <tuple>

#include "fluid/flows.hpp"
#include "fluid/fluid_impl.hpp"
#include "fluid/near_solids.hpp"
#include "fluid/neighbor_list.hpp"
#include "fluid/snapshot.hpp"
#include "shape/records.hpp"

namespace rill {

// `s` has been checked; it lives until the staging is made.
void FluidImpl::stageSnapshot(const FluidSnapshot& s) {
  resumed_ = true;
  stageParticles(s.position, s.velocity, s.fluid);
  stageConcentrations(s.concentration, s.fluid);
  // Which particles are near mouths is not kept: until the next rebuild, all may be.
  const auto nearMouths = static_cast<uint32_t>(setup.emitters.empty() ? 0 : s.id.size());
  resumeDecisions(s, nearMouths);
  resumeSolids(s);
  resumePressures(s);
  if (setup.removes) resumeFlows(s);
  stageFlows();
  if (s.regions.empty())
    staging_->clear(slotOf(FluidArray::Regions));
  else
    staging_->add(slotOf(FluidArray::Regions), s.regions.data(), s.regions.size() * 4);
  resumeArrays(s);
  resumeNeighbors(s, nearMouths > 0);
}

/// The control block and the sums that it goes by.
void FluidImpl::resumeDecisions(const FluidSnapshot& s, uint32_t nearMouths) {
  staging_->add(slotOf(FluidArray::Control), s.control.data(), s.control.size() * 4);
  std::vector<uint32_t> sums = s.sums;
  if (setup.params.solidCount > 0) sums[offsetof(FluidSums, nearSolids) / 4] = static_cast<uint32_t>(nearSolidCount(s));
  sums[offsetof(FluidSums, nearMouths) / 4] = nearMouths;
  sums[offsetof(FluidSums, inReach) / 4] = 0;  // between substeps; what was reached is counted anew before its list is read
  uint32_t& reached = sums[offsetof(FluidSums, reached) / 4];
  reached = std::min(reached, sums[offsetof(FluidSums, nearSolids) / 4]);
  staging_->add(slotOf(FluidArray::Sums), std::move(sums));
  std::vector<uint32_t> all(nearMouths);
  std::iota(all.begin(), all.end(), 0u);
  staging_->add(slotOf(FluidArray::NearMouths), std::move(all));
}

/// Poses, bodies and their contacts, loads.
void FluidImpl::resumeSolids(const FluidSnapshot& s) {
  std::vector<SolidRecord> solids = setup.solids;
  for (size_t k = 0; kPoseNumbers * k < s.solids.size(); ++k) solids[k].pose = poseAt(s.solids, k);
  for (DrivenSolid& driven : setup.driven) driven.pose = poseAt(s.solids, driven.solid);
  staging_->add(slotOf(FluidArray::Solids), std::move(solids));
  std::vector<BodyRecord> bodies = setup.bodies;  // of the snapshot, their states and what the last substep left
  for (size_t k = 0; k < bodies.size(); ++k) {
    BodyRecord saved;
    std::memcpy(&saved, s.bodies.data() + k * kBodyWords, sizeof saved);
    bodies[k].state = saved.state;
    bodies[k].predicted = saved.predicted;
    bodies[k].held = saved.held;
    bodies[k].stopped = saved.stopped;
    bodies[k].mayTouch = saved.mayTouch;
    bodies[k].stiffness = saved.stiffness * std::sqrt(saved.mass / bodies[k].mass);  // the host may have changed its mass
  }
  takeBodies(std::as_bytes(std::span(bodies)));
  staging_->add(slotOf(FluidArray::Bodies), std::move(bodies));
  staging_->add(slotOf(FluidArray::Slips), s.slips.data(), s.slips.size() * sizeof s.slips[0]);
  takeLoads(std::as_bytes(std::span(s.loads)));
  if (setup.loads && !s.loads.empty())
    staging_->add(slotOf(FluidArray::SolidLoads), s.loads.data(), s.loads.size() * sizeof s.loads[0]);
  else
    staging_->clear(slotOf(FluidArray::SolidLoads));
}

void FluidImpl::resumePressures(const FluidSnapshot& s) {
  std::vector<PressureProbeRecord> probes = setup.pressureProbes;
  for (size_t k = 0; k < probes.size() && kPressureProbeWords * k < s.pressures.size(); ++k) {
    PressureProbeRecord saved;
    std::memcpy(&saved, s.pressures.data() + k * kPressureProbeWords, sizeof saved);
    if (std::tie(saved.x, saved.y, saved.z) == std::tie(probes[k].x, probes[k].y, probes[k].z)) probes[k] = saved;  // else another scene's
  }
  takePressures(std::as_bytes(std::span(probes)));
  staging_->add(slotOf(FluidArray::PressureProbes), std::move(probes));
}

void FluidImpl::resumeFlows(const FluidSnapshot& s) {
  const auto bytes = std::as_bytes(std::span(s.flows));
  std::memcpy(&ledger, bytes.data(), sizeof ledger);
  size_t at = sizeof ledger;
  const auto next = [&](auto& saved) {
    std::memcpy(&saved, bytes.data() + at, sizeof saved);
    at += sizeof saved;
  };
  for (EmitterRecord& emitter : setup.emitters) {
    EmitterRecord saved;
    next(saved);
    saved.from = emitter.from, saved.until = emitter.until;
    saved.firstPoint = emitter.firstPoint, saved.points = emitter.points, saved.shape = emitter.shape;
    saved.armX = emitter.armX, saved.armY = emitter.armY, saved.armZ = emitter.armZ;
    saved.fluid = emitter.fluid;
    saved.firstKey = emitter.firstKey, saved.keyCount = emitter.keyCount, saved.motionSpeed = emitter.motionSpeed;
    emitter = saved;
  }
  for (DrainRecord& drain : setup.drains) {
    DrainRecord saved;
    next(saved);
    drain.drained = saved.drained;
  }
  takeFlows(bytes, std::as_bytes(std::span(setup.emitters)), std::as_bytes(std::span(setup.drains)));
}

/// What the rows of arrays.cpp say is saved.
void FluidImpl::resumeArrays(const FluidSnapshot& s) {
  const ArrayShape shape = arrayShape(setup);
  forEachSaved([&](const ArrayRow& row, auto member) {
    const auto& array = s.*member;
    if (row.stride != sizeof array[0] || row.length(shape) == 0) return;  // positions and velocities; what this scene has no use for
    if (row.id == FluidArray::Concentration) return;
    if (array.empty())
      staging_->clear(slotOf(row.id));
    else
      staging_->add(slotOf(row.id), array.data(), array.size() * sizeof array[0]);
  });
}

/// Which particles are near solids, and the neighbor list while it is valid.
void FluidImpl::resumeNeighbors(const FluidSnapshot& s, bool allNearMouths) {
  if (setup.params.solidCount > 0)
    staging_->add(slotOf(FluidArray::NearSolids), layOutNearSolids(s, nearSolidQuads(setup.params.solidCount)));
  if (rowOf(FluidArray::ListHead).length(arrayShape(setup)) > 0) {
    std::vector<uint32_t> heads = layOutHeads(s);
    if (allNearMouths)
      for (uint32_t& head : heads) head |= kNearMouthsBit;
    staging_->add(slotOf(FluidArray::ListHead), std::move(heads));
  }
  if (!hasNeighbors(s)) return;
  if (!s.cell.empty()) {
    staging_->add(slotOf(FluidArray::Cell), s.cell.data(), s.cell.size() * 4);
    std::vector<uint32_t> start(keyRange(setup) + 1);
    cellStarts(s.cell, start);
    staging_->add(slotOf(FluidArray::CellStart), std::move(start));
  }
  if (s.listCapacity == 0) return;
  for (uint32_t c = 0; c < chunkCount(); ++c)
    staging_->add(slotOf(FluidArray::List, c), buffer(FluidArray::List, c).size(), [this, &s, c](std::byte* to) {
      const uint64_t bytes = buffer(FluidArray::List, c).size();
      std::vector<uint32_t> list(bytes / 4);
      layOutList(s, chunks_[c].first, chunks_[c].last, list);
      std::memcpy(to, list.data(), bytes);
    });
}

}  // namespace rill
