// Work-precision: run time against density error (in the solver's kernel) and trajectory error (against converged runs).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "bench/pareto.hpp"
#include "bench/suites/suites.hpp"
#include "bench/trajectory.hpp"

namespace rill::bench {
namespace {

constexpr double kFrame_s = 1.0 / 60;
constexpr double kDivergedError = 0.3;     // mean compression from which a run is diverged; diagrams clamp it to this
constexpr double kMaxEnergy = 1.5;         // energy ratio from which a run is diverged
constexpr double kDivergedTrajectory = 1;  // trajectory error of diverged runs in diagrams

struct Setting {
  std::string family, name;
  std::vector<Override> changes;
};

/// `steps` substeps of equal length per frame of 1/60 s, with `iterations` each.
Setting fixedStep(int steps, int iterations, std::vector<Override> more = {}, const std::string& family = "fixed step") {
  char step[40];
  std::snprintf(step, sizeof step, "%.9g", kFrame_s / steps);
  std::vector<Override> changes{{"solver.time_step", step},
                                {"solver.tolerance", "0"},
                                {"solver.cfl", "10"},
                                {"solver.max_substeps", "256"},
                                {"solver.iterations", std::to_string(iterations)}};
  changes.insert(changes.end(), more.begin(), more.end());
  return {family, "S " + std::to_string(steps) + " I " + std::to_string(iterations), std::move(changes)};
}

Setting tolerance(const char* value) { return {"tolerance", std::string("tol ") + value, {{"solver.tolerance", value}}}; }

std::vector<Setting> settings(bool quick) {
  std::vector<Setting> all{{"default", "default", {}}};
  const std::vector<const char*> tolerances =
      quick ? std::vector<const char*>{"0.0004", "0.003"} : std::vector<const char*>{"0.0003", "0.0006", "0.0015", "0.003", "0.006"};
  for (const char* value : tolerances) all.push_back(tolerance(value));
  const std::vector<int> steps = quick ? std::vector<int>{8, 16, 32} : std::vector<int>{6, 8, 12, 16, 20, 24, 32, 48};
  for (const int s : steps) all.push_back(fixedStep(s, 1));
  const auto named = [](Setting setting, const std::string& suffix) {
    setting.name += suffix;
    return setting;
  };
  all.push_back(named(fixedStep(16, 1, {{"solver.warm_start", "0"}}, "no warm start"), " cold"));
  all.push_back(fixedStep(4, 4, {}, "iterations"));
  const std::vector<Override> paper{{"solver.kernel", "poly6_spiky"}, {"solver.neighbors", "grid"}};
  all.push_back(named(fixedStep(2, 4, paper, "Macklin and Mueller 2013"), " paper"));
  if (quick) return all;
  for (const int s : {12, 32}) all.push_back(named(fixedStep(s, 1, {{"solver.warm_start", "0"}}, "no warm start"), " cold"));
  for (const auto& [s, i] : {std::pair{2, 8}, std::pair{8, 2}, std::pair{12, 2}}) all.push_back(fixedStep(s, i, {}, "iterations"));
  for (const auto& [s, i] : {std::pair{4, 4}, std::pair{8, 2}})
    all.push_back(named(fixedStep(s, i, paper, "Macklin and Mueller 2013"), " paper"));
  for (const char* ratio : {"1.8", "2", "2.5"})
    all.push_back({"smoothing ratio", std::string("h ") + ratio + " d", {{"fluid.smoothing_ratio", ratio}}});
  for (const char* cfl : {"0.15", "0.4", "0.6"}) all.push_back({"cfl", std::string("cfl ") + cfl, {{"solver.cfl", cfl}}});
  for (const char* gain : {"0", "0.01", "0.05"}) all.push_back({"warm start", std::string("gain ") + gain, {{"solver.warm_start", gain}}});
  for (const char* omega : {"0.5", "0.7"}) all.push_back({"relaxation", std::string("omega ") + omega, {{"solver.relaxation", omega}}});
  all.push_back({"artificial viscosity", "none", {{"solver.artificial_viscosity", "0"}}});
  return all;
}

/// SPlisHSPlasH 2.16 on dam50k, two threads of a similar machine, its own kernel: wall seconds per simulated second, mean compression.
/// See docs/notes/bench.md.
Series splishsplash() {
  return {"SPlisHSPlasH 2.16",
          Series::Style::Points,
          {{36, 0.0011}, {39, 0.0016}, {84, 0.00012}, {52, 0.0012}, {26, 0.0043}},
          {"DFSPH loose", "DFSPH loose", "DFSPH", "PBF 5 iterations", "PBF 5 iterations"}};
}

struct Measured {
  Setting setting;
  RunFigures run;
  std::vector<double> wall;  ///< samples, seconds per simulated second
  double trajectory = 0;
  bool diverged = false;
  double cost() const { return median(wall); }
};

struct Case {
  std::string name;
  std::string scene;
  std::vector<Override> changes;
  double duration_s = 0;
  int convergedSteps = 0;  ///< substeps per frame of the reference runs for trajectories
  uint32_t seeds = 0;
  bool comparesSplishsplash = false;
};

class Accuracy {
 public:
  explicit Accuracy(Bench& bench) : bench_(bench) {}

  Expected<Report> run() {
    const bool quick = bench_.quick();
    std::vector<Case> cases;
    if (quick) {
      cases.push_back({"dam", "dam50k", {{"fluid.spacing", "0.1"}}, 1.0, 40, 2, false});
      cases.push_back({"column", "resting-column", {{"fluid.spacing", "0.04"}}, 0.5, 60, 2, false});
    } else {
      cases.push_back({"dam", "dam50k", {}, 1.0, 64, 2, true});  // the front reaches the far wall at 0.7 s
      cases.push_back({"column", "resting-column", {}, 1.0, 96, 2, false});
    }
    const std::vector<Setting> all = settings(quick);
    size_t steps = 0;
    for (const Case& c : cases)
      if (bench_.selected(c.name)) steps += c.seeds + all.size();
    bench_.plan(steps);
    for (const Case& c : cases) {
      if (!bench_.selected(c.name) || bench_.stopped()) continue;
      if (auto done = runCase(c, all); !done) return done.error();
    }
    return std::move(report_);
  }

 private:
  Expected<void> runCase(const Case& c, const std::vector<Setting>& all) {
    std::vector<Trajectory> seeds;
    double length = 1, energy = 1;
    for (uint32_t seed = 1; seed <= c.seeds && !bench_.stopped(); ++seed) {
      bench_.step(c.name + " converged, seed " + std::to_string(seed));
      Setting setting = fixedStep(c.convergedSteps, 1);
      auto scene = sceneOf(c, setting);
      if (!scene) return scene.error();
      scene->seed = seed;
      for (Fill& fill : scene->fill) fill.jitter = 1e-3;
      auto ran = runScene(bench_, {.scene = *scene, .duration_s = c.duration_s, .frame_s = kFrame_s});
      if (!ran) return ran.error();
      if (bench_.stopped()) return {};
      if (seed == 1) {
        length = std::max(ran->instants[0].stats.front_m, scene->fluid.spacing);
        energy = std::max(std::abs(ran->instants[0].stats.potential_J), 1e-12);
      }
      seeds.push_back(trajectoryOf(ran->instants, length, energy));
    }
    const Trajectory converged = meanTrajectory(seeds);
    double seedSpread = 0;  // distance between reference runs, which differ by a jitter of 0.001 spacings
    for (const Trajectory& seed : seeds) seedSpread = std::max(seedSpread, rmsDistance(seed, converged));

    std::vector<Measured> measured;
    for (const Setting& setting : all) {
      if (bench_.stopped()) break;
      bench_.step(c.name + " " + setting.name);
      auto scene = sceneOf(c, setting);
      if (!scene) return scene.error();
      Measured m{setting};
      for (uint32_t k = 0; k < bench_.options().repeat && !bench_.stopped(); ++k) {
        auto ran = runScene(bench_, {.scene = *scene, .duration_s = c.duration_s, .frame_s = kFrame_s});
        if (!ran) return ran.error();
        if (bench_.stopped()) break;  // incomplete runs are not samples
        if (k > 0 && ran->instants.back().stats.stateHash != m.run.instants.back().stats.stateHash)
          report_.failures.push_back(c.name + " " + setting.name + ": two runs differ in their state hash");
        m.wall.push_back(ran->wall_s / std::max(ran->simulated_s, 1e-12));
        m.run = std::move(*ran);
      }
      if (m.wall.empty()) break;
      m.trajectory = rmsDistance(trajectoryOf(m.run.instants, length, energy), converged);
      m.diverged = !(m.run.density.mean < kDivergedError) || !(m.run.energy.ratio < kMaxEnergy) || m.run.nonFinite > 0 ||
                   !std::isfinite(m.trajectory);
      measured.push_back(std::move(m));
    }
    addToReport(c, measured, seedSpread);
    return {};
  }

  Expected<Scene> sceneOf(const Case& c, const Setting& setting) const {
    std::vector<Override> changes = c.changes;
    changes.insert(changes.end(), setting.changes.begin(), setting.changes.end());
    return namedScene(c.scene, changes);
  }

  void addToReport(const Case& c, const std::vector<Measured>& measured, double seedSpread) {
    const auto density = [](const Measured& m) { return m.diverged ? kDivergedError : m.run.density.mean; };
    const auto trajectory = [](const Measured& m) { return m.diverged ? kDivergedTrajectory : m.trajectory; };
    const std::string kernel = "Wendland or poly6, support h = 2.3 d unless noted";
    std::vector<CostError> byDensity, byTrajectory;
    for (const Measured& m : measured) {
      byDensity.emplace_back(m.cost(), m.diverged ? std::numeric_limits<double>::quiet_NaN() : density(m));
      byTrajectory.emplace_back(m.cost(), m.diverged ? std::numeric_limits<double>::quiet_NaN() : trajectory(m));
    }
    const std::vector<size_t> front = paretoFront(byDensity), trajectoryFront = paretoFront(byTrajectory);
    const auto contains = [](const std::vector<size_t>& indices, size_t k) { return std::ranges::find(indices, k) != indices.end(); };

    Table table;
    table.title = c.name + " (" + c.scene + "): " + (measured.empty() ? "" : std::to_string(measured[0].run.particles)) + " particles, " +
                  number(c.duration_s) + " s";
    table.columns = {"setting", "wall s/s", "substeps/s", "mean", "p99", "max", "trajectory", "energy", "end", "Pareto front"};
    for (size_t k = 0; k < measured.size(); ++k) {
      const Measured& m = measured[k];
      const double seconds = std::max(m.run.simulated_s, 1e-12);
      table.rows.push_back({m.setting.name, number(m.cost()), number(double(m.run.substeps) / seconds, 4), percent(m.run.density.mean),
                            percent(m.run.density.p99), percent(m.run.density.max), percent(m.trajectory), number(m.run.energy.ratio, 5),
                            number(m.run.energy.end_ratio, 4),
                            m.diverged
                                ? "diverged"
                                : std::string(contains(front, k) ? "density " : "") + (contains(trajectoryFront, k) ? "trajectory" : "")});
      Json json = runJson(m.run);
      json["case"] = c.name;
      json["setting"] = m.setting.name;
      json["family"] = m.setting.family;
      for (const Override& change : m.setting.changes) json["changes"][change.key] = change.value;
      json["wall_per_simulated_s"] = sampleStatistics(m.wall);
      json["trajectory_error"] = m.trajectory;
      json["blown_up"] = m.diverged;
      json["on_front"] = {{"density", contains(front, k)}, {"trajectory", contains(trajectoryFront, k)}};
      report_.results.push_back(std::move(json));
    }
    table.note =
        "mean, p99, max: compression in the solver's kernel (" + kernel +
        "), without the first tenth of the run.\n"
        "trajectory: root mean square distance of center of mass, front and energies, divided by their initial values, from\n" +
        std::to_string(c.seeds) + " runs of " + std::to_string(c.convergedSteps) + " substeps per frame; the distance between these is " +
        percent(seedSpread) + ".\n" + "energy, end: largest and final energy divided by the initial energy." +
        (c.comparesSplishsplash ? "\nSPlisHSPlasH 2.16 in the diagram: dam50k, two threads of a similar machine, its own kernel." : "");
    report_.tables.push_back(std::move(table));

    Plot first{c.name + ": density error",
               "wall seconds per simulated second",
               "mean compression (kernel of h = 2.3 d unless noted)",
               true,
               true,
               {}};
    Plot second{c.name + ": trajectory error", "wall seconds per simulated second", "rms distance from converged runs", true, true, {}};
    std::vector<std::string> families;
    for (const Measured& m : measured)
      if (std::ranges::find(families, m.setting.family) == families.end()) families.push_back(m.setting.family);
    for (const std::string& family : families) {
      Series a{family, Series::Style::Points, {}, {}, family == "default"}, b = a;
      for (const Measured& m : measured) {
        if (m.setting.family != family) continue;
        const std::string label = m.setting.name + (m.diverged ? " (diverged)" : "");
        a.points.emplace_back(m.cost(), density(m));
        b.points.emplace_back(m.cost(), trajectory(m));
        a.labels.push_back(label);
        b.labels.push_back(label);
      }
      first.series.push_back(std::move(a));
      second.series.push_back(std::move(b));
    }
    const auto line = [](const std::vector<CostError>& points, const std::vector<size_t>& which) {
      Series series{"Pareto front", Series::Style::Lines, {}, {}};
      for (const size_t k : which) series.points.push_back(points[k]);
      return series;
    };
    first.series.push_back(line(byDensity, front));
    second.series.push_back(line(byTrajectory, trajectoryFront));
    if (c.comparesSplishsplash) first.series.push_back(splishsplash());
    report_.plots.push_back(std::move(first));
    report_.plots.push_back(std::move(second));
    compareStepping(c, measured);
  }

  /// Compares adaptive with fixed time steps: error and substeps over time, cost at equal error.
  void compareStepping(const Case& c, const std::vector<Measured>& measured) {
    std::vector<CostError> byMean, byWorst;
    for (const Measured& m : measured)
      if (m.setting.family == "fixed step" && !m.diverged) {
        byMean.emplace_back(m.cost(), m.run.density.mean);
        byWorst.emplace_back(m.cost(), m.run.density.p99);
      }
    Table table;
    table.title = c.name + ": adaptive against fixed time steps";
    table.columns = {"setting", "wall s/s", "fixed, equal mean", "saved", "fixed, equal p99", "saved"};
    Plot error{c.name + ": error over time", "simulated time (s)", "mean compression", false, true, {}};
    Plot steps{c.name + ": substeps over time", "simulated time (s)", "substeps per frame of 1/60 s", false, false, {}};
    for (const Measured& m : measured) {
      if (m.setting.family != "tolerance" && m.setting.family != "default") continue;
      const double mean = costAtError(byMean, m.run.density.mean), worst = costAtError(byWorst, m.run.density.p99);
      table.rows.push_back({m.setting.name, number(m.cost()), number(mean), percent(1 - m.cost() / mean, 2), number(worst),
                            percent(1 - m.cost() / worst, 2)});
      Series a{m.setting.name, Series::Style::Lines, {}, {}}, b = a;
      for (size_t k = 1; k < m.run.instants.size(); ++k) {
        a.points.emplace_back(m.run.instants[k].time_s, m.run.instants[k].stats.densityErrorMean);
        b.points.emplace_back(m.run.instants[k].time_s, m.run.instants[k].stats.substeps);
      }
      error.series.push_back(std::move(a));
      steps.series.push_back(std::move(b));
    }
    table.note = "fixed: cost of fixed steps at the same error; -: no measured fixed step reaches it.";
    report_.tables.push_back(std::move(table));
    report_.plots.push_back(std::move(error));
    report_.plots.push_back(std::move(steps));
  }

  Bench& bench_;
  Report report_;
};

}  // namespace

Expected<Report> runAccuracy(Bench& bench) { return Accuracy(bench).run(); }

}  // namespace rill::bench
