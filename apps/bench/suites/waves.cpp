// Suite `waves`: standing and solitary waves and a leveling tank against theory, and settings of the solver by error and run time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/experiments/bands.hpp"
#include "bench/pareto.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/wave_groups.hpp"

namespace rill::bench {
namespace {

constexpr size_t kParts = 4;             // of progress in an experiment; one in a repetition of a setting
constexpr double kSmallestShown = 1e-4;  // errors below it are drawn there: axes are logarithmic

struct WaveDiagram {
  const char *key, *title, *x, *y;
};
constexpr WaveDiagram kWaveDiagrams[] = {
    {"dispersion", "Standing waves: dispersion", "k h", "omega / sqrt(g k)"},
    {"amplitude-deep", "Standing waves, deep tank: amplitude", "t / theoretical period", "amplitude / linear theory"},
    {"amplitude-shallow", "Standing waves, shallow tank: amplitude", "t / theoretical period", "amplitude / linear theory"},
    {"amplitude-viscous", "Standing wave, tank of 0.1 m: amplitude", "t / theoretical period", "amplitude / linear theory"},
    {"solitary", "Solitary wave: height of the crest", "depths traveled", "height / initial"},
    {"level", "Tilted tank: shift of the center of mass", "s", "shift / hydrostatic"},
};

class Waves {
 public:
  explicit Waves(Bench& bench) : bench_(bench) {}

  Expected<Report> run() {
    std::vector<WaveGroup> groups = waveGroups();
    size_t parts = 0;
    for (WaveGroup& group : groups) {
      std::erase_if(group.experiments, [&](const Experiment& e) { return (bench_.quick() && !e.quick) || !bench_.selected(e.name()); });
      parts += group.experiments.size() * (kParts + (group.row ? 0 : bench_.options().repeat - 1));
    }
    bench_.plan(parts, "part");
    bool failed = false;
    for (const WaveGroup& group : groups) {
      if (failed) break;
      std::vector<WaveResult> results;
      for (const Experiment& experiment : group.experiments) {
        if (bench_.stopped()) break;
        bench_.step(experiment.name(), kParts);
        auto outcome = experiment.run(bench_);
        if (!outcome && report_.results.empty()) return outcome.error();
        if (!outcome) {  // what was measured before is worth hours
          report_.failures.push_back(experiment.name() + ": " + outcome.error().message + "; what follows was not run");
          failed = true;
          break;
        }
        if (bench_.stopped()) break;  // incomplete runs have no figures
        results.push_back({experiment, std::move(*outcome)});
        add(results.back());
      }
      if (!group.row && !failed)
        if (auto repeated = repeatSettings(results); !repeated) return repeated.error();
      if (results.empty()) continue;
      if (group.row)
        addTable(group, results);
      else
        compareSettings(group, results);
    }
    drawCurves();
    return std::move(report_);
  }

 private:
  void add(const WaveResult& result) {
    const Experiment& experiment = result.experiment;
    Json figures = Json::array();
    for (const Figure& figure : result.outcome.figures) {
      const Band* band = bandOf(experiment.family, figure.name);
      if (!band) report_.failures.push_back(experiment.name() + ": " + figure.name + ": missing in bands.cpp");
      figures.push_back({{"name", figure.name}, {"measured", figure.measured}, {"error", figure.error}});
      if (std::isfinite(figure.expected)) figures.back()["expected"] = figure.expected;
      const double limit = band ? band->band[experiment.level] : std::numeric_limits<double>::infinity();
      if (!std::isfinite(limit)) continue;
      figures.back()["band"] = limit;
      if (!(std::abs(figure.error) <= limit))  // NaN fails
        report_.failures.push_back(experiment.name() + ": " + figure.name + ": found error " + number(figure.error) +
                                   ", expected at most " + number(limit));
    }
    const RunFigures& run = result.outcome.run;
    report_.results.push_back({{"name", experiment.name()},
                               {"spacing_m", experiment.spacing_m},
                               {"wall_per_simulated_s", result.cost()},
                               {"figures", std::move(figures)},
                               {"curves", result.outcome.curves},
                               {"run", runJson(run)}});
    for (const Overlay& overlay : result.outcome.overlays) overlays_.push_back(overlay);
    if (run.nonFinite > 0)
      report_.failures.push_back(experiment.name() + ": " + std::to_string(run.nonFinite) + " particles are not finite");
    if (run.timeDropped_s > 0)
      report_.failures.push_back(experiment.name() + ": found " + number(run.timeDropped_s) +
                                 " s of dropped simulation time, expected none");
  }

  void addTable(const WaveGroup& group, const std::vector<WaveResult>& results) {
    Table table{group.title, {"experiment", "particles", "d mm"}, {}, group.note};
    table.columns.insert(table.columns.end(), group.columns.begin(), group.columns.end());
    table.columns.emplace_back("wall s/s");
    for (const WaveResult& result : results) {
      std::vector<std::string> cells{result.experiment.family, std::to_string(result.outcome.run.particles),
                                     number(1e3 * result.experiment.spacing_m)};
      const auto more = group.row(result, results);
      cells.insert(cells.end(), more.begin(), more.end());
      cells.push_back(number(result.cost()));
      table.rows.push_back(std::move(cells));
    }
    report_.tables.push_back(std::move(table));
  }

  static const WaveSetting& settingOf(const WaveResult& result) {
    return *std::ranges::find_if(comparedSettings(),
                                 [&](const WaveSetting& one) { return result.experiment.family == std::string("setting ") + one.name; });
  }

  /// Times a period of each setting again, one setting after the other, so that other load on the machine falls on all.
  Expected<void> repeatSettings(std::vector<WaveResult>& results) {
    for (WaveResult& result : results) result.wall.push_back(settingCost(result.outcome.run));
    for (uint32_t round = 1; round < bench_.options().repeat; ++round)
      for (WaveResult& result : results) {
        if (bench_.stopped()) return {};
        bench_.step(result.experiment.name() + " again");
        const auto outcome = runWaveSetting(bench_, settingOf(result), 1.2);
        if (!outcome) return outcome.error();
        if (bench_.stopped()) return {};
        result.wall.push_back(settingCost(outcome->run));
      }
    return {};
  }

  void compareSettings(const WaveGroup& group, const std::vector<WaveResult>& results) {
    std::vector<CostError> byPeriod, byLoss;
    for (const WaveResult& r : results) {
      byPeriod.emplace_back(median(r.wall), std::max(std::abs(r.figure("period").error), kSmallestShown));
      byLoss.emplace_back(median(r.wall), std::max(r.figure("loss a period").measured, kSmallestShown));
    }
    const std::vector<size_t> periodFront = paretoFront(byPeriod), lossFront = paretoFront(byLoss);
    const auto on = [](const std::vector<size_t>& front, size_t k) { return std::ranges::find(front, k) != front.end(); };
    Table table{
        group.title,
        {"setting", "changes", "wall s/s", "substeps/s", "period error", "loss a period", "residual", "Pareto front"},
        {},
        "wall s/s: wall seconds per simulated second over one period, median of --repeat runs. Pareto front: no other setting has a\n"
        "smaller error at the same or a lower cost."};
    std::vector<std::string> names;
    for (size_t k = 0; k < results.size(); ++k) {
      const WaveResult& r = results[k];
      const WaveSetting& setting = settingOf(r);
      names.emplace_back(setting.name);
      table.rows.push_back({setting.name, *setting.changes ? setting.changes : "none", number(median(r.wall)),
                            number(double(r.outcome.run.substeps) / std::max(r.outcome.run.simulated_s, 1e-12), 4),
                            percent(r.figure("period").error, 2), percent(r.figure("loss a period").measured, 2), percent(r.residual(), 2),
                            std::string(on(periodFront, k) ? "period " : "") + (on(lossFront, k) ? "loss" : "")});
      Json& json = report_.results[report_.results.size() - results.size() + k];
      json["wall_per_simulated_s_samples"] = sampleStatistics(r.wall);
      json["changes"] = setting.changes;
      json["on_front"] = {{"period", on(periodFront, k)}, {"loss", on(lossFront, k)}};
    }
    report_.tables.push_back(std::move(table));
    // A series per setting: many points coincide, so only those on the front have a label.
    const auto diagram = [&](const char* title, const char* y, bool logY, const std::vector<CostError>& points,
                             const std::vector<size_t>& front) {
      Plot plot{title, "wall seconds per simulated second", y, true, logY, {}};
      Series line{"Pareto front", Series::Style::Lines, {}, {}};
      for (const size_t k : front) line.points.emplace_back(points[k].first, 100 * points[k].second);
      plot.series.push_back(std::move(line));
      for (size_t k = 0; k < points.size(); ++k)
        plot.series.push_back(
            {names[k], Series::Style::Points, {{points[k].first, 100 * points[k].second}}, {on(front, k) ? names[k] : ""}, k == 0});
      report_.plots.push_back(std::move(plot));
    };
    diagram("Settings: error of the period", "error of the period, %", true, byPeriod, periodFront);
    diagram("Settings: amplitude lost", "loss a period, %", false, byLoss, lossFront);
  }

  /// The diagrams of curves, before those of settings.
  void drawCurves() {
    std::vector<Plot> plots;
    for (const WaveDiagram& diagram : kWaveDiagrams) {
      Plot plot{diagram.title, diagram.x, diagram.y, false, false, {}};
      for (const Overlay& overlay : overlays_) {
        if (overlay.plot != diagram.key) continue;
        const auto found = std::ranges::find(plot.series, overlay.series.name, &Series::name);
        if (found == plot.series.end())
          plot.series.push_back(overlay.series);
        else
          found->points.insert(found->points.end(), overlay.series.points.begin(), overlay.series.points.end());
      }
      if (plot.series.empty()) continue;
      if (std::string_view(diagram.key) == "dispersion") plot.series.push_back(theory());
      plots.push_back(std::move(plot));
    }
    report_.plots.insert(report_.plots.begin(), plots.begin(), plots.end());
  }

  static Series theory() {
    Series series{"sqrt(tanh(k h))", Series::Style::Lines, {}, {}};
    for (double kh = 0.2; kh < 6.05; kh += 0.1) series.points.emplace_back(kh, std::sqrt(std::tanh(kh)));
    return series;
  }

  Bench& bench_;
  Report report_;
  std::vector<Overlay> overlays_;
};

}  // namespace

Expected<Report> runWaves(Bench& bench) { return Waves(bench).run(); }

}  // namespace rill::bench
