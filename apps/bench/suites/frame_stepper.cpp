#include "bench/suites/frame_stepper.hpp"

#include <chrono>

namespace rill::bench {

Expected<FrameStepper> FrameStepper::open(const Bench& bench, const std::string& scene, const Overrides& overrides,
                                          const Feature* feature) {
  auto read = namedScene(scene, overrides);
  if (!read) return read.error();
  if (feature && feature->solid) read->solids.push_back(*feature->solid);
  offline::Options options = simulationOptions(bench);
  options.passTimes = feature && feature->passTimes;
  auto simulation = offline::Simulation::open(std::move(*read), options);
  if (!simulation) return simulation.error();
  FrameStepper stepper;
  stepper.simulation_ = std::move(*simulation);
  stepper.measuresFigures_ = feature && feature->measuresFigures;
  return stepper;
}

Expected<double> FrameStepper::frame(double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  if (auto advanced = simulation_->advance(seconds); !advanced) return advanced.error();
  if (measuresFigures_)
    if (auto measured = simulation_->stats(); !measured) return measured.error();
  return 1e3 * std::chrono::duration<double>(Clock::now() - begin).count();
}

Json passesJson(const std::vector<offline::PassTime>& passes) {
  Json json = Json::object();
  for (const offline::PassTime& pass : passes) json[pass.name] = pass.recorded;
  return json;
}

}  // namespace rill::bench
