#include "bench/device/picture_times.hpp"

#include <chrono>

#include "bench/suites/tank.hpp"
#include "bench/traffic/fluid_traffic.hpp"
#include "offline/painter.hpp"

namespace rill::bench {

Expected<void> timePictures(Bench& bench, std::span<const std::pair<uint32_t, uint32_t>> sizes, double budget_s,
                            const std::function<void(const PictureTimes&)>& done) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto timeLeft = [&] { return std::chrono::duration<double>(Clock::now() - begin).count() < budget_s; };
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  const auto scene = tank(50'000);
  if (!scene) return scene.error();
  const auto start = makeParticles(*scene);
  if (!start) return start.error();
  auto fluid = Fluid::create(workbench->device(), {.scene = &*scene, .particles = &*start});
  if (!fluid) return fluid.error();
  if (auto advanced = advanceFluid(*workbench, *fluid, 2.0 / 60); !advanced) return advanced.error();
  workbench->timePasses(true);
  offline::Painter painter(*scene, *start);
  for (const auto& [width, height] : sizes) {
    if (bench.stopped()) break;
    PictureTimes picture{std::to_string(width) + "x" + std::to_string(height), {}, {}};
    if (!bench.selected("picture-" + picture.size)) continue;
    bench.step("picture of " + picture.size);
    if (!timeLeft()) {
      picture.leftOut = "no time left";
      done(picture);
      continue;
    }
    if (auto ready = painter.prepare(workbench->device(), "final", width, height); !ready) return ready.error();
    for (int frame = 0; frame <= 20 && (frame < 3 || timeLeft()) && !bench.stopped(); ++frame) {
      const auto drawn = workbench->run(
          [&, w = width, h = height](Graph& graph) { (void)painter.declare(graph, fluid->present(graph), "final", w, h, 0); });
      if (!drawn) return drawn.error();
      if (frame == 0) continue;  // compiles shaders
      double sum = 0;
      for (const Timing& pass : workbench->passTimes())
        if (!pass.name.starts_with("readback")) sum += pass.ms;
      picture.ms.push_back(sum > 0 ? sum : drawn->run_ms);
    }
    done(picture);
  }
  return {};
}

}  // namespace rill::bench
