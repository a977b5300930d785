// What the device holds before the first step: the scene's records, and the particles of its start or of a snapshot.
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <tuple>

#include "fluid/flows.hpp"
#include "fluid/fluid_impl.hpp"
#include "fluid/fluids.hpp"
#include "fluid/near_solids.hpp"
#include "fluid/neighbor_list.hpp"
#include "fluid/sleep.hpp"
#include "fluid/snapshot.hpp"
#include "shape/records.hpp"

namespace rill {
namespace {

/// w of a prediction without a push by solids (shaders/fluid/fluids.glsl).
float taggedFluid(uint8_t fluid) {
  constexpr float kMinTagged = 1e-30F;
  return std::bit_cast<float>((std::bit_cast<uint32_t>(kMinTagged) & ~7u) | fluid);
}

/// The vectors as four floats each, w from `ws` or, where that is empty, `w`; then `rest` up to `entries`.
std::function<void(std::byte*)> quads(std::vector<Float3> vectors, std::vector<float> ws, float w, Float4 rest, size_t entries) {
  return [vectors = std::move(vectors), ws = std::move(ws), w, rest, entries](std::byte* to) {
    for (size_t i = 0; i < entries; ++i) {
      const float own = i < ws.size() ? ws[i] : w;
      const Float4 quad = i < vectors.size() ? Float4{vectors[i].x, vectors[i].y, vectors[i].z, own} : rest;
      std::memcpy(to + i * sizeof quad, &quad, sizeof quad);
    }
  };
}

template <class T>
std::function<void(std::byte*)> bytesOf(std::vector<T> values) {
  return [values = std::move(values)](std::byte* to) { std::memcpy(to, values.data(), values.size() * sizeof(T)); };
}

}  // namespace

void FluidImpl::stageScene() {
  staging_.emplace();
  const auto& shapes = commands_.shapes();
  staging_->add(slotOf(FluidArray::Params), &setup.params, sizeof setup.params);
  staging_->add(slotOf(FluidArray::Shapes), shapes.size() * sizeof shapes[0], bytesOf(shapes));
  staging_->add(slotOf(FluidArray::GravityChanges), setup.gravity.data(), setup.gravity.size() * 4);
  staging_->add(slotOf(FluidArray::Table), setup.tables.data(), setup.tables.size() * 4);
  staging_->add(slotOf(FluidArray::MeshWords), setup.meshWords.data(), setup.meshWords.size() * 4);
  staging_->add(slotOf(FluidArray::ContactPoints), setup.contactPoints.data(), setup.contactPoints.size() * sizeof(ContactPointRecord));
  staging_->add(slotOf(FluidArray::MouthPoints), setup.mouthPoints.data(), setup.mouthPoints.size() * sizeof setup.mouthPoints[0]);
  staging_->add(slotOf(FluidArray::Keyframes), setup.keyframes.data(), setup.keyframes.size() * 4);
  staging_->clear(slotOf(FluidArray::NearTangential));
  staging_->clear(slotOf(FluidArray::SolidSums));
  staging_->clear(slotOf(FluidArray::Commands));
  if (setup.params.tensionRate > 0) staging_->clear(slotOf(FluidArray::SurfaceParticle));
  staging_->clear(slotOf(FluidArray::DensityCommands));
  staging_->clear(slotOf(FluidArray::ContactCommands));
}

void FluidImpl::stageFlows() {
  if (!setup.removes) return;
  staging_->add(slotOf(FluidArray::Flow), &ledger, sizeof ledger);
  staging_->add(slotOf(FluidArray::Emitters), setup.emitters.data(), setup.emitters.size() * sizeof(EmitterRecord));
  staging_->add(slotOf(FluidArray::Drains), setup.drains.data(), setup.drains.size() * sizeof(DrainRecord));
}

void FluidImpl::stageParticles(std::vector<Float3> positions, std::vector<Float3> velocities, std::vector<uint8_t> fluids) {
  using enum FluidArray;
  // The entries without a particle, and the dummy neighbor behind them, are inactive.
  const Float4 inactive{kInactivePosition, kInactivePosition, kInactivePosition, 0.0f};
  const size_t entries = size_t{capacity} + 1;
  // Predictions start as the positions; they and `work` end with the dummy neighbor.
  const float w = rowOf(Position).w;
  if (setup.fluids > 1) {
    fluids.resize(positions.size());
    std::vector<float> tagged;
    for (const uint8_t fluid : fluids) tagged.push_back(taggedFluid(fluid));
    staging_->add(slotOf(Prediction), buffer(Prediction).size(), quads(positions, std::move(tagged), w, inactive, entries));
  }
  std::vector<float> stored(fluids.begin(), fluids.end());
  staging_->add(slotOf(Position), buffer(Position).size(), quads(std::move(positions), std::move(stored), w, inactive, entries));
  if (setup.fluids == 1) staging_->addSame(slotOf(Prediction), slotOf(Position));
  staging_->addSame(slotOf(Work), slotOf(Position));
  staging_->add(slotOf(Velocity), buffer(Velocity).size(),
                quads(std::move(velocities), {}, rowOf(Velocity).w, Float4{0, 0, 0, 1}, entries));
}

void FluidImpl::stageConcentrations(std::vector<Float4> given, const std::vector<uint8_t>& fluids) {
  if (!(setup.params.maxDiffusionRate > 0)) return;
  given.reserve(size_t{capacity} + 1);
  for (size_t i = given.size(); i < count; ++i) given.push_back(unmixed(setup.params, i < fluids.size() ? fluids[i] : uint8_t{0}));
  given.resize(size_t{capacity} + 1);  // with the dummy neighbor
  const uint64_t bytes = given.size() * sizeof given[0];
  staging_->add(slotOf(FluidArray::Concentration), bytes, bytesOf(std::move(given)));
}

void FluidImpl::stageStart(const ParticleSet& particles, bool settle) {
  std::vector<Float3> positions = particles.positions, velocities = particles.velocities;
  std::vector<uint32_t> id(count);
  FluidSums sums{};
  float fastest = 0;
  double squares = 0, motion = 0;
  for (uint32_t i = 0; i < count; ++i) {
    Float3 &x = positions[i], &v = velocities[i];
    const float speed = speedOf(v);
    const bool good = finite(x) && std::isfinite(speed);  // a speed that overflows would make every step 0
    if (!good) {
      ++sums.nonFinite;
      x = {kInactivePosition, kInactivePosition, kInactivePosition};
      v = {};
    }
    if (good) {
      const double squared = double{speed} * speed;
      fastest = std::max(fastest, speed), squares += squared;
      motion += std::min(squared / setup.params.layerHead, double{kMaxMotion});
    }
    id[i] = i;
  }
  sums.speedMax = std::bit_cast<uint32_t>(fastest);
  const auto motionUnits = static_cast<uint64_t>(std::round(motion / kMotionUnit));
  sums.motionLow = static_cast<uint32_t>(motionUnits), sums.motionHigh = static_cast<uint32_t>(motionUnits >> 32);
  sums.bodySpeed = std::bit_cast<uint32_t>(setup.params.bodySpeed);

  FluidControl control{};
  control.count = control.solved = count;
  control.listState = kListNone;
  control.speed = fastest;
  control.flowSpeed = std::min(fastest, kFlowTimes * static_cast<float>(std::sqrt(squares / std::max(count, 1u))));
  control.nextPhase = settle ? kPhaseSettling : kPhaseAdvancing;
  control.phaseLeft = settle ? kSettleSubsteps : 0;
  control.head = static_cast<float>(setup.head);
  control.desiredStep = static_cast<float>(setup.firstStep);
  control.emissionWait = kNever;

  stageConcentrations(particles.concentrations, particles.fluids);
  stageParticles(std::move(positions), std::move(velocities), setup.fluids > 1 ? particles.fluids : std::vector<uint8_t>());
  staging_->add(slotOf(FluidArray::Control), sizeof control, bytesOf(std::vector{control}));
  staging_->add(slotOf(FluidArray::Sums), sizeof sums, bytesOf(std::vector{sums}));
  staging_->add(slotOf(FluidArray::Solids), setup.solids.data(), setup.solids.size() * sizeof(SolidRecord));
  staging_->clear(slotOf(FluidArray::SolidLoads));
  staging_->add(slotOf(FluidArray::Bodies), setup.bodies.data(), setup.bodies.size() * sizeof(BodyRecord));
  staging_->clear(slotOf(FluidArray::Slips));
  staging_->add(slotOf(FluidArray::PressureProbes), setup.pressureProbes.data(), setup.pressureProbes.size() * sizeof(PressureProbeRecord));
  staging_->add(slotOf(FluidArray::Id), id.size() * 4, bytesOf(id));
  staging_->clear(slotOf(FluidArray::Warm));
  staging_->clear(slotOf(FluidArray::WarmAcceleration));
  staging_->clear(slotOf(FluidArray::Rest));
  staging_->clear(slotOf(FluidArray::Regions));
  ledger = firstLedger(count, sums.nonFinite);
  for (uint32_t i = 0; i < count && setup.fluids > 1; ++i) {
    const uint8_t fluid = particles.fluids.empty() ? 0 : particles.fluids[i];
    ++ledger.filledOf[fluid];
    if (!finite(particles.positions[i]) || !std::isfinite(speedOf(particles.velocities[i]))) ++ledger.inactiveOf[fluid];
  }
  stageFlows();
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

// `snapshot` has been checked; it lives until the staging is made.
void FluidImpl::stageSnapshot(const FluidSnapshot& s) {
  resumed_ = true;
  stageParticles(s.position, s.velocity, s.fluid);
  stageConcentrations(s.concentration, s.fluid);
  staging_->add(slotOf(FluidArray::Control), s.control.data(), s.control.size() * 4);
  std::vector<uint32_t> sums = s.sums;
  if (setup.params.solidCount > 0) sums[offsetof(FluidSums, nearSolids) / 4] = static_cast<uint32_t>(nearSolidCount(s));
  // Which particles are near mouths is not kept: until the next rebuild, all may be.
  const auto nearMouths = static_cast<uint32_t>(setup.emitters.empty() ? 0 : s.id.size());
  sums[offsetof(FluidSums, nearMouths) / 4] = nearMouths;
  sums[offsetof(FluidSums, inReach) / 4] = 0;  // between substeps; what was reached is counted anew before its list is read
  uint32_t& reached = sums[offsetof(FluidSums, reached) / 4];
  reached = std::min(reached, sums[offsetof(FluidSums, nearSolids) / 4]);
  staging_->add(slotOf(FluidArray::Sums), sums.size() * 4, bytesOf(sums));
  std::vector<uint32_t> all(nearMouths);
  std::iota(all.begin(), all.end(), 0u);
  staging_->add(slotOf(FluidArray::NearMouths), all.size() * 4, bytesOf(all));
  std::vector<SolidRecord> solids = setup.solids;
  for (size_t k = 0; kPoseNumbers * k < s.solids.size(); ++k) solids[k].pose = poseAt(s.solids, k);
  for (DrivenSolid& driven : setup.driven) driven.pose = poseAt(s.solids, driven.solid);
  staging_->add(slotOf(FluidArray::Solids), solids.size() * sizeof(SolidRecord), bytesOf(solids));
  std::vector<BodyRecord> bodies = setup.bodies;  // of the snapshot, their states and what the last substep left
  for (size_t k = 0; k < bodies.size(); ++k) {
    BodyRecord saved;
    std::memcpy(&saved, s.bodies.data() + k * kBodyWords, sizeof saved);
    bodies[k].state = saved.state;
    bodies[k].predicted = saved.predicted;
    bodies[k].held = saved.held;
    bodies[k].stopped = saved.stopped;
    bodies[k].stiffness = saved.stiffness * std::sqrt(saved.mass / bodies[k].mass);  // the host may have changed its mass
  }
  takeBodies(std::as_bytes(std::span(bodies)));
  staging_->add(slotOf(FluidArray::Bodies), bodies.size() * sizeof(BodyRecord), bytesOf(bodies));
  staging_->add(slotOf(FluidArray::Slips), s.slips.data(), s.slips.size() * sizeof s.slips[0]);
  std::vector<PressureProbeRecord> probes = setup.pressureProbes;
  for (size_t k = 0; k < probes.size() && kPressureProbeWords * k < s.pressures.size(); ++k) {
    PressureProbeRecord saved;
    std::memcpy(&saved, s.pressures.data() + k * kPressureProbeWords, sizeof saved);
    if (std::tie(saved.x, saved.y, saved.z) == std::tie(probes[k].x, probes[k].y, probes[k].z)) probes[k] = saved;  // else another scene's
  }
  takePressures(std::as_bytes(std::span(probes)));
  staging_->add(slotOf(FluidArray::PressureProbes), probes.size() * sizeof(PressureProbeRecord), bytesOf(probes));
  if (setup.removes) resumeFlows(s);
  stageFlows();
  if (s.regions.empty())
    staging_->clear(slotOf(FluidArray::Regions));
  else
    staging_->add(slotOf(FluidArray::Regions), s.regions.data(), s.regions.size() * 4);
  takeLoads(std::as_bytes(std::span(s.loads)));
  if (setup.loads && !s.loads.empty())
    staging_->add(slotOf(FluidArray::SolidLoads), s.loads.data(), s.loads.size() * sizeof s.loads[0]);
  else
    staging_->clear(slotOf(FluidArray::SolidLoads));
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
  if (setup.params.solidCount > 0) {
    std::vector<uint32_t> near = layOutNearSolids(s, nearSolidQuads(setup.params.solidCount));
    const uint64_t bytes = near.size() * 4;
    staging_->add(slotOf(FluidArray::NearSolids), bytes, bytesOf(std::move(near)));
  }
  if (rowOf(FluidArray::ListHead).length(shape) > 0) {
    std::vector<uint32_t> heads = layOutHeads(s);
    if (nearMouths > 0)
      for (uint32_t& head : heads) head |= kNearMouthsBit;
    const uint64_t bytes = heads.size() * 4;
    staging_->add(slotOf(FluidArray::ListHead), bytes, bytesOf(std::move(heads)));
  }
  if (!hasNeighbors(s)) return;
  if (!s.cell.empty()) {
    staging_->add(slotOf(FluidArray::Cell), s.cell.data(), s.cell.size() * 4);
    std::vector<uint32_t> start(keyRange(setup) + 1);
    cellStarts(s.cell, start);
    staging_->add(slotOf(FluidArray::CellStart), start.size() * 4, bytesOf(start));
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
