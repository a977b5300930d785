// Warnings about a run, and the lines on passes and sleep.
#include <algorithm>

#include "capture/record.hpp"
#include "core/words.hpp"
#include "fill/mouth.hpp"

namespace rill::capture {
namespace {

/// "emitters[1] was", "emitters[1], domain.inflow and 2 more were": those that were blocked.
std::string blockedEmitters(const Scene& scene, const std::vector<double>& blocked_s) {
  constexpr size_t kMaxNamed = 3;
  std::string names;
  size_t count = 0;
  for (size_t k = 0; k < blocked_s.size(); ++k)
    if (blocked_s[k] > 0 && ++count <= kMaxNamed) names += (count > 1 ? ", " : "") + emitterKey(scene, k);
  if (count > kMaxNamed) names += " and " + grouped(count - kMaxNamed) + " more";
  return names.empty() ? "emitters were" : names + (count == 1 ? " was" : " were");
}

}  // namespace

std::string Record::passTable() const {
  std::vector<offline::PassTime> passes;
  std::vector<offline::SkippedPass> skipped;
  for (const apps::Instant& frame : frames_) {
    for (const offline::PassTime& pass : frame.stats.passes) {
      auto found = std::ranges::find(passes, pass.name, &offline::PassTime::name);
      if (found == passes.end()) found = passes.insert(passes.end(), {pass.name});
      found->ms += pass.ms;
      found->recorded += pass.recorded;
      found->executed += pass.executed;
    }
  }
  for (const apps::Instant& frame : frames_)
    for (const offline::SkippedPass& skip : frame.stats.skipped)
      if (std::ranges::find(passes, skip.first, &offline::PassTime::name) == passes.end() &&
          std::ranges::find(skipped, skip.first, &offline::SkippedPass::first) == skipped.end())
        skipped.push_back(skip);
  return offline::passTable(passes, skipped);
}

std::string Record::sleepText() const {
  if (frames_.empty() || !frames_.back().stats.sleeping) return {};
  const auto without =
      std::ranges::count_if(frames_, [](const apps::Instant& frame) { return frame.stats.sleeping > 0 && frame.stats.substeps == 0; });
  const offline::Stats& last = frames_.back().stats;
  return "asleep at the end: " + grouped(last.sleeping.value_or(0)) + " of " + grouped(last.particles) + " particles; " +
         std::to_string(without) + " of " + std::to_string(frames_.size()) + " frames without substeps\n";
}

std::vector<std::string> Record::warnings() const {
  std::vector<std::string> warnings;
  if (frames_.empty()) return warnings;
  const offline::Stats& last = frames_.back().stats;
  if (const double dropped = droppedSeconds(); dropped > 0)
    warnings.push_back("warning: " + roundedNumber(dropped) + " s of " + roundedNumber(simulatedSeconds() + dropped) +
                       " s were dropped: " + std::to_string(scene_->solver.max_substeps) +
                       " substeps per frame (solver.max_substeps) are too few for the time step that the fluid's speed and weight and "
                       "solver.time_step allow");
  if (last.viscosityBoundHits > 0)
    warnings.push_back("warning: in " + grouped(last.viscosityBoundHits) + " substeps viscosity needed more steps than its solve takes: " +
                       (!scene_->fluids.empty()          ? "that of the fluids"
                        : scene_->fluid.yield_stress > 0 ? "fluid.yield_stress"
                                                         : "fluid.viscosity") +
                       " acted as less");
  if (last.viscosityCapped > 0)
    warnings.push_back("warning: at the end viscosity acts as less than shear asks for on " + grouped(last.viscosityCapped) + " of " +
                       grouped(last.particles) + " particles: its solve reaches no more in these steps");
  if (last.diffusionBoundHits > 0)
    warnings.push_back("warning: " + grouped(last.diffusionBoundHits) +
                       " steps of diffusion needed more stages than they take: that of the " + "fluids acted as less");
  if (last.loopBoundHits > 0)
    warnings.push_back("warning: loops of the fluid's shaders reached their limit " + grouped(last.loopBoundHits) +
                       " times since the start: some particles have too many neighbors, or bodies touch too many solids");
  if (last.ledger.outOfIds) warnings.push_back("warning: emitters have stopped: the ids of particles have run out");
  if (last.ledger.full || last.emitterBlocked_s > 0)
    warnings.push_back("warning: " + blockedEmitters(*scene_, last.emittersBlocked_s) + " blocked for " +
                       roundedNumber(last.emitterBlocked_s) + " s: " +
                       (last.ledger.full ? "the room for particles (fluid.capacity) was full"
                                         : "a mouth, or a part of one, was in a solid or behind a wall"));
  if (last.nonFinite > 0)
    warnings.push_back("warning: " + grouped(last.nonFinite) + (last.nonFinite == 1 ? " particle is" : " particles are") +
                       " inactive: the position or velocity was not finite");
  if (last.bodies && last.bodies->stopped > 0)
    warnings.push_back("warning: " + grouped(last.bodies->stopped) + (last.bodies->stopped == 1 ? " body was" : " bodies were") +
                       " stopped: farther from the start than positions can be told apart");
  if (last.whitewater && last.whitewater->overflow > 0)
    warnings.push_back("warning: whitewater is incomplete: there was no room for " + grouped(last.whitewater->overflow) +
                       " of its particles");
  if (last.whitewater && last.whitewater->boundHits > 0)
    warnings.push_back("warning: " + grouped(last.whitewater->boundHits) +
                       " sums of whitewater over particles were cut off: too many lie at one place");
  if (const uint64_t hits = pictureBoundHits(); hits > 0) warnings.push_back(boundHitsWarning(hits));
  return warnings;
}

std::string boundHitsWarning(uint64_t hits) {
  return "warning: loops of the renderer's shaders reached their limit " + grouped(hits) + " times: images are incomplete there";
}

}  // namespace rill::capture
