// One step as graph passes: begin, blocks of (rebuild, substeps), measure. See docs/method.md.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/words.hpp"
#include "fluid/fluid_impl.hpp"
#include "gpu/device_impl.hpp"
#include "graph/graph_impl.hpp"
#include "graph/import_whole.hpp"

namespace rill {
namespace {

/// Whether pictures need the solids' records: a mesh's field, or a pose that no keyframe has.
bool drawsFromRecords(const FluidSetup& setup) { return !setup.driven.empty() || !setup.meshWords.empty() || !setup.bodies.empty(); }

}  // namespace

void FluidImpl::importAll(Graph& graph) {
  resetAliases();
  for (const ArrayRow& row : arrayTable())
    if (row.lifetime == Lifetime::Fluid) refs_[slotOf(row.id)] = importWhole(graph, row.label, buffer(row.id));
  for (uint32_t c = 1; c < chunkCount(); ++c)
    refs_[slotOf(FluidArray::List, c)] = importWhole(graph, rowOf(FluidArray::List).label, buffer(FluidArray::List, c));
}

void FluidImpl::declareBegin(Graph& graph, double advance, bool queued, size_t pulls, bool emitters) {
  declare(graph, FluidPass::PlanEmission, Start::Always, EmissionPush{static_cast<float>(advance), 0, queued});
  declare(graph, FluidPass::Begin, Start::Always,
          BeginPush{static_cast<float>(advance), advance > 0 ? drivenSpeed_ : 0.0f, queued, static_cast<uint32_t>(pulls),
                    advance > 0 && (drivenMove_ || emitters), emitters});
  if (!(advance > 0)) return;
  declare(graph, FluidPass::FallAsleep, Start::FallAsleep);
  declare(graph, FluidPass::LoadsAsleep);
  declare(graph, FluidPass::Predict, Start::Predict);
  declare(graph, FluidPass::PredictFirstAtSolids, Start::Predict);
}

void FluidImpl::declareRebuild(Graph& graph) {
  using enum FluidArray;
  ++recording_.sorts;
  beginSection();
  declare(graph, FluidPass::PlanEmission, Start::Always, EmissionPush{0, 1, 0});
  declare(graph, FluidPass::Emit, Start::Rebuild);
  for (FluidPass pass : {FluidPass::RestMotion, FluidPass::RestSolids, FluidPass::RestRegions, FluidPass::RestWake, FluidPass::RestZones})
    declare(graph, pass, Start::Rebuild);
  const Gate gate{ref(Commands), sortCommand_};
  const SortTargets targets{.order = {}, .start = ref(CellStart), .keys = {}};
  sortKeys(graph, FluidPass::Keys, Start::Rebuild, Prediction, targets, &gate);
  ref(CellStart) = ref(SortStart);
  declare(graph, FluidPass::Reorder, Start::Rebuild);
  declare(graph, FluidPass::SortConcentration, Start::Rebuild);
  declare(graph, FluidPass::KeepConcentration, Start::Rebuild);
  declare(graph, FluidPass::BuildList, Start::Rebuild, ChunkPush{});
  declare(graph, FluidPass::NearMouths, Start::Rebuild);
  declare(graph, FluidPass::FinishRebuild);
}

void FluidImpl::sortKeys(Graph& graph, FluidPass keys, Start start, FluidArray places, const SortTargets& targets, const Gate* gate) {
  using enum FluidArray;
  KeyCounters counters = sort_->begin(graph, targets, gate);
  ref(SortStart) = counters.start;
  ref(SortRank) = counters.rank;
  ref(SortOversized) = counters.oversized;
  alias(Place, places);
  declare(graph, keys, start);
  counters = {ref(SortStart), ref(SortRank), ref(SortOversized)};
  const SortedKeys sorted = sort_->finish(graph, ref(Key), counters, targets, gate);
  ref(SortStart) = sorted.start;
  ref(SortArrived) = sorted.arrived;
  ref(SortOrder) = sorted.order;
}

void FluidImpl::declareSkipped(Graph& graph) const {
  for (const FluidPassRow& row : fluidPassTable()) {
    const PassCondition& c = row.condition;
    if (c.holds(setup) || (!c.reason && !c.why)) continue;
    graph.skipped(row.name, c.why ? std::string_view(setup.*c.why) : c.reason);
  }
  if (!(setup.params.tensileRate > 0)) graph.skipped("artificial pressure", setup.whyNoArtificialPressure);
  if (setup.driven.empty()) graph.skipped("drive solids", "the host moves none");
}

FluidState FluidImpl::described() const {
  FluidState state;
  state.capacity = capacity;
  state.spacing = setup.params.spacing;
  state.origin = origin;
  return state;
}

FluidState FluidImpl::present(Graph& graph) const {
  FluidState state = described();
  if (capacity == 0) return state;
  state.position = importWhole(graph, "positions", buffer(FluidArray::Position));
  state.velocity = importWhole(graph, "velocities", buffer(FluidArray::Velocity));
  state.id = importWhole(graph, "ids", buffer(FluidArray::Id));
  if (setup.params.maxDiffusionRate > 0) state.concentration = importWhole(graph, "concentrations", buffer(FluidArray::Concentration));
  state.countBuffer = state.control = importWhole(graph, "control", buffer(FluidArray::Control));
  if (!setup.solids.empty()) state.boundaries = importWhole(graph, "solids", buffer(FluidArray::Solids));
  if (drawsFromRecords(setup)) state.solids = state.boundaries;
  if (!setup.meshWords.empty()) state.meshWords = importWhole(graph, "fields of meshes", buffer(FluidArray::MeshWords));
  if (setup.loads) state.loads = importWhole(graph, "loads on solids", buffer(FluidArray::SolidLoads));
  return state;
}

/// Whether a step is valid. If not, the graph's compile() fails with a message that names the member.
bool FluidImpl::validate(Graph& graph, const FluidStep& step) const {
  if (step.resume) return true;
  const auto invalid = [&](const std::string& what) {
    implOf(graph).fail("FluidStep::" + what);
    return false;
  };
  if (!(step.advance_s >= 0 && step.advance_s <= std::numeric_limits<float>::max()))
    return invalid("advance_s is " + shortestNumber(step.advance_s) + "; expected a finite time of at least 0 (s)");
  if (step.queued && !setup.driven.empty()) return invalid("queued is set; expected false where solids are driven");
  for (size_t k = 0; k < step.targets.size(); ++k) {
    const SolidTarget& target = step.targets[k];
    const std::string name = "targets[" + std::to_string(k) + "].";
    if (target.solid >= setup.solids.size()) return invalid(name + solidOutOfRange(target.solid));
    if (!target.rotation) continue;
    const auto [x, y, z, w] = *target.rotation;
    if (const double length = std::hypot(std::hypot(x, y), std::hypot(z, w)); !(length > 0 && std::isfinite(length)))
      return invalid(name + "rotation is (" + shortestNumber(x) + ", " + shortestNumber(y) + ", " + shortestNumber(z) + ", " +
                     shortestNumber(w) + "); expected a finite quaternion x y z w of a length above 0");
  }
  if (const std::string fault = faultOfPulls(step); !fault.empty()) return invalid(fault);
  if (const std::string fault = faultOfEmitters(step); !fault.empty()) return invalid(fault);
  return true;
}

FluidState FluidImpl::addTo(Graph& graph, const FluidStep& step) {
  FluidState state = described();
  if (!validate(graph, step)) return state;
  if (capacity == 0) {
    for (const char* name : {"build list", "density", "correct", "measure"}) graph.skipped(name, "no particles");
    if (!step.resume) emptyTime_ += step.advance_s;
    FluidStats none;
    none.time_s = emptyTime_;
    none.fluids.resize(setup.fluids);
    stats = none;
    progress = {.known = true, .time_s = emptyTime_};
    return state;
  }

  importAll(graph);
  const bool advances = step.resume || step.advance_s > 0;
  forgetAbandoned();
  const bool uploads = !uploaded_;
  if (uploads) {
    declareUpload(graph);
    // The start is sorted, whether anyone looks at it before the first advance or not: the order of sums is the same.
    if (advances && !resumed_) {
      declareBegin(graph, 0);
      declareRebuild(graph);
    }
  }
  uploaded_ = true;
  if (!step.resume && step.advance_s > 0 && !setup.driven.empty()) declareDrive(graph, step);
  const std::span<const BodyPull> pulls = !step.resume && step.advance_s > 0 ? step.pulls : std::span<const BodyPull>();
  if (!pulls.empty()) declarePulls(graph, pulls);
  if (!step.resume) declareEmitters(graph, step);
  if (!step.resume) declareBegin(graph, std::max(step.advance_s, 0.0), step.queued, pulls.size(), !step.emitters.empty());
  const uint32_t least = setup.params.sleeps != 0 ? 0 : 1;
  const uint32_t blocks = advances ? static_cast<uint32_t>(divideUp(std::max(step.substeps, least), setup.substepsPerBlock)) : 0;
  for (uint32_t block = 0; block < blocks; ++block) {
    declareRebuild(graph);
    for (uint32_t k = 0; k < setup.substepsPerBlock; ++k) declareSubstep(graph, recording_.substeps & 1u, k == 0);
  }
  if (!advances) declareRebuild(graph);  // runs where there has been none yet
  declareSkipped(graph);

  Pending pending{.graph = implOf(graph).weakSelf(), .uploads = uploads};
  if (step.stats)
    declareMeasure(graph, pending);
  else
    graph.skipped("measure", "no figures asked for");
  pending.control = graph.readback(ref(FluidArray::Control));
  pending.sums = graph.readback(ref(FluidArray::Sums));
  if (setup.loads) pending.loads = graph.readback(ref(FluidArray::SolidLoads));
  if (!setup.bodies.empty()) pending.bodies = graph.readback(ref(FluidArray::Bodies));
  if (!setup.pressureProbes.empty()) pending.pressures = graph.readback(ref(FluidArray::PressureProbes));
  if (setup.removes) pending.flow = graph.readback(ref(FluidArray::Flow));
  if (!setup.emitters.empty()) pending.emitters = graph.readback(ref(FluidArray::Emitters));
  if (!setup.drains.empty()) pending.drains = graph.readback(ref(FluidArray::Drains));
  pending.recorded = recording_;
  pending_.push_back(pending);
  while (pending_.size() > 8) pending_.pop_front();

  state.position = ref(FluidArray::Position);
  state.velocity = ref(FluidArray::Velocity);
  state.id = ref(FluidArray::Id);
  if (setup.params.maxDiffusionRate > 0) state.concentration = ref(FluidArray::Concentration);
  state.countBuffer = state.control = ref(FluidArray::Control);
  if (!setup.solids.empty()) state.boundaries = ref(FluidArray::Solids);
  if (drawsFromRecords(setup)) state.solids = state.boundaries;
  if (!setup.meshWords.empty()) state.meshWords = ref(FluidArray::MeshWords);
  if (setup.loads) state.loads = ref(FluidArray::SolidLoads);
  return state;
}

}  // namespace rill
