// Opening a simulation: its particles, device, fluid and whitewater.
#include <algorithm>

#include "core/words.hpp"
#include "offline/open_context.hpp"
#include "offline/simulation_impl.hpp"
#include "offline/whitewater_run.hpp"
#include "rill/version.hpp"

namespace rill::offline {

Expected<void> Simulation::Impl::place(std::optional<ParticleSet> given) {
  if (auto valid = checkScene(scene_); !valid) return valid;
  if (auto valid = Painter::checkOptions(options_); !valid) return valid;
  constexpr double kShortestFrame = 1e-6;  // s; limits the number of frames of an advance
  if (!(options_.longestFrame_s >= kShortestFrame))
    return Error{ErrorKind::BadInput, "Options::longestFrame_s is " + shortestNumber(options_.longestFrame_s) + "; expected at least " +
                                          shortestNumber(kShortestFrame) + " (s)"};
  auto start = given ? Expected<ParticleSet>(std::move(*given)) : makeParticles(scene_);
  if (!start) return start.error();
  start_ = std::move(*start);
  if (start_.spacing > 0) scene_.fluid.spacing = start_.spacing;
  return {};
}

Expected<void> Simulation::Impl::open(const Checkpoint* from) {
  if (from)
    if (const std::string difference = firstDifference(from->keys, simulationKeys(scene_, start_)); !difference.empty())
      return Error{ErrorKind::BadInput, "the checkpoint was written by another scene: " + difference};
  auto context = openContext(options_, PieceQueue::kMaxInFlight);
  if (!context) return context.error();
  context_ = std::move(*context);
  auto fluid = Fluid::create(context_->device(), {.scene = &scene_, .particles = &start_, .snapshot = from ? &from->fluid : nullptr});
  if (!fluid) return fluid.error().kind == ErrorKind::OutOfMemory ? withMemoryNeeded(fluid.error()) : fluid.error();
  fluid_ = std::move(*fluid);
  advances_.emplace(*context_, advanceGraph_);
  advances_->setFluid(*fluid_, scene_);
  if (from) {
    time_s_ = from->time_s;
    addResumeWarnings(*from);
  }
  for (Graph* graph : {&advanceGraph_, &measureGraph_, &whiteGraph_}) graph->enableTimings(options_.passTimes);
  pictures_.enableTimings(options_.passTimes);
  return scene_.look.whitewater && fluid_->capacity() > 0 ? openWhitewater(from) : Expected<void>();
}

Error Simulation::Impl::withMemoryNeeded(Error error) const {
  const auto mebibytes = [](uint64_t bytes) { return grouped(bytes >> 20) + " MiB"; };
  const DeviceInfo& device = context_->device().info();
  const uint64_t particles = fluidCapacity();
  error.message += "\n" + grouped(particles) + " particles need " + mebibytes(fluidMemory(scene_, particles).total()) + " on the device; " +
                   inQuotes(device.name) + " has " + mebibytes(device.deviceLocalBytes);
  return error;
}

void Simulation::Impl::addResumeWarnings(const Checkpoint& from) {
  const auto compare = [&](const char* what, const std::string& expected, const std::string& found) {
    if (expected != found)
      warnings_.push_back("the checkpoint was written with the " + std::string(what) + " " + inQuotes(expected) + ", this is " +
                          inQuotes(found) + "; results may differ bitwise");
  };
  compare("device", from.device, device().name);
  compare("driver", from.driver, device().driver);
  compare("Rill", from.rill, RILL_VERSION);
  if (!scene_.look.whitewater && !from.whitewater.counts.empty())
    warnings_.push_back("look.whitewater is false: the whitewater of the checkpoint is left out");
  if (from.fluid.loads.empty() && std::ranges::any_of(scene_.probes, [](const Probe& probe) { return !probe.load.empty(); }))
    warnings_.push_back("the checkpoint has no loads on solids: those of the first frame lack a part of its first substep");
}

Expected<void> Simulation::Impl::openWhitewater(const Checkpoint* from) {
  WhitewaterDesc desc = whitewaterOf(scene_, start_, fluid_->capacity());
  if (from) desc.snapshot = &from->whitewater;
  auto white = Whitewater::create(context_->device(), desc);
  if (!white) {
    const std::string scene = scene_.file.empty() ? scene_.name : scene_.file.string();
    return Error{white.error().kind, scene + ": look.whitewater: " + white.error().message};
  }
  white_.emplace(*std::move(white));
  if (from && from->whitewater.counts.empty()) warnings_.push_back("the checkpoint has no whitewater: the run begins without");
  if (from) whiteStats_ = whitewaterStats(from->whitewater.counts);
  return {};
}

}  // namespace rill::offline
