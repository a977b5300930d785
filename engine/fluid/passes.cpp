// One step as graph passes: begin, blocks of (rebuild, substeps), measure. See docs/method.md.
#include <algorithm>
#include <cassert>
#include <limits>

#include "core/words.hpp"
#include "fluid/pass_parts.hpp"
#include "gpu/device_impl.hpp"
#include "graph/graph_impl.hpp"
#include "graph/import_whole.hpp"

namespace rill {

uint32_t FluidImpl::commandCount() const { return kCommandSort + static_cast<uint32_t>(sort_->groups().size()); }

void FluidImpl::importAll(Graph& graph) {
  const auto import = [&](std::string_view name, const Buffer& buffer) { return importWhole(graph, name, buffer); };
  r_.params = import("parameters", buffers_.params);
  r_.control = import("control", buffers_.control);
  r_.sums = import("sums", buffers_.sums);
  r_.shapes = import("shapes", buffers_.shapes);
  r_.commands = import("commands", buffers_.commands);
  r_.gravity = import("gravity", buffers_.gravity);
  r_.tables = import("wall tables", buffers_.tables);
  r_.solids = import("solids", buffers_.solids);
  r_.keyframes = import("keyframes", buffers_.keyframes);
  r_.position = import("positions", buffers_.position);
  r_.velocity = import("velocities", buffers_.velocity);
  r_.prediction = import("predictions", buffers_.prediction);
  r_.warmAcceleration = import("warm pushes", buffers_.warmAcceleration);
  r_.work = import("multipliers", buffers_.work);
  r_.warm = import("warm starts", buffers_.warm);
  r_.id = import("ids", buffers_.id);
  r_.multiplier = import("iteration multipliers", buffers_.multiplier);
  r_.neighborCount = import("neighbor counts", buffers_.neighborCount);
  r_.cell = import("cells", buffers_.cell);
  r_.start = import("cell starts", buffers_.start);
  r_.nearSample = import("wall samples", buffers_.nearSample);
  r_.nearList = import("near list", buffers_.nearList);
  for (size_t c = 0; c < chunks_.size(); ++c) r_.lists[c] = import("neighbor list", buffers_.lists[c]);
}

BufferRef& FluidImpl::versionOf(const Buffer& buffer) {
  const std::pair<const Buffer*, BufferRef*> pairs[] = {{&buffers_.params, &r_.params},
                                                        {&buffers_.control, &r_.control},
                                                        {&buffers_.sums, &r_.sums},
                                                        {&buffers_.shapes, &r_.shapes},
                                                        {&buffers_.commands, &r_.commands},
                                                        {&buffers_.gravity, &r_.gravity},
                                                        {&buffers_.tables, &r_.tables},
                                                        {&buffers_.solids, &r_.solids},
                                                        {&buffers_.keyframes, &r_.keyframes},
                                                        {&buffers_.position, &r_.position},
                                                        {&buffers_.velocity, &r_.velocity},
                                                        {&buffers_.prediction, &r_.prediction},
                                                        {&buffers_.warmAcceleration, &r_.warmAcceleration},
                                                        {&buffers_.work, &r_.work},
                                                        {&buffers_.warm, &r_.warm},
                                                        {&buffers_.id, &r_.id},
                                                        {&buffers_.cell, &r_.cell},
                                                        {&buffers_.neighborCount, &r_.neighborCount},
                                                        {&buffers_.start, &r_.start},
                                                        {&buffers_.nearList, &r_.nearList},
                                                        {&buffers_.nearSample, &r_.nearSample}};
  for (const auto& [owner, ref] : pairs)
    if (owner == &buffer) return *ref;
  const size_t list = static_cast<size_t>(&buffer - buffers_.lists.data());
  assert(list < buffers_.lists.size());
  return r_.lists[list];
}

void FluidImpl::declareBegin(Graph& graph, double advance) {
  graph.pass("begin", [&](Pass& pass) {
    pass.read(r_.params, Use::ComputeUniform);
    pass.read(r_.sums, Use::ComputeRead);
    pass.read(r_.shapes, Use::ComputeRead);
    pass.read(r_.gravity, Use::ComputeRead);
    r_.control = pass.write(r_.control, Use::ComputeWrite);
    r_.commands = pass.write(r_.commands, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(pipes_.begin, {r_.params, r_.control, r_.sums, r_.shapes, r_.commands, r_.gravity});
    const BeginPush push{static_cast<float>(advance), commandCount(), advance > 0 ? drivenSpeed_ : 0.0f};
    return [=](Commands& commands) { commands.dispatch(kernel, 1, push); };
  });
  if (advance <= 0) return;
  graph.pass("predict", [&](Pass& pass) {
    readSwitched(pass, r_);
    for (BufferRef ref : {r_.position, r_.velocity, r_.warmAcceleration}) pass.read(ref, readUse(texel_));
    pass.read(r_.solids, Use::ComputeRead);
    r_.prediction = pass.write(r_.prediction, Use::ComputeWrite);
    const Kernel kernel =
        pass.kernel(pipes_.predict, {r_.params, r_.control, r_.position, r_.velocity, r_.warmAcceleration, r_.prediction, r_.solids});
    return [=, arguments = r_.commands](Commands& commands) { commands.dispatchIndirect(kernel, arguments, commandAt(kCommandPredict)); };
  });
}

/// Declares what keys.comp reads and writes but its uniform blocks and sums.
Kernel FluidImpl::keysKernel(Pass& pass, const ComputePipeline* pipeline, BufferRef places, BufferRef& keys, KeyCounters& counters) {
  pass.read(places, readUse(texel_));
  keys = pass.write(keys, Use::ComputeWrite, true);
  if (!counters.counts()) return pass.kernel(pipeline, {r_.params, r_.control, places, keys, r_.sums, keys, keys, keys});  // not used
  counters.start = pass.write(counters.start, Use::ComputeWrite);
  counters.rank = pass.write(counters.rank, Use::ComputeWrite, true);
  counters.oversized = pass.write(counters.oversized, Use::ComputeWrite);
  return pass.kernel(pipeline, {r_.params, r_.control, places, keys, r_.sums, counters.start, counters.rank, counters.oversized});
}

void FluidImpl::declareRebuild(Graph& graph) {
  ++recording_.rebuilds;
  ++recording_.sorts;
  const uint64_t n = count;
  const Use read = readUse(texel_);
  const Gate gate{r_.commands, kCommandSort};
  const SortTargets targets{.order = {}, .start = r_.start, .keys = {}};
  KeyCounters counters = sort_->begin(graph, targets, &gate);
  BufferRef keys = graph.create("cell keys", {n * 4});
  graph.pass("keys", [&](Pass& pass) {
    readSwitched(pass, r_);
    r_.sums = pass.write(r_.sums, Use::ComputeWrite);
    const Kernel kernel = keysKernel(pass, pipes_.keys, r_.prediction, keys, counters);
    return [=, arguments = r_.commands](Commands& commands) { commands.dispatchIndirect(kernel, arguments, commandAt(kCommandKeys)); };
  });
  const SortedKeys sorted = sort_->finish(graph, keys, counters, targets, &gate);
  r_.start = sorted.start;

  BufferRef position = graph.create("sorted positions", {n * 16}), prediction = graph.create("sorted predictions", {n * 16});
  BufferRef velocity = graph.create("sorted velocities", {n * 16});
  graph.pass("reorder", [&](Pass& pass) {
    readSwitched(pass, r_);
    for (BufferRef ref : {keys, sorted.start, sorted.arrived, sorted.order, r_.position, r_.prediction, r_.velocity, r_.warm, r_.id})
      pass.read(ref, read);
    for (BufferRef* ref : {&position, &prediction, &velocity}) *ref = pass.write(*ref, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(pipes_.reorder, {r_.params, r_.control, keys, sorted.start, sorted.arrived, sorted.order, r_.position,
                                                       r_.prediction, r_.velocity, r_.warm, r_.id, position, prediction, velocity});
    return [=, arguments = r_.commands](Commands& commands) { commands.dispatchIndirect(kernel, arguments, commandAt(kCommandReorder)); };
  });
  graph.pass("build list", [&](Pass& pass) {
    readSwitched(pass, r_);
    for (BufferRef ref : {prediction, r_.start, position, velocity}) pass.read(ref, read);
    pass.read(r_.solids, Use::ComputeRead);
    for (BufferRef* ref : {&r_.neighborCount, &r_.cell, &r_.sums, &r_.position, &r_.prediction, &r_.velocity, &r_.warm, &r_.id,
                           &r_.nearSample, &r_.nearList})
      *ref = pass.write(*ref, Use::ComputeWrite);
    std::array<Kernel, kMaxListChunks> kernels;
    for (uint32_t c = 0; c < chunkCount(); ++c) {
      r_.lists[c] = pass.write(r_.lists[c], Use::ComputeWrite);
      kernels[c] = pass.kernel(
          pipes_.build, {r_.params, r_.control, prediction, r_.lists[c], r_.neighborCount, r_.cell, r_.start, r_.sums, position, velocity,
                         r_.position, r_.prediction, r_.velocity, r_.warm, r_.id, r_.nearSample, r_.nearList, r_.solids});
    }
    return [=, arguments = r_.commands, chunks = std::span<const Chunk>(chunks_)](Commands& commands) {
      for (size_t c = 0; c < chunks.size(); ++c)
        commands.dispatchIndirect(kernels[c], arguments, commandAt(kCommandBuild), ChunkPush{chunks[c].first, chunks[c].last, 0});
    };
  });
  graph.pass("finish rebuild", [&](Pass& pass) {
    pass.read(r_.params, Use::ComputeUniform);
    pass.read(r_.sums, Use::ComputeRead);
    pass.read(r_.shapes, Use::ComputeRead);
    pass.read(r_.gravity, Use::ComputeRead);
    r_.control = pass.write(r_.control, Use::ComputeWrite);
    r_.commands = pass.write(r_.commands, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(pipes_.finishRebuild, {r_.params, r_.control, r_.sums, r_.shapes, r_.commands, r_.gravity});
    return [=](Commands& commands) { commands.dispatch(kernel, 1); };
  });
}

void FluidImpl::declareSkipped(Graph& graph) {
  const FluidParams& p = setup.params;
  if (!setup.near) graph.skipped("walls and solids", "no domain and no solids");
  if (p.solidCount == 0) graph.skipped("collide", "no solids");
  if (!setup.movingSolids) graph.skipped("move solids", "no solid moves");
  if (setup.driven.empty()) graph.skipped("drive solids", "the host moves none");
  if (p.iterations == 1) graph.skipped("iterate", "one iteration a substep");
  if (setup.viscositySweeps == 0) graph.skipped("viscosity", "viscosity is 0");
  if (p.noiseDampingRate <= 0) graph.skipped("noise damping", setup.whyNoNoiseDamping);
  if (p.vorticity <= 0) graph.skipped("curl, confine", "vorticity is 0");
  if (p.tensileRate <= 0) graph.skipped("tensile term", setup.whyNoArtificialPressure);
}

FluidState FluidImpl::described() const {
  FluidState state;
  state.count = count;
  state.spacing = setup.params.spacing;
  std::copy(origin, origin + 3, state.origin);
  return state;
}

FluidState FluidImpl::present(Graph& graph) const {
  FluidState state = described();
  if (count == 0) return state;
  state.position = importWhole(graph, "positions", buffers_.position);
  state.velocity = importWhole(graph, "velocities", buffers_.velocity);
  state.id = importWhole(graph, "ids", buffers_.id);
  state.control = importWhole(graph, "control", buffers_.control);
  if (!setup.driven.empty()) state.solids = importWhole(graph, "solids", buffers_.solids);
  return state;
}

/// Whether a host can have meant it; the graph's compile() says what not.
bool FluidImpl::possible(Graph& graph, const FluidStep& step) const {
  if (step.resume) return true;
  const auto invalid = [&](const std::string& what) {
    implOf(graph).fail("FluidStep::" + what);
    return false;
  };
  if (!(step.advance_s >= 0 && step.advance_s <= std::numeric_limits<float>::max()))
    return invalid("advance_s is " + shortestNumber(step.advance_s) + "; expected a finite time of at least 0 (s)");
  for (size_t k = 0; k < step.targets.size(); ++k)
    if (step.targets[k].solid >= setup.solids.size())
      return invalid("targets[" + std::to_string(k) + "].solid is " + std::to_string(step.targets[k].solid) + "; the scene has " +
                     std::to_string(setup.solids.size()) + (setup.solids.size() == 1 ? " solid" : " solids"));
  return true;
}

FluidState FluidImpl::addTo(Graph& graph, const FluidStep& step) {
  FluidState state = described();
  if (!possible(graph, step)) return state;
  if (count == 0) {
    for (const char* name : {"build list", "density", "correct", "measure"}) graph.skipped(name, "no particles");
    if (!step.resume) emptyTime_ += step.advance_s;
    FluidStats none;
    none.time_s = emptyTime_;
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
  if (!step.resume) declareBegin(graph, std::max(step.advance_s, 0.0));
  const uint32_t blocks = advances ? static_cast<uint32_t>(divideUp(std::max(step.substeps, 1u), setup.substepsPerBlock)) : 0;
  for (uint32_t block = 0; block < blocks; ++block) {
    declareRebuild(graph);
    for (uint32_t k = 0; k < setup.substepsPerBlock; ++k) declareSubstep(graph, recording_.substeps & 1u, k == 0);
  }
  if (blocks == 0) declareRebuild(graph);  // runs where there has been none yet
  declareSkipped(graph);

  Pending pending{implOf(graph).weakSelf(), {}, {}, {}, false, uploads, {}};
  if (step.stats)
    declareMeasure(graph, pending);
  else
    graph.skipped("measure", "no figures asked for");
  pending.control = graph.readback(r_.control);
  pending.sums = graph.readback(r_.sums);
  pending.recorded = recording_;
  pending_.push_back(pending);
  while (pending_.size() > 8) pending_.pop_front();

  state.position = r_.position;
  state.velocity = r_.velocity;
  state.id = r_.id;
  state.control = r_.control;
  if (!setup.driven.empty()) state.solids = r_.solids;
  return state;
}

}  // namespace rill
