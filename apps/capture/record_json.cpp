// The JSON of --stats.
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "capture/record.hpp"
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
  frame["viscosity_capped"] = stats.viscosityCapped;
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

}  // namespace rill::capture
