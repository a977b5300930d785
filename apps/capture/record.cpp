#include "capture/record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/words.hpp"
#include "model/scene_facts.hpp"
#include "rill/version.hpp"

namespace rill::capture {
namespace {

using Json = nlohmann::ordered_json;

std::string hexadecimal(uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

/// JSON on one line, so that grep finds a frame.
std::string oneLine(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json jsonOf(double value) { return value; }
Json jsonOf(const offline::LoadValue& load) { return {{"force", load.force}, {"torque", load.torque}}; }
Json jsonOf(const offline::PressureValue& value) { return value.pressure; }
Json jsonOf(const offline::FlowValue& value) { return {{"flow", value.flow}, {"volume", value.volume}}; }
Json jsonOf(const offline::PoseValue& pose) {
  return {{"position", pose.position},
          {"rotation", std::array{pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w}},
          {"velocity", pose.velocity},
          {"angular_velocity", pose.angularVelocity}};
}

/// The numbers of a probe's value, each with a name that ends the probe's.
void addFigures(const std::string& name, double value, std::vector<Figure>& figures) { figures.push_back({name, value, "m"}); }
template <class Vector>
void addComponents(const std::string& name, const Vector& v, const char* unit, std::vector<Figure>& figures) {
  constexpr const char* kAxes[] = {".x", ".y", ".z", ".w"};
  for (size_t a = 0; a < std::ranges::size(v); ++a) figures.push_back({name + kAxes[a], v[a], unit});
}
void addFigures(const std::string& name, const offline::LoadValue& load, std::vector<Figure>& figures) {
  addComponents(name + ".force", load.force, "N", figures);
  addComponents(name + ".torque", load.torque, "N m", figures);
}
void addFigures(const std::string& name, const offline::PressureValue& value, std::vector<Figure>& figures) {
  figures.push_back({name, value.pressure, "Pa"});
}
void addFigures(const std::string& name, const offline::FlowValue& value, std::vector<Figure>& figures) {
  figures.push_back({name + ".flow", value.flow, "m3/s"});
  figures.push_back({name + ".volume", value.volume, "m3"});
}
void addFigures(const std::string& name, const offline::PoseValue& pose, std::vector<Figure>& figures) {
  addComponents(name + ".position", pose.position, "m", figures);
  addComponents(name + ".rotation", pose.rotation, "", figures);
  addComponents(name + ".velocity", pose.velocity, "m/s", figures);
  addComponents(name + ".angular_velocity", pose.angularVelocity, "rad/s", figures);
}

/// What a probe gives before it has measured.
offline::ProbeValue noValue(const Probe& probe) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr Double3 kNoVector{kNone, kNone, kNone};
  if (!probe.load.empty()) return offline::LoadValue{kNoVector, kNoVector};
  if (!probe.pose.empty()) return offline::PoseValue{kNoVector, {kNone, kNone, kNone, kNone}, kNoVector, kNoVector};
  if (probe.pressure) return offline::PressureValue{kNone};
  if (!probe.flow.empty()) return offline::FlowValue{kNone, kNone};
  return kNone;
}

Json jsonOf(const std::string& name, const FluidFigures& f) {
  const FluidLedger& l = f.ledger;
  return {{"name", name},
          {"particles", f.particles},
          {"filled", l.filled},
          {"emitted", l.emitted},
          {"drained", l.drained},
          {"left", l.left},
          {"inactive", l.inactive},
          {"density_error_mean", f.densityErrorMean},
          {"density_error_max", f.densityErrorMax}};
}

Json jsonOf(const WhitewaterStats& w) {
  return {{"spray", w.spray},         {"foam", w.foam},         {"bubbles", w.bubbles},     {"emitted", w.emitted},
          {"dissolved", w.dissolved}, {"overflow", w.overflow}, {"bound_hits", w.boundHits}};
}

Json frameJson(const Scene& scene, double time_s, const offline::Stats& stats) {
  Json probes = Json::object(), pass_ms = Json::object(), skipped = Json::object();
  for (const auto& [name, value] : stats.probes) probes[name] = std::visit([](const auto& v) { return jsonOf(v); }, value);
  for (const offline::PassTime& pass : stats.passes)
    if (pass.ms > 0) pass_ms[pass.name] = pass.ms;
  for (const auto& [name, reason] : stats.skipped) skipped[name] = reason;
  Json frame;
  frame["time_s"] = time_s;
  frame["particles"] = stats.particles;
  frame["substeps"] = stats.substeps;
  frame["iterations"] = stats.iterations;
  frame["time_dropped_s"] = stats.timeDropped_s;
  frame["density_error_mean"] = stats.densityErrorMean;
  frame["density_error_p99"] = stats.densityErrorP99;
  frame["density_error_max"] = stats.densityErrorMax;
  frame["density_signed_median"] = stats.densitySignedMedian;
  frame["kinetic_J"] = stats.kinetic_J;
  frame["potential_J"] = stats.potential_J;
  frame["momentum"] = stats.momentum;
  frame["centre_of_mass"] = stats.centerOfMass;
  frame["front_m"] = stats.front_m;
  frame["max_speed"] = stats.maxSpeed;
  frame["non_finite"] = stats.nonFinite;
  frame["outside"] = stats.outside;
  frame["neighbour_overflow"] = stats.neighborOverflow;
  frame["loop_bound_hits"] = stats.loopBoundHits;
  frame["viscosity_bound_hits"] = stats.viscosityBoundHits;
  frame["diffusion_bound_hits"] = stats.diffusionBoundHits;
  frame["picture_bound_hits"] = stats.pictureBoundHits;
  frame["list_builds"] = stats.listBuilds;
  frame["artificial_viscosity_Pa_s"] = stats.artificialViscosity_Pa_s;
  if (stats.sleeping) frame["sleeping"] = *stats.sleeping;
  if (stats.whitewater) frame["whitewater"] = jsonOf(*stats.whitewater);
  frame["state_hash"] = hexadecimal(stats.stateHash);
  frame["probes"] = probes;
  Json& fluids = frame["fluids"] = Json::array();
  for (size_t k = 0; const ResolvedFluid& fluid : resolvedFluids(scene))
    if (k < stats.fluids.size()) fluids.push_back(jsonOf(fluid.name, stats.fluids[k++]));
  if (hasEmitters(scene)) frame["emitter_blocked_s"] = stats.emitterBlocked_s;
  if (stats.bodies)
    frame["bodies"] = {{"kinetic_J", stats.bodies->kinetic_J},
                       {"potential_J", stats.bodies->potential_J},
                       {"momentum", stats.bodies->momentum},
                       {"stopped", stats.bodies->stopped}};
  frame["wall_s"] = stats.wall_s;
  frame["pass_ms"] = pass_ms;
  frame["skipped"] = skipped;
  return frame;
}

}  // namespace

Record::Record(const Scene& scene, const DeviceInfo& device, std::string command, double start_s)
    : scene_(&scene), device_(device), command_(std::move(command)), start_s_(start_s) {}

void Record::add(double time_s, offline::Stats stats) { frames_.push_back({time_s, std::move(stats)}); }

double Record::droppedSeconds() const {
  double dropped = 0;
  for (const apps::Instant& frame : frames_) dropped += frame.stats.timeDropped_s;
  return dropped;
}

double Record::simulatedSeconds() const { return frames_.empty() ? 0 : std::max(0.0, frames_.back().time_s - start_s_ - droppedSeconds()); }

std::vector<std::string> Record::figureNames(const Scene& scene) {
  Record empty(scene, {}, {});
  std::vector<std::string> names;
  for (Figure& figure : empty.figures()) names.push_back(std::move(figure.name));
  return names;
}

std::vector<Figure> Record::figures() const {
  const auto of = [&](auto member) {
    return [this, member](auto combine) {
      double value = 0;
      for (const apps::Instant& frame : frames_) value = combine(value, double(frame.stats.*member));
      return value;
    };
  };
  const auto largest = [](double a, double b) { return std::max(a, b); };
  const auto sum = std::plus<double>{};
  using Stats = offline::Stats;
  const apps::DensityFigures error = apps::densityFigures(frames_);
  const double simulated = simulatedSeconds(), wall = apps::wallSeconds(frames_);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Stats last = frames_.empty() ? Stats{} : frames_.back().stats;
  std::vector<Figure> figures = {
      {"frames", double(frames_.size()), ""},
      {"particles", double(last.particles), ""},
      {"simulated_s", simulated, "s"},
      {"wall_s", wall, "s"},
      {"wall_per_simulated_s", simulated > 0 ? wall / simulated : none, ""},
      {"substeps", of(&Stats::substeps)(sum), ""},
      {"iterations", of(&Stats::iterations)(sum), ""},
      {"list_builds", of(&Stats::listBuilds)(sum), ""},
      {"time_dropped_s", droppedSeconds(), "s"},
      {"density_error_mean", error.mean, ""},
      {"density_error_p99", error.p99, ""},
      {"density_error_max", error.max, ""},
      {"density_signed_median", error.signed_median, ""},
      {"energy_ratio", apps::energyFigures(*scene_, frames_).ratio, ""},
      {"kinetic_J", last.kinetic_J, "J"},
      {"potential_J", last.potential_J, "J"},
      {"front_m", last.front_m, "m"},
      {"max_speed", of(&Stats::maxSpeed)(largest), "m/s"},
      {"artificial_viscosity", last.artificialViscosity_Pa_s, "Pa s"},
      {"outside", of(&Stats::outside)(largest), ""},
      {"non_finite", of(&Stats::nonFinite)(largest), ""},
      {"neighbour_overflow", of(&Stats::neighborOverflow)(largest), ""},
      {"loop_bound_hits", of(&Stats::loopBoundHits)(largest), ""},
      {"viscosity_bound_hits", double(last.viscosityBoundHits), ""},
      {"diffusion_bound_hits", double(last.diffusionBoundHits), ""},
      {"picture_bound_hits", double(pictureBoundHits()), ""},
  };
  const FluidLedger& ledger = last.ledger;
  for (const auto& [name, count] : {std::pair{"emitted", ledger.emitted}, {"drained", ledger.drained}, {"left", ledger.left}})
    figures.push_back({name, double(count), ""});
  if (hasEmitters(*scene_)) figures.push_back({"emitter_blocked_s", last.emitterBlocked_s, "s"});
  if (bodyCount(*scene_) > 0) {
    const BodyFigures bodies = last.bodies.value_or(BodyFigures{});
    figures.push_back({"bodies.kinetic_J", bodies.kinetic_J, "J"});
    figures.push_back({"bodies.potential_J", bodies.potential_J, "J"});
    addComponents("bodies.momentum", bodies.momentum, "kg m/s", figures);
    figures.push_back({"bodies.stopped", double(bodies.stopped), ""});
  }
  if (maySleep(*scene_)) figures.push_back({"sleeping", double(last.sleeping.value_or(0)), ""});
  if (scene_->look.whitewater) {
    const WhitewaterStats white = last.whitewater.value_or(WhitewaterStats{});
    for (const auto& [name, count] : {std::pair{"spray", white.spray},
                                      {"foam", white.foam},
                                      {"bubbles", white.bubbles},
                                      {"emitted", white.emitted},
                                      {"dissolved", white.dissolved},
                                      {"overflow", white.overflow}})
      figures.push_back({std::string("whitewater.") + name, double(count), ""});
  }
  for (const Probe& probe : scene_->probes) {
    const auto found =
        std::find_if(last.probes.begin(), last.probes.end(), [&](const auto& measured) { return measured.first == probe.name; });
    std::visit([&](const auto& value) { addFigures("probes." + probe.name, value, figures); },
               found == last.probes.end() ? noValue(probe) : found->second);
  }
  return figures;
}

uint64_t Record::pictureBoundHits() const {
  uint64_t hits = 0;
  for (const apps::Instant& frame : frames_) hits += frame.stats.pictureBoundHits;
  return hits;
}

std::string Record::json() const {
  const apps::DensityFigures error = apps::densityFigures(frames_);
  const apps::EnergyFigures joules = apps::energyFigures(*scene_, frames_);
  Json head;
  head["rill"] = RILL_VERSION;
  head["command"] = command_;
  head["scene"] = scene_->name;
  head["device"] = {{"name", device_.name}, {"driver", device_.driver}, {"api", device_.api}};
  head["particles"] = frames_.empty() ? 0 : frames_.back().stats.particles;
  head["simulated_s"] = simulatedSeconds();
  head["wall_s"] = apps::wallSeconds(frames_);
  head["density_error"] = {{"mean", error.mean}, {"p99", error.p99}, {"max", error.max}};
  head["energy"] = {{"start_J", joules.start_J}, {"max_J", joules.max_J}, {"end_J", joules.end_J}, {"ratio", joules.ratio}};
  std::string text = "{\n";
  for (const auto& [key, value] : head.items()) text += "  " + oneLine(key) + ": " + oneLine(value) + ",\n";
  text += "  \"frames\": [";
  for (size_t k = 0; k < frames_.size(); ++k)
    text += std::string(k ? "," : "") + "\n    " + oneLine(frameJson(*scene_, frames_[k].time_s, frames_[k].stats));
  return text + (frames_.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

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
  if (last.diffusionBoundHits > 0)
    warnings.push_back("warning: " + grouped(last.diffusionBoundHits) +
                       " steps of diffusion needed more stages than they take: that of the " + "fluids acted as less");
  if (last.loopBoundHits > 0)
    warnings.push_back("warning: loops of the fluid's shaders reached their limit " + grouped(last.loopBoundHits) +
                       " times since the start: some particles have too many neighbors, or bodies touch too many solids");
  if (last.ledger.outOfIds) warnings.push_back("warning: emitters have stopped: the ids of particles have run out");
  if (last.ledger.full)
    warnings.push_back("warning: emitters were blocked: the room for particles (fluid.capacity) was full; emitter_blocked_s is " +
                       roundedNumber(last.emitterBlocked_s) + " s");
  else if (last.emitterBlocked_s > 0)
    warnings.push_back("warning: emitters were blocked for " + roundedNumber(last.emitterBlocked_s) +
                       " s: a part of a mouth was in a solid or behind a wall");
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
