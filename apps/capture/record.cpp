#include "capture/record.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "model/scene_facts.hpp"

namespace rill::capture {
namespace {

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
      {"viscosity_capped", double(last.viscosityCapped), ""},
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

}  // namespace rill::capture
