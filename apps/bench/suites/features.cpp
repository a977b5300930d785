// Cost of each feature when enabled, and checks that disabled features cost nothing.
#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "bench/suites/frame_stepper.hpp"
#include "bench/suites/scene_passes.hpp"
#include "bench/suites/suites.hpp"
#include "core/words.hpp"

namespace rill::bench {
namespace {

using offline::PassTime;

constexpr double kFeatureFrame_s = 0.01;  // twelve substeps: two full blocks, so that no recorded substep is skipped

/// Samples of one run.
struct Samples {
  std::vector<double> ms, ratio;  ///< per frame; divided by the base's adjacent frame
  uint64_t builds = 0;            ///< of the neighbor list
  offline::Stats end;             ///< statistics of the last frame
  double ns() const { return 1e6 * median(ms) / (double(end.particles) * end.substeps); }
};

/// Advances all frame by frame in turn, so that other load on the machine affects them equally. The first is the base.
Expected<void> runInterleaved(const Bench& bench, std::vector<FrameStepper>& steppers, int frames, std::vector<Samples>& samples) {
  for (int frame = 0; frame < kWarmUp + frames && !bench.stopped(); ++frame) {
    double base = 0;
    for (size_t k = 0; k < steppers.size(); ++k) {
      const auto ms = steppers[k].frame(kFeatureFrame_s);
      if (!ms) return ms.error();
      if (k == 0) base = *ms;
      auto stats = steppers[k].stats();
      if (!stats) return stats.error();
      if (frame >= kWarmUp) {
        samples[k].ms.push_back(*ms);
        samples[k].ratio.push_back(*ms / base);
        samples[k].builds += stats->listBuilds;
      }
      samples[k].end = std::move(*stats);
    }
  }
  return {};
}

/// Passes that are added to those of `base`, and removed ones as "no NAME".
std::string passChanges(const std::vector<PassTime>& passes, const std::vector<PassTime>& base) {
  std::string text;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
  for (const PassTime& pass : passes)
    if (std::ranges::find(base, pass.name, &PassTime::name) == base.end()) add(pass.name);
  for (const PassTime& pass : base)
    if (std::ranges::find(passes, pass.name, &PassTime::name) == passes.end()) add("no " + pass.name);
  return text;
}

/// "+3", "-2", "0".
std::string signedDifference(uint64_t count, uint64_t base) {
  return count > base ? "+" + std::to_string(count - base) : std::to_string(int64_t(count) - int64_t(base));
}

/// Checks that a disabled feature runs the same passes as the base and gives a bitwise identical state. How often they are recorded depends
/// on the pieces that an advance is cut into, which are sized by time.
void checkDisabled(const std::string& name, const Samples& off, const Samples& base, Report& report) {
  if (const std::string changes = passChanges(off.end.passes, base.end.passes); !changes.empty())
    report.failures.push_back(name + " disabled: expected the passes of the base scene, found " + changes);
  if (off.end.stateHash != base.end.stateHash)
    report.failures.push_back(name + " disabled: the state hash differs from that of the base scene");
}

Json samplesJson(const Samples& samples) {
  return {{"ms_a_frame", sampleStatistics(samples.ms)},
          {"over_base", sampleStatistics(samples.ratio)},
          {"ns_a_particle_a_substep", samples.ns()},
          {"list_builds", samples.builds},
          {"passes", passesJson(samples.end.passes)}};
}

/// Results of a feature; `off` is empty if it cannot be disabled explicitly.
struct Cost {
  const Feature* feature;
  Samples base, on;
  std::optional<Samples> off;
};

/// Number of features that are interleaved with one run of the base.
constexpr size_t kGroup = 4;
Expected<std::vector<Cost>> measured(Bench& bench, std::span<const Feature> group) {
  std::string names;
  for (const Feature& feature : group) names += (names.empty() ? "" : ", ") + std::string(feature.name);
  std::vector<Samples> samples;
  for (uint32_t k = 0; k < bench.options().repeat && !bench.stopped(); ++k) {
    bench.step(names, group.size());
    std::vector<FrameStepper> steppers;
    const auto open = [&](const Overrides& more, const Feature* feature) -> Expected<void> {
      Overrides overrides = baseChanges();
      overrides.insert(overrides.end(), more.begin(), more.end());
      auto stepper = FrameStepper::open(bench, "dam10k", overrides, feature);
      if (!stepper) return stepper.error();
      steppers.push_back(std::move(*stepper));
      return {};
    };
    if (auto opened = open({}, nullptr); !opened) return opened.error();
    for (const Feature& feature : group) {
      if (auto opened = open(feature.on, &feature); !opened) return opened.error();
      if (feature.off.empty()) continue;
      if (auto opened = open(feature.off, nullptr); !opened) return opened.error();
    }
    samples.resize(steppers.size());
    if (auto done = runInterleaved(bench, steppers, bench.quick() ? 6 : 16, samples); !done) return done.error();
  }
  std::vector<Cost> costs;
  if (samples.empty() || samples[0].ms.empty()) return costs;  // stopped before the first sample
  size_t next = 1;
  for (const Feature& feature : group) {
    Cost& cost = costs.emplace_back(Cost{&feature, samples[0], samples[next++], {}});
    if (!feature.off.empty()) cost.off = samples[next++];
  }
  std::erase_if(costs, [](const Cost& cost) { return cost.on.ms.size() != cost.base.ms.size(); });
  return costs;
}

Expected<void> costs(Bench& bench, const std::vector<Feature>& chosen, Report& report) {
  Table table{
      "Each feature alone in the scene dam10k, time steps of 1/1200 s",
      {"feature", "ns", "on / base", "fastest", "list builds", "off / base", "fastest", "added passes"},
      {},
      "ns: per particle and substep. on / base: median over frames of the time with the feature divided by the time of the base scene,\n"
      "frames interleaved. fastest: the same ratio of the fastest frames; if the two ratios differ, other programs disturbed the run.\n"
      "off: the feature disabled explicitly; fails unless it runs the passes of the base and gives the same bits. list builds: difference\n"
      "from the base over all frames; features that change the flow (solids) change the number of list builds, which is in their cost."};
  Plot plot{"Cost of features, enabled and disabled",
            "time / time of the base scene",
            "",
            false,
            false,
            {{"on", Series::Style::Points, {}, {}}, {"off", Series::Style::Points, {}, {}}}};
  const auto fastest = [](const Samples& one, const Samples& other) {
    return number(std::ranges::min(one.ms) / std::ranges::min(other.ms));
  };
  const auto add = [&](const Cost& cost) {
    const auto& [feature, base, on, off] = cost;
    const std::string name(feature->name);
    if (on.end.substeps != base.end.substeps)
      report.failures.push_back(name + ": found " + std::to_string(on.end.substeps) +
                                " substeps per frame, expected those of the base scene: " + std::to_string(base.end.substeps));
    std::vector<std::string> row{name,
                                 number(on.ns()),
                                 number(median(on.ratio)),
                                 fastest(on, base),
                                 signedDifference(on.builds, base.builds),
                                 "-",
                                 "-",
                                 passChanges(on.end.passes, base.end.passes)};
    Json json{{"case", name}, {"base", samplesJson(base)}, {"on", samplesJson(on)}};
    const double rowY = double(table.rows.size() + 1);
    plot.rows.push_back(name);
    plot.series[0].points.emplace_back(median(on.ratio), rowY);
    if (off) {
      checkDisabled(name, *off, base, report);
      row[5] = number(median(off->ratio));
      row[6] = fastest(*off, base);
      json["off"] = samplesJson(*off);
      plot.series[1].points.emplace_back(median(off->ratio), rowY);
    }
    table.rows.push_back(std::move(row));
    report.results.push_back(std::move(json));
  };
  for (size_t first = 0; first < chosen.size() && !bench.stopped(); first += kGroup) {
    const auto group = measured(bench, std::span(chosen).subspan(first, std::min(kGroup, chosen.size() - first)));
    if (!group) return group.error();
    for (const Cost& cost : *group) add(cost);
  }
  if (table.rows.empty()) return {};
  report.tables.push_back(std::move(table));
  report.plots.push_back(std::move(plot));
  return {};
}

}  // namespace

Expected<Report> runFeatures(Bench& bench) {
  std::vector<Feature> chosen = features();
  std::erase_if(chosen, [&](const Feature& feature) { return !bench.selected(feature.name); });
  std::vector<PassScene> scenes = passScenes();
  std::erase_if(scenes, [&](const PassScene& scene) { return !bench.selected(std::string(scene.name) + ", passes"); });
  bench.plan(chosen.size() * bench.options().repeat + scenes.size());
  Report report;
  if (auto done = costs(bench, chosen, report); !done) return done.error();
  if (auto done = listPasses(bench, scenes, report); !done) return done.error();
  return report;
}

}  // namespace rill::bench
