#include "bench/device/simulation_times.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/suites/tank.hpp"
#include "core/words.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill::bench {
namespace {

using Clock = std::chrono::steady_clock;
double secondsFrom(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

constexpr double kTimedFrame_s = 1.0 / 60;
constexpr uint32_t kSmallRun = 10'000;
constexpr int kMinFrames = 2, kMaxFrames = 30;
constexpr double kEnough_s = 20;             // of a size that has its frames
constexpr double kStartOfParticle_s = 2e-6;  // on the host: fills, sorts, uploads
constexpr double kStartOfDevice_s = 2;       // instance, device, pipelines
constexpr double kSubstepsOfStart = 4;       // per layer of particles: the initial pressure
constexpr double kTemporaryMemory = 1.25;    // transients of a frame, over the fluid's own memory

std::string secondsText(double s) { return number(s, s < 100 ? 2 : 3) + " s"; }

}  // namespace

Expected<SmallRun> smallRun(const Bench& bench) {
  const auto scene = tank(kSmallRun);
  if (!scene) return scene.error();
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  const auto start = makeParticles(*scene);
  if (!start) return start.error();
  auto fluid = Fluid::create(workbench->device(), {.scene = &*scene, .particles = &*start});
  if (!fluid) return fluid.error();
  SmallRun small;
  for (int frame = 0; frame < 4; ++frame) {  // the last is timed: drivers compile shaders at their first use
    const Clock::time_point begin = Clock::now();
    if (auto advanced = advanceFluid(*workbench, *fluid, kTimedFrame_s); !advanced) return advanced.error();
    const double particles = fluid->count(), substeps = std::max(1u, fluid->progress().substeps);
    small.pace = {1e9 * secondsFrom(begin) / (particles * substeps), substeps, particles};
  }
  auto traffic = measureTraffic(*workbench, *fluid, 2 * kTimedFrame_s, fluid->progress().substeps);
  if (!traffic) return traffic.error();
  small.traffic = std::move(*traffic);
  return small;
}

Expected<SimulationTimes> timeSimulation(const Bench& bench, uint32_t count, const Pace& pace, uint64_t availableBytes, double budget_s) {
  const Clock::time_point begin = Clock::now();
  const auto scene = tank(count);
  if (!scene) return scene.error();
  SimulationTimes times;
  times.particles = tankParticles(*scene);
  const double particles = double(times.particles);

  const double needed = kTemporaryMemory * double(fluidMemory(*scene, times.particles).total());
  if (needed > double(availableBytes)) {
    times.leftOut = "needs " + bytesText(uint64_t(needed)) + " of device memory; " + bytesText(availableBytes) + " are available";
    return times;
  }
  const double substep_s = 1e-9 * pace.nsPerParticleSubstep * particles;
  const double frame_s = substep_s * pace.substepsPerFrame * std::cbrt(particles / pace.atParticles);
  const double start_s = kStartOfDevice_s + kStartOfParticle_s * particles + kSubstepsOfStart * substep_s / scene->fluid.spacing;
  const double estimate_s = start_s + (kMinFrames + 1) * frame_s;
  if (estimate_s > budget_s) {
    times.leftOut = "would take about " + secondsText(estimate_s) + " for " + std::to_string(kMinFrames) + " frames; " +
                    secondsText(budget_s) + " are left for it";
    return times;
  }

  auto simulation = offline::Simulation::open(*scene, simulationOptions(bench));
  if (!simulation) {
    if (!isLimit(simulation.error())) return simulation.error();
    times.leftOut = simulation.error().message;
    return times;
  }
  double wall_s = 0, substeps = 0, error = 0, longest_s = 0;
  for (int frame = 0; frame <= kMaxFrames && !bench.stopped(); ++frame) {  // frame 0 starts the fluid and compiles shaders
    if (times.frames >= kMinFrames && secondsFrom(begin) + longest_s > std::min(budget_s, kEnough_s)) break;
    const Clock::time_point frameBegin = Clock::now();
    if (auto advanced = simulation->advance(kTimedFrame_s); !advanced) return advanced.error();
    const auto stats = simulation->stats();
    if (!stats) return stats.error();
    if (frame == 0) continue;
    longest_s = std::max(longest_s, secondsFrom(frameBegin));
    wall_s += stats->wall_s;
    substeps += stats->substeps;
    error += stats->densityErrorMean;
    ++times.frames;
  }
  if (times.frames == 0) {
    times.leftOut = "stopped";
    return times;
  }
  times.frame_ms = 1e3 * wall_s / times.frames;
  times.substeps = substeps / times.frames;
  times.error = error / times.frames;
  return times;
}

}  // namespace rill::bench
