// What comes back from the device: the figures of finished frames.
#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

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

}  // namespace

std::vector<FluidPassRuns> FluidImpl::passRuns() const {
  const FluidParams& p = setup.params;
  const uint32_t substeps = recordedLast_.substeps - recordedBefore_.substeps, blocks = recordedLast_.blocks - recordedBefore_.blocks;
  const uint32_t rebuilds = recordedLast_.rebuilds - recordedBefore_.rebuilds, sorts = recordedLast_.sorts - recordedBefore_.sorts;
  const uint32_t ran = ran_.substeps - ranBefore_.substeps, iterations = ran_.iterations - ranBefore_.iterations;
  const uint32_t builds = ran_.builds - ranBefore_.builds, calms = ran_.calms - ranBefore_.calms;
  const bool smooths = setup.viscositySweeps > 0, swirls = p.vorticity > 0, keeps = setup.viscositySweeps % 2 == 1,
             calm = p.noiseDampingRate > 0;
  std::vector<FluidPassRuns> all;
  const auto add = [&](bool declared, uint32_t did, uint32_t of, std::initializer_list<std::string_view> names) {
    for (std::string_view name : names)
      if (declared && of > 0) all.push_back({name, did, of});
  };
  add(true, builds, rebuilds, {"keys", "reorder", "build list"});
  add(true, builds + (sorts - rebuilds), sorts, {"sort/"});
  add(setup.near, iterations, substeps * p.iterations, {"walls and solids"});
  add(true, iterations, substeps * p.iterations, {"density"});
  add(true, iterations - ran, substeps * (p.iterations - 1), {"iterate"});
  add(true, ran, substeps, {"correct"});
  add(setup.movingSolids, ran, substeps, {"move solids"});
  add(p.solidCount > 0, ran, substeps, {"collide"});
  if (smooths || swirls)
    add(p.solidCount > 0, ran, substeps, {"predict after terms"});
  else
    add(p.solidCount > 0 && calm, ran_.blocks - ranBefore_.blocks, blocks, {"predict after terms"});
  add(smooths, ran, substeps, {"viscosity"});
  add(swirls, ran, substeps, {"curl", "confine"});
  add(calm, calms, blocks, {"noise damping"});
  add(keeps || calm, (keeps ? ran : 0) + calms, (keeps ? substeps : 0) + (calm ? blocks : 0), {"copy velocities"});
  return all;
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
    ranBefore_ = std::exchange(ran_, {control.executedSubsteps, control.executedIterations, control.executedBuilds, control.executedBlocks,
                                      control.executedNoiseDampings});
    recordedBefore_ = std::exchange(recordedLast_, pending.recorded);
    progress = {.known = true,
                .time_s = double{control.timeHigh} + control.timeLow,
                .time_left_s = control.timeLeft,
                .time_dropped_s = control.timeDropped,
                .substeps = control.substeps,
                .iterations = control.iterations,
                .list_builds = control.builds};
    MeasureResult result{};
    if (pending.measured && read(pending.graph.lock()->data(pending.measure), result)) {
      const MeasurePartial& m = result.sums;
      const double n = std::max(count - m.inactive, 1u), mass = setup.params.particleMass;
      FluidStats s;
      s.time_s = progress.time_s;
      s.particles = count;
      s.substeps = control.substeps;
      s.iterations = control.iterations;
      s.time_dropped_s = control.timeDropped;
      s.density_error_mean = m.compression / n;
      s.density_error_p99 = result.compression99;
      s.density_error_max = m.compressionMax;
      s.density_signed_median = result.signedMedian;
      s.kinetic_J = 0.5 * mass * m.kinetic;
      const double sum[3] = {m.positionX + n * origin[0], m.positionY + n * origin[1], m.positionZ + n * origin[2]};
      const double gravity[3] = {control.gravityX, control.gravityY, control.gravityZ};
      const double velocity[3] = {m.velocityX, m.velocityY, m.velocityZ};
      for (int a = 0; a < 3; ++a) {
        s.potential_J -= mass * gravity[a] * sum[a];
        s.momentum[a] = mass * velocity[a];
        s.center_of_mass[a] = sum[a] / n;
      }
      s.max_speed = m.speedMax;
      s.non_finite = sums.nonFinite;
      s.outside = m.outside;
      s.neighbor_overflow = sums.overflow;
      s.loop_bound_hits = sums.boundHits;
      s.list_builds = control.builds;
      s.artificial_viscosity_Pa_s = setup.artificialViscosity * control.restFraction;
      stats = s;
    }
    if (pending.uploads) staging_.reset();
    pending_.pop_front();
  }
}

}  // namespace rill
