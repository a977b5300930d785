// Suite `validation`: published experiments and exact solutions at three resolutions, with an aim and a pass band per figure.
#include <algorithm>
#include <cmath>

#include "bench/experiments/bands.hpp"
#include "bench/experiments/curves.hpp"
#include "bench/experiments/exact.hpp"
#include "bench/experiments/experiment.hpp"
#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

struct Diagram {
  const char *key, *title, *x, *y;
  const char* published;  // a file of assets/validation, or null
};
constexpr Diagram kDiagrams[] = {
    {"column-1-front", "Martin & Moyce, square column: front", "T = t sqrt(g/a)", "x / a", "martin_moyce_n2_1_front"},
    {"column-1-height", "Martin & Moyce, square column: height at the wall", "T = t sqrt(g/a)", "h / a", "martin_moyce_n2_1_height"},
    {"column-2-front", "Martin & Moyce, column 2a high: front", "T = t sqrt(2g/a)", "x / a", "martin_moyce_n2_2_front"},
    {"column-2-height", "Martin & Moyce, column 2a high: height at the wall", "t sqrt(g/a)", "h / 2a", "martin_moyce_n2_2_height"},
    {"elliptic", "Elliptic drop: long axis", "A0 t", "b / R", "elliptic_drop"},
    {"slosh", "Slosh: center of mass", "t / theoretical period", "x / linear theory", nullptr},
    {"residual-motion", "Still tank, 1 m deep: rms speed", "s", "m/s", nullptr},
    {"jet", "Torricelli's jet", "s", "speed / sqrt(2 g head)", nullptr},
};

/// A figure that is drawn against the resolution.
struct Convergence {
  const char *family, *figure, *title;
};
constexpr Convergence kConvergenceFigures[] = {{"slosh", "period", "Slosh: error of the period"},
                                               {"elliptic-drop", "long axis, end", "Elliptic drop: error of the long axis"}};

std::vector<Experiment> experiments() {
  std::vector<Experiment> all;
  for (const auto& family :
       {columnExperiments(),   tankExperiments(),  sloshExperiments(),   ellipticExperiments(),   freeExperiments(),
        jetExperiments(),      liftExperiments(),  bodyExperiments(),    slipExperiments(),       waterEntryExperiments(),
        obstacleExperiments(), tapExperiments(),   channelExperiments(), orificeExperiments(),    weirExperiments(),
        jumpExperiments(),     lakeExperiments(),  mixtureExperiments(), bubbleExperiments(),     dropExperiments(),
        oilDropExperiments(),  shearExperiments(), crownExperiments(),   dropMotionExperiments(), wettingExperiments(),
        sinkingExperiments()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

std::string inUnit(double value, std::string_view unit) {
  if (!std::isfinite(value)) return "-";
  if (unit == "%") return percent(value);
  return number(value) + (unit.empty() ? "" : " " + std::string(unit));
}

/// Results that the suite collects while it runs.
struct Findings {
  Report report;
  Table table{
      "Experiments and exact solutions", {"experiment", "d m", "figure", "measured", "expected", "error", "aim", "band", "passed"}, {}, ""};
  std::vector<std::pair<std::string, Series>> overlays;
  std::vector<Series> convergence[std::size(kConvergenceFigures)];
  struct Missed {
    std::string reason;
    std::vector<std::string> figures;
  };
  std::vector<Missed> missed;  ///< aims that were missed, by reason

  void evaluate(const Experiment& experiment, const Figure& figure, Json& json) {
    const Band* band = bandOf(experiment.family, figure.name);
    if (!band) report.failures.push_back(experiment.name() + ": " + figure.name + ": missing in bands.cpp");
    const std::string_view unit = band ? band->unit : std::string_view();
    const double aim = band ? band->aim : std::numeric_limits<double>::quiet_NaN();
    const double limit = band ? band->band[experiment.level] : std::numeric_limits<double>::infinity();
    const bool hasBand = std::isfinite(limit), passed = std::abs(figure.error) <= limit;  // NaN fails
    const bool reached = !std::isfinite(aim) || std::abs(figure.error) <= aim;
    table.rows.push_back({experiment.name(), number(experiment.spacing_m, 3), figure.name, number(figure.measured, 4),
                          number(figure.expected, 4), inUnit(figure.error, unit), inUnit(aim, unit), hasBand ? inUnit(limit, unit) : "-",
                          !hasBand  ? "-"
                          : !passed ? "NO"
                          : reached ? "yes"
                                    : "yes, aim missed"});
    if (hasBand && !passed)
      report.failures.push_back(experiment.name() + ": " + figure.name + ": found error " + inUnit(figure.error, unit) +
                                ", expected at most " + inUnit(limit, unit));
    if (hasBand && !reached && band->reason.size() > 0) {
      // Figures with the same reason share one entry.
      const std::string reason(band->reason), about = experiment.family + ", " + figure.name;
      auto found = std::ranges::find(missed, reason, &Missed::reason);
      if (found == missed.end()) found = missed.insert(missed.end(), {reason, {}});
      if (std::ranges::find(found->figures, about) == found->figures.end()) found->figures.push_back(about);
    }
    json.push_back(
        {{"name", figure.name}, {"measured", figure.measured}, {"error", figure.error}, {"unit", unit == "%" ? "fraction" : unit}});
    if (std::isfinite(figure.expected)) json.back()["expected"] = figure.expected;
    if (std::isfinite(aim)) json.back()["aim"] = aim;
    if (hasBand) json.back().update({{"band", limit}, {"holds", passed}});
    draw(experiment, figure);
  }

  void draw(const Experiment& experiment, const Figure& figure) {
    for (size_t c = 0; c < std::size(kConvergenceFigures); ++c) {
      if (!experiment.family.starts_with(kConvergenceFigures[c].family) || figure.name != kConvergenceFigures[c].figure) continue;
      auto& curves = convergence[c];
      if (curves.empty() || curves.back().name != experiment.family) curves.push_back({experiment.family, Series::Style::Both, {}, {}});
      curves.back().points.emplace_back(experiment.spacing_m, 100 * figure.error);
    }
  }

  void add(const Experiment& experiment, const Outcome& outcome) {
    Json json;
    json["name"] = experiment.name();
    json["spacing_m"] = experiment.spacing_m;
    Json figures = Json::array();
    for (const Figure& figure : outcome.figures) evaluate(experiment, figure, figures);
    json["figures"] = std::move(figures);
    json["curves"] = outcome.curves;
    json["run"] = runJson(outcome.run);
    report.results.push_back(std::move(json));
    for (const Overlay& overlay : outcome.overlays) overlays.emplace_back(overlay.plot, overlay.series);
    if (outcome.run.nonFinite > 0)
      report.failures.push_back(experiment.name() + ": " + std::to_string(outcome.run.nonFinite) + " particles are not finite");
    if (outcome.run.timeDropped_s > 0)
      report.failures.push_back(experiment.name() + ": found " + number(outcome.run.timeDropped_s) +
                                " s of dropped simulation time, expected none");
  }

  Expected<void> drawAll() {
    for (const Diagram& diagram : kDiagrams) {
      Plot plot{diagram.title, diagram.x, diagram.y, false, false, {}};
      for (const auto& [key, series] : overlays)
        if (key == diagram.key) plot.series.push_back(series);
      if (plot.series.empty()) continue;
      if (diagram.published) {
        const auto points = publishedCurve(diagram.published);
        if (!points) return points.error();
        plot.series.push_back({"published", Series::Style::Points, *points, {}});
      }
      plot.logY = plot.title.starts_with("Still tank");
      report.plots.push_back(std::move(plot));
    }
    for (size_t c = 0; c < std::size(kConvergenceFigures); ++c)
      if (!convergence[c].empty())
        report.plots.push_back({kConvergenceFigures[c].title, "spacing d, m", "error, %", true, false, convergence[c]});
    return {};
  }
};

constexpr const char* kNote =
    "d: particle spacing. aim: error that a solver should reach; band: largest error that passes.\n"
    "Curves: root mean square of relative differences from the published points; unshifted, and after the best shift in time (in units\n"
    "of the curve's time axis). Front: farthest particle with five others within 2 d, plus d/2. Level: mean height of particles without\n"
    "others above, plus d/2, against N d^3 / floor area. Bulk density: mean signed error in a kernel of twice the solver's support,\n"
    "calibrated on the rest lattice, over particles farther than that support from walls and surface. Clumped: fraction of particles\n"
    "whose nearest neighbor is nearer than d/2. Pressure: force per area that supports the particles above a plane from 4 to 6 s, derived\n"
    "from their momentum, at four depths, against rho g depth; it is not the solver's internal pressure.";

}  // namespace

Expected<Report> runValidation(Bench& bench) {
  std::vector<Experiment> chosen;
  for (Experiment& experiment : experiments())
    if ((experiment.quick || !bench.quick()) && bench.selected(experiment.name())) chosen.push_back(std::move(experiment));
  bench.plan(chosen.size());
  Findings findings;
  for (const Experiment& experiment : chosen) {
    if (bench.stopped()) break;
    bench.step(experiment.name());
    const auto outcome = experiment.run(bench);
    if (!outcome && findings.report.results.empty()) return outcome.error();
    if (!outcome) {  // what was measured before is worth hours
      findings.report.failures.push_back(experiment.name() + ": " + outcome.error().message + "; what follows was not run");
      break;
    }
    if (bench.stopped()) break;  // incomplete runs have no figures
    findings.add(experiment, *outcome);
  }
  findings.table.note = kNote;
  if (!findings.missed.empty()) findings.table.note += "\nAims missed:";
  for (const auto& [reason, figures] : findings.missed) {
    findings.table.note += "\n";
    for (const std::string& figure : figures) findings.table.note += (&figure == &figures.front() ? "  " : "; ") + figure;
    findings.table.note += ":\n    " + reason;
  }
  findings.report.tables.push_back(std::move(findings.table));
  if (auto drawn = findings.drawAll(); !drawn) return drawn.error();
  return std::move(findings.report);
}

}  // namespace rill::bench
