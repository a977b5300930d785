// Cost per particle and substep by the number of particles, per pass, and two baselines.
#include <algorithm>
#include <cmath>

#include "bench/suites/baselines.hpp"
#include "bench/suites/count_name.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/tank.hpp"
#include "bench/workbench.hpp"
#include "core/words.hpp"
#include "rill/fluid.hpp"
#include "sort/key_sort.hpp"

namespace rill::bench {
namespace speed_suite {
namespace {

constexpr int kFrames = 3;  // measured, after one warm-up frame in which shaders are compiled

// At this speed the list is built about every eleven substeps, as on average in a dam break; a fluid that starts at rest needs fewer.
constexpr const char* kSpeed = "[8, 0, 0]";

/// Proportional to the spacing, so that the number of substeps per frame is about the same for all counts.
double frameOf(const Scene& scene) { return scene.fluid.spacing / 0.05 / 60; }

/// Short runs are sampled more often: they are cheap, and other load disturbs them more.
uint32_t samplesOf(const Bench& bench, uint32_t count) {
  return count <= 20'000 ? std::max(3u, bench.options().repeat) : bench.options().repeat;
}

/// Progress parts of a run: a constant for startup plus a term per particle.
size_t partsOf(uint32_t count) { return 8 + count / 1000; }

/// Cost of a pass, or of all passes of a module.
struct PassCost {
  std::string name;
  std::vector<double> ns;  ///< per particle and substep, one sample per frame
};

std::string_view moduleOf(std::string_view pass) { return pass.starts_with("sort/") ? "sort" : pass; }

/// Times the passes of the solver alone; measuring figures would add the time of their sort to that of the solver.
Expected<std::vector<PassCost>> passCosts(const Bench& bench, const Scene& scene) {
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  workbench->timePasses(true);
  const double frame_s = frameOf(scene);
  const auto start = makeParticles(scene);
  if (!start) return start.error();
  auto fluid = Fluid::create(workbench->device(), {&scene, &*start});
  if (!fluid) return fluid.error();
  const double particles = fluid->count();
  std::vector<PassCost> costs;
  uint32_t expected = 4 * fluid->substepsPerBlock();
  for (int frame = 0; frame <= kFrames && !bench.stopped(); ++frame) {
    std::vector<std::pair<std::string, double>> ms;
    FluidStep step{frame_s, false, expected, false};
    for (uint32_t recorded = 0; recorded < fluid->substepsToComplete();) {
      step.resume = recorded > 0;
      if (auto executed = workbench->run([&](Graph& graph) { (void)fluid->addTo(graph, step); }); !executed) return executed.error();
      for (const Timing& timing : workbench->passTimes()) {
        const std::string name(moduleOf(timing.name));
        auto found = std::ranges::find(ms, name, &std::pair<std::string, double>::first);
        if (found == ms.end()) found = ms.insert(ms.end(), {name, 0});
        found->second += timing.ms;
      }
      if (!(fluid->progress().timeLeft_s > 0)) break;
      recorded += step.substeps;
      step.substeps = fluid->substepsPerBlock();
    }
    const uint32_t substeps = fluid->progress().substeps;
    if (frame == 0) continue;
    for (const auto& [name, time] : ms) {
      auto found = std::ranges::find(costs, name, &PassCost::name);
      if (found == costs.end()) found = costs.insert(costs.end(), {name, {}});
      found->ns.push_back(1e6 * time / (particles * substeps));
    }
  }
  return costs;
}

/// Results for one number of particles.
struct Case {
  uint32_t nominal = 0;
  uint64_t particles = 0;
  std::vector<double> ns, total_s;  ///< one sample per run: per particle and substep; total wall time
  double buildsPerSubstep = 0;
  double step_ms = 0;  ///< wall time per substep
  FluidMemory memory;
  std::vector<PassCost> passes;
  std::string limitError;  ///< the error if the case exceeds a limit
  std::string name() const { return "particles-" + countName(nominal); }
  double sum() const {
    double sum = 0;
    for (const PassCost& pass : passes) sum += median(pass.ns);
    return sum;
  }
};

Expected<Case> measure(Bench& bench, uint32_t nominal) {
  Case made;
  made.nominal = nominal;
  const auto scene = tank(nominal, {{"fill[0].velocity", kSpeed}});
  if (!scene) return scene.error();
  made.particles = tankParticles(*scene);
  made.memory = fluidMemory(*scene, made.particles);
  for (uint32_t k = 0; k < samplesOf(bench, nominal) && !bench.stopped(); ++k) {
    bench.step(made.name(), partsOf(nominal));
    const double frame_s = frameOf(*scene);
    const auto run = runScene(bench, {.scene = *scene, .duration_s = (kFrames + 1.5) * frame_s, .frame_s = frame_s});
    if (!run && isLimit(run.error())) {
      made.limitError = run.error().message;
      return made;
    }
    if (!run) return run.error();
    double wall_s = 0;
    uint64_t substeps = 0, builds = 0;
    for (size_t frame = 2; frame < run->instants.size(); ++frame) {  // skips the start and the warm-up frame
      wall_s += run->instants[frame].stats.wall_s;
      substeps += run->instants[frame].stats.substeps;
      builds += run->instants[frame].stats.listBuilds;
    }
    if (substeps == 0) continue;
    made.particles = run->particles;
    made.ns.push_back(1e9 * wall_s / (double(run->particles) * double(substeps)));
    made.total_s.push_back(run->total_s);
    made.step_ms = 1e3 * wall_s / double(substeps);
    made.buildsPerSubstep = double(builds) / double(substeps);
  }
  if (bench.stopped()) return made;
  bench.step(made.name() + ", passes", partsOf(nominal));
  auto passes = passCosts(bench, *scene);
  if (!passes) return passes.error();
  made.passes = std::move(*passes);
  return made;
}

Json json(const Case& c) {
  Json json{{"case", c.name()}, {"particles", c.particles}};
  const double particles = double(c.particles);
  json["bytes_a_particle"] = {{"arrays", double(c.memory.particleBytes) / particles},
                              {"grid", double(c.memory.gridBytes) / particles},
                              {"list", double(c.memory.listBytes) / particles}};
  if (!c.limitError.empty()) {
    json["refused"] = c.limitError;
    return json;
  }
  json["ns_a_particle_a_substep"] = sampleStatistics(c.ns);
  json["with_everything_s"] = sampleStatistics(c.total_s);
  json["list_builds_a_substep"] = c.buildsPerSubstep;
  for (const PassCost& pass : c.passes) json["passes_ns_a_particle_a_substep"][pass.name] = sampleStatistics(pass.ns);
  return json;
}

Table costTable(const std::vector<Case>& cases) {
  Table table{"Cost per particle, simulation only, without pass times",
              {"particles", "ns per substep", "ms per substep", "substeps per list build", "bytes", "bytes of list", "total, s", "limit"},
              {},
              "ns: per particle and substep, including list builds. bytes: per particle. total: wall time of the run including device\n"
              "creation, shader compilation and measurement."};
  for (const Case& c : cases) {
    const double particles = double(c.particles), bytes = double(c.memory.total()) / particles;
    table.rows.push_back({grouped(c.particles), number(median(c.ns)), number(c.limitError.empty() ? c.step_ms : std::nan("")),
                          number(1 / c.buildsPerSubstep), number(bytes), number(double(c.memory.listBytes) / particles),
                          number(median(c.total_s)), c.limitError});
  }
  const bool any = std::ranges::any_of(cases, [](const Case& c) { return !c.limitError.empty(); });
  if (!any) {
    table.columns.pop_back();
    for (auto& row : table.rows) row.pop_back();
  }
  return table;
}

Table passTable(const std::vector<Case>& cases) {
  Table table{"Cost per pass, ns per particle and substep",
              {"pass"},
              {},
              "Measured with a time stamp after each pass, which itself adds a tenth or more."};
  std::vector<std::string> names;
  for (const Case& c : cases) {
    if (c.passes.empty()) continue;
    table.columns.push_back(grouped(c.particles));
    for (const PassCost& pass : c.passes)
      if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
  }
  for (const std::string& name : names) {
    std::vector<std::string> row{name};
    for (const Case& c : cases) {
      if (c.passes.empty()) continue;
      const auto pass = std::ranges::find(c.passes, name, &PassCost::name);
      row.push_back(pass == c.passes.end() ? "-" : number(median(pass->ns)));
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<std::string> sums{"total"};
  for (const Case& c : cases)
    if (!c.passes.empty()) sums.push_back(number(c.sum()));
  table.rows.push_back(std::move(sums));
  return table;
}

std::vector<Plot> plots(const std::vector<Case>& cases) {
  Plot total{"Cost per particle and substep, simulation only", "particles", "ns", true, false, {{"total", Series::Style::Both, {}, {}}}};
  Plot passes{"Cost per pass, passes above 2 ns", "particles", "ns per particle and substep", true, true, {}};
  for (const Case& c : cases) {
    if (!c.ns.empty()) total.series[0].points.emplace_back(c.particles, median(c.ns));
    for (const PassCost& pass : c.passes) {
      auto series = std::ranges::find(passes.series, pass.name, &Series::name);
      if (series == passes.series.end()) series = passes.series.insert(passes.series.end(), {pass.name, Series::Style::Both, {}, {}});
      series->points.emplace_back(c.particles, median(pass.ns));
    }
  }
  std::erase_if(passes.series, [](const Series& series) {
    return std::ranges::none_of(series.points, [](const auto& point) { return point.second > 2; });
  });
  return {total, passes};
}

Expected<Report> runAll(Bench& bench) {
  std::vector<uint32_t> counts = bench.quick() ? std::vector<uint32_t>{1000, 10'000, 50'000, 100'000}
                                               : std::vector<uint32_t>{1000, 10'000, 50'000, 100'000, 200'000, 500'000, 1'000'000};
  std::erase_if(counts, [&](uint32_t count) { return !bench.selected("particles-" + countName(count)); });
  const Baselines baselines;
  size_t parts = baselines.parts(bench);
  for (const uint32_t count : counts) parts += (samplesOf(bench, count) + 1) * partsOf(count);
  bench.plan(parts, "part");

  Report report;
  std::vector<Case> cases;
  for (const uint32_t count : counts) {
    if (bench.stopped()) break;
    auto made = measure(bench, count);
    if (!made) return made.error();
    report.results.push_back(json(*made));
    cases.push_back(std::move(*made));
  }
  if (!cases.empty()) {
    report.tables = {costTable(cases), passTable(cases)};
    report.plots = plots(cases);
  }
  if (auto done = baselines.run(bench, report); !done) return done.error();
  return report;
}

}  // namespace
}  // namespace speed_suite

Expected<Report> runSpeed(Bench& bench) { return speed_suite::runAll(bench); }

}  // namespace rill::bench
