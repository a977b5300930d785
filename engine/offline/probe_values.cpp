#include "offline/probe_values.hpp"

#include <algorithm>
#include <limits>

#include "fill/mouth.hpp"

namespace rill::offline {
namespace {

/// m^3 through emitters, then drains, since the start.
std::vector<double> flowVolumes(const Fluid& fluid) {
  std::vector<double> volumes;
  for (const auto flows : {fluid.emitted(), fluid.drained()})
    for (const FlowReading& flow : flows) volumes.push_back(flow.volume);
  return volumes;
}

}  // namespace

/// What values are read from.
struct ProbeValues::Moment {
  const Fluid& fluid;
  double time_s, advanced_s;
};

PoseValue valueOf(const Pose& pose) { return {pose.center, pose.rotation, pose.velocity, pose.angularVelocity}; }

void ProbeValues::beginAdvance(const Fluid& fluid) {
  const auto loads = fluid.solidLoads();
  loads_.assign(loads.begin(), loads.end());
  const auto pressures = fluid.pressures();
  pressures_.assign(pressures.begin(), pressures.end());
  volumes_ = flowVolumes(fluid);
}

std::vector<std::pair<std::string, ProbeValue>> ProbeValues::read(const Fluid& fluid, const ProbeReader& reader, double time_s,
                                                                  double advanced_s) const {
  std::vector<std::pair<std::string, ProbeValue>> values;
  for (const Probe& probe : scene_.probes) values.emplace_back(probe.name, valueOf(probe, reader, {fluid, time_s, advanced_s}));
  return values;
}

ProbeValue ProbeValues::valueOf(const Probe& probe, const ProbeReader& reader, const Moment& now) const {
  if (probe.level) return reader.level(probe.level->first, probe.level->second);
  if (probe.front) return reader.front(*probe.front);
  if (probe.pressure) return pressureAt(probe, now);
  if (!probe.flow.empty()) return flowThrough(probe.flow, now);
  return probe.load.empty() ? ProbeValue(poseOf(solidNamed(probe.pose), now)) : loadOn(solidNamed(probe.load), now);
}

size_t ProbeValues::solidNamed(const std::string& name) const {
  return static_cast<size_t>(std::ranges::find(scene_.solids, name, &Solid::name) - scene_.solids.begin());
}

PoseValue ProbeValues::poseOf(size_t solid, const Moment& now) const {
  for (const BodyMotion& body : now.fluid.bodies())
    if (body.solid == solid) return {body.center, body.rotation, body.velocity, body.angularVelocity};
  return offline::valueOf(solidPose(scene_.solids[solid], now.time_s));
}

PressureValue ProbeValues::pressureAt(const Probe& probe, const Moment& now) const {
  size_t k = 0;  // among the probes of pressure
  for (const Probe* other = scene_.probes.data(); other != &probe; ++other) k += other->pressure.has_value();
  const auto readings = now.fluid.pressures();
  if (k >= readings.size()) return {};  // a fluid without particles
  if (readings[k].covered) return {std::numeric_limits<double>::quiet_NaN()};
  return {now.advanced_s > 0 && k < pressures_.size() ? (readings[k].integral - pressures_[k].integral) / now.advanced_s
                                                      : readings[k].mean};
}

/// Of the emitter or drain of this name: their volumes, emitters first.
FlowValue ProbeValues::flowThrough(const std::string& name, const Moment& now) const {
  const auto nameOf = [](const auto& flow) -> const std::string& { return flow.name; };
  const std::vector<Emitter> emitters = emittersOf(scene_);
  const auto emitter = std::ranges::find(emitters, name, nameOf);
  const auto drain = std::ranges::find(scene_.drains, name, nameOf);
  const size_t k = emitter != emitters.end() ? static_cast<size_t>(emitter - emitters.begin())
                                             : emitters.size() + static_cast<size_t>(drain - scene_.drains.begin());
  const double volume = flowVolumes(now.fluid)[k];
  return {now.advanced_s > 0 && k < volumes_.size() ? (volume - volumes_[k]) / now.advanced_s : 0.0, volume};
}

LoadValue ProbeValues::loadOn(size_t solid, const Moment& now) const {
  LoadValue value;
  if (!(now.advanced_s > 0) || loads_.size() <= solid) return value;
  const SolidLoad &before = loads_[solid], &after = now.fluid.solidLoads()[solid];
  for (size_t a = 0; a < 3; ++a) {
    value.force[a] = (after.impulse[a] - before.impulse[a]) / now.advanced_s;
    value.torque[a] = (after.angularImpulse[a] - before.angularImpulse[a]) / now.advanced_s;
  }
  return value;
}

}  // namespace rill::offline
