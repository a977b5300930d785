#include "bench/experiments/experiment.hpp"

#include <algorithm>
#include <optional>

namespace rill::bench {

Figure relativeFigure(std::string name, double measured, double expected) {
  return {std::move(name), measured, expected, measured / expected - 1};
}
Figure plainFigure(std::string name, double error) { return {std::move(name), error, std::numeric_limits<double>::quiet_NaN(), error}; }

std::string Experiment::name() const { return family + "@" + number(spacing_m, 4); }

Expected<RunFigures> runSampled(const Bench& bench, const Scene& scene, double duration_s, double frame_s,
                                const std::function<bool(double)>& sampledAt, const std::function<void(const Cloud&, double)>& onSample) {
  SceneRun run;
  run.scene = scene;
  run.duration_s = duration_s;
  run.frame_s = frame_s;
  std::optional<Error> failed;
  run.onFrame = [&](offline::Simulation& simulation, double time_s) {
    if (failed || !sampledAt(time_s)) return;
    const auto particles = simulation.particles();
    if (particles)
      onSample(cloudOf(*particles, scene.fluid.spacing), time_s);
    else
      failed = particles.error();
  };
  auto figures = runScene(bench, run);
  if (figures && failed) return *failed;
  return figures;
}

Expected<Settled> settle(const Bench& bench, const Scene& scene, double duration_s, double frame_s) {
  Settled settled;
  auto run = runSampled(
      bench, scene, duration_s, frame_s, [&](double time_s) { return time_s > duration_s - frame_s / 2; },
      [&](const Cloud& cloud, double) { settled.cloud = cloud; });
  if (!run) return run.error();
  settled.run = std::move(*run);
  return settled;
}

Json curveJson(const std::vector<std::pair<double, double>>& curve) {
  Json json = Json::array();
  for (const auto& [x, y] : curve) json.push_back({x, y});
  return json;
}

}  // namespace rill::bench
