// What comes back from the device: the figures of finished frames.
#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

#include "fluid/body_figures.hpp"
#include "fluid/fluid_impl.hpp"
#include "graph/graph_impl.hpp"

namespace rill {
namespace {

template <class Record>
bool read(std::span<const std::byte> bytes, Record& record) {
  if (bytes.size() < sizeof record) return false;
  std::memcpy(&record, bytes.data(), sizeof record);
  return true;
}

/// Record `k` of an array; none beyond the array's end.
template <class Record>
std::optional<Record> recordAt(std::span<const std::byte> array, size_t k) {
  Record record{};
  if (!read(array.subspan(std::min(k * sizeof record, array.size())), record)) return {};
  return record;
}

SolidLoad loadOf(const SolidLoadRecord& r) {
  SolidLoad load;
  const auto sum = [&](size_t c) { return double{r.impulseHigh[c]} + r.impulseLow[c]; };
  for (size_t a = 0; a < 3; ++a) {
    load.force[a] = r.mean[a];
    load.torque[a] = r.mean[a + 3];
    load.impulse[a] = sum(a);
    load.angularImpulse[a] = sum(a + 3);
  }
  return load;
}

}  // namespace

void FluidImpl::takeBodies(std::span<const std::byte> records) const {
  for (size_t k = 0; k < bodyRecords.size(); ++k) {
    const auto record = recordAt<BodyRecord>(records, k);
    if (!record) return;
    bodyRecords[k] = *record;
    bodyMotions[k] = motionOf(*record, origin);
  }
}

void FluidImpl::takePressures(std::span<const std::byte> records) const {
  for (size_t k = 0; k < pressures.size(); ++k) {
    const auto record = recordAt<PressureProbeRecord>(records, k);
    if (!record) return;
    pressures[k] = {.mean = record->mean, .integral = double{record->integralHigh} + record->integralLow, .covered = record->covered != 0};
  }
}

void FluidImpl::takeLoads(std::span<const std::byte> records) const {
  for (size_t k = 0; k < solidLoads.size(); ++k) {
    const auto record = recordAt<SolidLoadRecord>(records, k);
    if (!record) return;
    solidLoads[k] = loadOf(*record);
  }
}

// The ledger, and what went through each emitter and drain.
void FluidImpl::takeFlows(std::span<const std::byte> flow, std::span<const std::byte> emitters, std::span<const std::byte> drains) const {
  if (!read(flow, ledger)) return;
  const double volume = std::pow(double{setup.params.spacing}, 3);
  const auto take = [&](FlowReading& reading, uint32_t particles, double blocked_s) {
    reading = {.particles = particles, .volume = particles * volume, .blocked_s = blocked_s};
  };
  for (size_t k = 0; k < emitted.size(); ++k)
    if (const auto r = recordAt<EmitterRecord>(emitters, k)) take(emitted[k], r->emitted, double{r->blockedHigh} + r->blockedLow);
  for (size_t k = 0; k < drained.size(); ++k)
    if (const auto r = recordAt<DrainRecord>(drains, k)) take(drained[k], r->drained, 0);
}

std::vector<FluidPassRuns> FluidImpl::passRuns() const {
  const Executed done{executed_.substeps - executedBefore_.substeps,     executed_.iterations - executedBefore_.iterations,
                      executed_.builds - executedBefore_.builds,         executed_.noiseDampings - executedBefore_.noiseDampings,
                      executed_.diffusions - executedBefore_.diffusions, executed_.fallsAsleep - executedBefore_.fallsAsleep};
  const auto executed = [&](Start start) {
    switch (start) {
      case Start::Iterate:
        return done.iterations - done.substeps;
      case Start::NoiseDamping:
        return done.noiseDampings;
      case Start::Diffusion:
        return done.diffusions;
      case Start::Rebuild:
        return done.builds;
      case Start::FallAsleep:
        return done.fallsAsleep;
      default:
        return done.substeps;
    }
  };
  const auto recorded = [&](FluidPass pass, Start start) {
    const auto p = static_cast<size_t>(pass), k = static_cast<size_t>(start);
    return recordedLast_.passes[p][k] - recordedBefore_.passes[p][k];
  };
  std::vector<FluidPassRuns> all;
  for (const FluidPassRow& row : fluidPassTable()) {
    FluidPassRuns runs{row.name, 0, 0};
    for (Start start : row.starts) {
      if (start == Start::Always || start == Start::Predict || start == Start::Figures) continue;  // whatever is recorded of these runs
      const uint32_t times = recorded(row.id, start), substeps = recordedLast_.substeps - recordedBefore_.substeps;
      const bool everySubstep = start == Start::Density || start == Start::Correct;
      if (times > 0) runs.executed += executed(start) * (everySubstep ? std::max(times / std::max(substeps, 1u), 1u) : 1u);
      runs.recorded += times;
    }
    if (runs.recorded > 0) all.push_back(runs);
  }
  const uint32_t sorts = recordedLast_.sorts - recordedBefore_.sorts, rebuilds = recorded(FluidPass::Keys, Start::Rebuild);
  if (sorts > 0) all.push_back({"sort/", done.builds + (sorts - rebuilds), sorts});
  return all;
}

FluidLedger FluidImpl::ledgerOf(uint32_t particles, uint32_t inactive) const {
  if (!setup.removes) return {.filled = particles, .inactive = inactive};
  return {.filled = ledger.filled,
          .emitted = ledger.emitted,
          .drained = ledger.drained,
          .left = ledger.left,
          .inactive = ledger.inactive,
          .full = ledger.full != 0,
          .outOfIds = ledger.outOfIds != 0};
}

std::vector<FluidFigures> FluidImpl::figuresOfFluids(std::span<const std::byte> measured, const FluidStats& all) const {
  if (setup.fluids == 1)
    return {{.particles = setup.removes ? all.particles : all.particles - all.ledger.inactive,
             .ledger = all.ledger,
             .densityErrorMean = all.densityErrorMean,
             .densityErrorMax = all.densityErrorMax}};
  std::vector<FluidFigures> fluids(setup.fluids);
  for (size_t k = 0; k < fluids.size(); ++k) {
    const auto r = recordAt<FluidFigureRecord>(measured, k);
    if (!r) continue;
    fluids[k] = {.particles = r->particles,
                 .ledger = ledgerOf(r->particles + r->inactive, r->inactive),
                 .densityErrorMean = (r->errorHigh * 4294967296.0 + r->errorLow) * kErrorUnit / std::max(r->particles, 1u),
                 .densityErrorMax = std::bit_cast<float>(r->errorMax)};
    if (!setup.removes) continue;
    FluidLedger& own = fluids[k].ledger;
    own.filled = ledger.filledOf[k], own.inactive = ledger.inactiveOf[k];
    own.emitted = ledger.emittedOf[k], own.drained = ledger.drainedOf[k], own.left = ledger.leftOf[k];
  }
  return fluids;
}

FluidStats FluidImpl::statsOf(const MeasureResult& result, std::span<const std::byte> fluids, const FluidControl& control,
                              const FluidSums& sums) const {
  const MeasurePartial& m = result.sums;
  const double n = std::max(control.count - m.inactive, 1u), mass = setup.params.particleMass;
  FluidStats s;
  s.time_s = progress.time_s;
  s.particles = setup.removes ? control.count - m.inactive : control.count;
  s.substeps = control.substeps;
  s.iterations = control.iterations;
  s.timeDropped_s = control.timeDropped;
  s.densityErrorMean = m.compression / n;
  s.densityErrorP99 = result.compression99;
  s.densityErrorMax = m.compressionMax;
  s.densitySignedMedian = result.signedMedian;
  s.kinetic_J = 0.5 * mass * m.kinetic;
  const double masses = m.mass > 0 ? m.mass : 1;
  const Double3 sum = {m.positionX + masses * origin[0], m.positionY + masses * origin[1], m.positionZ + masses * origin[2]};
  const Double3 gravity = {control.gravityX, control.gravityY, control.gravityZ};
  const Double3 velocity = {m.velocityX, m.velocityY, m.velocityZ};
  for (int a = 0; a < 3; ++a) {
    s.potential_J -= mass * gravity[a] * sum[a];
    s.momentum[a] = mass * velocity[a];
    s.centerOfMass[a] = sum[a] / masses;
  }
  if (setup.params.sleeps != 0) s.sleeping = control.sleep != kAwake ? control.count : sums.asleep;
  if (!bodyRecords.empty()) s.bodies = figuresOf(bodyRecords, origin, gravity);
  s.maxSpeed = m.speedMax;
  s.nonFinite = sums.nonFinite;
  s.outside = setup.removes ? m.outside - m.inactive : m.outside;  // inactive ones are about to be removed
  s.ledger = ledgerOf(control.count, m.inactive);
  s.fluids = figuresOfFluids(fluids, s);
  s.emitterBlocked_s = double{ledger.blockedHigh} + ledger.blockedLow;
  for (const FlowReading& reading : emitted) s.emittersBlocked_s.push_back(reading.blocked_s);
  s.neighborOverflow = sums.overflow;
  s.loopBoundHits = sums.boundHits;
  s.viscosityBoundHits = sums.viscosityBoundHits;
  s.viscosityCapped = sums.viscosityCapped;
  s.diffusionBoundHits = sums.diffusionBoundHits;
  s.listBuilds = control.builds;
  s.artificialViscosity_Pa_s = setup.artificialViscosity * control.restFraction;
  return s;
}

void FluidImpl::poll() const {
  while (!pending_.empty()) {
    FluidControl control{};
    FluidSums sums{};
    const auto finished = [&](const Pending& p) {
      const auto graph = p.graph.lock();
      return graph && read(graph->data(p.control), control) && read(graph->data(p.sums), sums);
    };
    // A frame whose results were not read in time, or whose graph is gone, does not block later ones.
    const auto next = std::find_if(pending_.begin(), pending_.end(), finished);
    if (next == pending_.end()) return;
    for (auto given_up = pending_.begin(); given_up != next; ++given_up)
      if (given_up->uploads) staging_.reset();
    pending_.erase(pending_.begin(), next);
    const Pending& pending = pending_.front();
    executedBefore_ = std::exchange(executed_, {control.executedSubsteps, control.executedIterations, control.executedBuilds,
                                                control.executedNoiseDampings, control.executedDiffusions, control.executedFallsAsleep});
    recordedBefore_ = std::exchange(recordedLast_, pending.recorded);
    count = control.count;
    progress = {.known = true,
                .time_s = double{control.timeHigh} + control.timeLow,
                .timeLeft_s = control.timeLeft,
                .timeDropped_s = control.timeDropped,
                .substeps = control.substeps,
                .iterations = control.iterations,
                .listBuilds = control.builds,
                .asleep = control.sleep != kAwake};
    if (!setup.bodies.empty()) takeBodies(pending.graph.lock()->data(pending.bodies));
    if (setup.loads) takeLoads(pending.graph.lock()->data(pending.loads));
    if (!pressures.empty()) takePressures(pending.graph.lock()->data(pending.pressures));
    if (setup.removes) {
      const auto graph = pending.graph.lock();
      const auto some = [&](bool has, Ticket ticket) { return has ? graph->data(ticket) : std::span<const std::byte>(); };
      takeFlows(graph->data(pending.flow), some(!setup.emitters.empty(), pending.emitters), some(!setup.drains.empty(), pending.drains));
    }
    MeasureResult result{};
    if (pending.measured && read(pending.graph.lock()->data(pending.measure), result)) {
      const auto fluids = setup.fluids > 1 ? pending.graph.lock()->data(pending.fluidFigures) : std::span<const std::byte>();
      stats = statsOf(result, fluids, control, sums);
    }
    if (pending.uploads) staging_.reset();
    pending_.pop_front();
  }
}

}  // namespace rill
