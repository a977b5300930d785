// What each feature costs when it is on, that it costs nothing when it is off, and which passes a scene runs at all.
#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "bench/suites/suites.hpp"
#include "core/words.hpp"

namespace rill::bench {
namespace {

using offline::PassTime;
using offline::Simulation;
using Clock = std::chrono::steady_clock;

constexpr double kFeatureFrame_s = 0.01;  // of twelve steps: two whole blocks, so that none is recorded for nothing
constexpr int kWarmUp = 2;                // frames in which shaders are compiled and the first guess of substeps is off

using Overrides = std::vector<Override>;

/// One thing that can be on. Steps are forced, so that all have the same work but for it.
struct Feature {
  std::string_view name;
  Overrides on;
  Overrides zero = {};     ///< says that it is off, where the base scene says nothing
  bool passTimes = false;  ///< the feature is that passes are timed
  bool measuring = false;  ///< the feature is that figures are measured each frame
};

const Overrides kBase = {{"solver.time_step", "0.00083333333"},
                         {"solver.tolerance", "0"},
                         {"solver.cfl", "10"},
                         {"fluid.tensile", "0"},
                         // Fast enough for a list build in about eleven substeps, as in a whole dam break.
                         {"fill[0].velocity", "[8, 0, 0]"}};

constexpr const char* kBox = R"([{"box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}}])";
constexpr const char* kFar = R"([{"box": {"min": [4.6, 3, 0.3], "max": [4.9, 3.6, 0.7]}}])";
constexpr const char* kSphere = R"([{"sphere": {"center": [2.8, 0.3, 0.5], "radius": 0.25}}])";
constexpr const char* kMoving =
    R"([{"box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}, "motion": [{"at": 0}, {"at": 1, "translate": [0.5, 0, 0]}]}])";

std::vector<Feature> features() {
  return {
      {"viscosity", {{"fluid.viscosity", "1"}}, {{"fluid.viscosity", "0"}}},
      {"vorticity", {{"fluid.vorticity", "0.2"}}, {{"fluid.vorticity", "0"}}},
      // Off, its other settings are to change nothing.
      {"tensile", {{"fluid.tensile", "0.2"}}, {{"fluid.tensile", "0"}, {"fluid.tensile_radius", "0.4"}, {"fluid.tensile_power", "2"}}},
      {"solid box", {{"solids", kBox}}, {{"solids", "[]"}}},
      {"solid out of reach", {{"solids", kFar}}},  // none at all: as above
      {"solid sphere", {{"solids", kSphere}}},
      {"moving solid", {{"solids", kMoving}}},
      {"3 iterations", {{"solver.iterations", "3"}, {"solver.warm_start", "0.02"}}, {{"solver.iterations", "1"}}},
      {"no artificial viscosity", {{"solver.artificial_viscosity", "0"}}},  // empty dispatches: the base scene is fast
      {"no warm start", {{"solver.warm_start", "0"}}},
      {"poly6 and spiky", {{"solver.kernel", "poly6_spiky"}}, {{"solver.kernel", "wendland"}}},
      {"grid, no list", {{"solver.neighbors", "grid"}}, {{"solver.neighbors", "list"}}},
      {"gravity changes", {{"gravity_changes", R"([{"at": 0.02, "value": [3, -9.81, 0]}])"}}, {{"gravity_changes", "[]"}}},
      {.name = "pass times", .on = {}, .passTimes = true},
      {.name = "figures", .on = {}, .measuring = true},
  };
}

/// One scene on its way: frames one by one, so that others can be run between them.
class Lane {
 public:
  static Expected<Lane> open(const Bench& bench, const std::string& scene, const Overrides& overrides, bool passTimes = false,
                             bool measuring = false) {
    auto read = namedScene(scene, overrides);
    if (!read) return read.error();
    offline::Options options;
    options.device = bench.options().device;
    options.passTimes = passTimes;
    auto simulation = Simulation::open(std::move(*read), options);
    if (!simulation) return simulation.error();
    Lane lane;
    lane.simulation_ = std::move(*simulation);
    lane.measuring_ = measuring;
    return lane;
  }

  /// Runs a frame; with figures where this lane measures.
  Expected<double> frame(double seconds) {
    const Clock::time_point begin = Clock::now();
    if (auto ran = simulation_->advance(seconds); !ran) return ran.error();
    if (measuring_)
      if (auto measured = simulation_->stats(); !measured) return measured.error();
    return 1e3 * std::chrono::duration<double>(Clock::now() - begin).count();
  }
  Expected<offline::Stats> stats() { return simulation_->stats(); }

 private:
  std::unique_ptr<Simulation> simulation_;
  bool measuring_ = false;
};

/// Frames of one lane.
struct Samples {
  std::vector<double> ms, ratio;  ///< of a frame; over the base's frame beside it
  uint64_t builds = 0;            ///< of the list
  offline::Stats end;             ///< of the last frame
  double ns() const { return 1e6 * median(ms) / (double(end.particles) * end.substeps); }
};

/// Runs lanes side by side, each frame of all before the next of any: what else the machine does meets them alike. The first is the base.
Expected<void> runTogether(const Bench& bench, std::vector<Lane>& lanes, int frames, std::vector<Samples>& samples) {
  for (int frame = 0; frame < kWarmUp + frames && !bench.stopped(); ++frame) {
    double base = 0;
    for (size_t k = 0; k < lanes.size(); ++k) {
      const auto ms = lanes[k].frame(kFeatureFrame_s);
      if (!ms) return ms.error();
      if (k == 0) base = *ms;
      auto stats = lanes[k].stats();
      if (!stats) return stats.error();
      if (frame >= kWarmUp) {
        samples[k].ms.push_back(*ms);
        samples[k].ratio.push_back(*ms / base);
        samples[k].builds += stats->list_builds;
      }
      samples[k].end = std::move(*stats);
    }
  }
  return {};
}

/// "build list 4, density 12", for comparing and for messages.
std::string passList(const std::vector<PassTime>& passes) {
  std::string text;
  for (const PassTime& pass : passes) text += (text.empty() ? "" : ", ") + pass.name + " " + std::to_string(pass.runs);
  return text;
}

/// Names of `passes` that `base` does not run, and those of `base` that are gone, with a minus.
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
std::string moreOf(uint64_t count, uint64_t base) {
  return count > base ? "+" + std::to_string(count - base) : std::to_string(int64_t(count) - int64_t(base));
}

/// Off must be what never was: the same passes as often, the same bits.
void holdZero(const std::string& name, const Samples& zero, const Samples& base, Report& report) {
  const std::string passes = passList(zero.end.pass_ms), expected = passList(base.end.pass_ms);
  if (passes != expected)
    report.failures.push_back(name + ": set to zero it runs other passes: " + passes +
                              "; expected those of the scene without it: " + expected);
  if (zero.end.state_hash != base.end.state_hash)
    report.failures.push_back(name + ": set to zero it gives other bits than the scene without it");
}

Json passesJson(const std::vector<PassTime>& passes) {
  Json json = Json::object();
  for (const PassTime& pass : passes) json[pass.name] = pass.runs;
  return json;
}

Json samplesJson(const Samples& samples) {
  return {{"ms_a_frame", sampled(samples.ms)},
          {"over_base", sampled(samples.ratio)},
          {"ns_a_particle_a_substep", samples.ns()},
          {"list_builds", samples.builds},
          {"passes", passesJson(samples.end.pass_ms)}};
}

/// What was measured of a feature; no `off` where it cannot be.
struct Cost {
  const Feature* feature;
  Samples base, on;
  std::optional<Samples> off;
};

/// Features that share one base, whose frames theirs take turns with.
constexpr size_t kGroup = 4;
Expected<std::vector<Cost>> measured(Bench& bench, std::span<const Feature> group) {
  std::string names;
  for (const Feature& feature : group) names += (names.empty() ? "" : ", ") + std::string(feature.name);
  std::vector<Samples> samples;
  for (uint32_t k = 0; k < bench.options().repeat && !bench.stopped(); ++k) {
    bench.step(names, group.size());
    std::vector<Lane> lanes;
    const auto open = [&](const Overrides& more, bool passTimes, bool measuring) -> Expected<void> {
      Overrides overrides = kBase;
      overrides.insert(overrides.end(), more.begin(), more.end());
      auto lane = Lane::open(bench, "dam10k", overrides, passTimes, measuring);
      if (!lane) return lane.error();
      lanes.push_back(std::move(*lane));
      return {};
    };
    if (auto opened = open({}, false, false); !opened) return opened.error();
    for (const Feature& feature : group) {
      if (auto opened = open(feature.on, feature.passTimes, feature.measuring); !opened) return opened.error();
      if (feature.zero.empty()) continue;
      if (auto opened = open(feature.zero, false, false); !opened) return opened.error();
    }
    samples.resize(lanes.size());
    if (auto ran = runTogether(bench, lanes, bench.quick() ? 6 : 16, samples); !ran) return ran.error();
  }
  std::vector<Cost> costs;
  if (samples.empty() || samples[0].ms.empty()) return costs;  // stopped before a frame that counts
  size_t next = 1;
  for (const Feature& feature : group) {
    Cost& cost = costs.emplace_back(Cost{&feature, samples[0], samples[next++], {}});
    if (!feature.zero.empty()) cost.off = samples[next++];
  }
  std::erase_if(costs, [](const Cost& cost) { return cost.on.ms.size() != cost.base.ms.size(); });
  return costs;
}

Expected<void> costs(Bench& bench, const std::vector<Feature>& wanted, Report& report) {
  Table table{
      "Each feature alone on the scene dam10k, steps of 1/1200 s",
      {"feature", "ns", "over base", "fastest", "list builds", "off, over base", "fastest", "passes that it adds"},
      {},
      "ns: a particle a substep. over base: the median over frames of its time over that of the scene without it, run side by side.\n"
      "fastest: its fastest frame over the base's fastest; where the two differ, other programs disturbed the run. off: named and set to\n"
      "zero; it then has the base's passes and bits, or the suite fails. list builds: more than the base's, in all frames measured; what\n"
      "changes how the water moves (a solid that it hits) changes how often the list is built, and that is in its cost."};
  Plot plot{"A feature's cost, and that of having it off",
            "time over that of the scene without it",
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
      report.failures.push_back(name + ": took " + std::to_string(on.end.substeps) + " substeps a frame, the base " +
                                std::to_string(base.end.substeps) + "; expected as many, or costs do not compare");
    std::vector<std::string> row{name,
                                 number(on.ns()),
                                 number(median(on.ratio)),
                                 fastest(on, base),
                                 moreOf(on.builds, base.builds),
                                 "-",
                                 "-",
                                 passChanges(on.end.pass_ms, base.end.pass_ms)};
    Json json{{"case", name}, {"base", samplesJson(base)}, {"on", samplesJson(on)}};
    const double place = double(table.rows.size() + 1);
    plot.rows.push_back(name);
    plot.series[0].points.emplace_back(median(on.ratio), place);
    if (off) {
      holdZero(name, *off, base, report);
      row[5] = number(median(off->ratio));
      row[6] = fastest(*off, base);
      json["off"] = samplesJson(*off);
      plot.series[1].points.emplace_back(median(off->ratio), place);
    }
    table.rows.push_back(std::move(row));
    report.results.push_back(std::move(json));
  };
  for (size_t first = 0; first < wanted.size() && !bench.stopped(); first += kGroup) {
    const auto group = measured(bench, std::span(wanted).subspan(first, std::min(kGroup, wanted.size() - first)));
    if (!group) return group.error();
    for (const Cost& cost : *group) add(cost);
  }
  if (table.rows.empty()) return {};
  report.tables.push_back(std::move(table));
  report.plots.push_back(std::move(plot));
  return {};
}

/// Scenes whose passes are listed.
struct PassScene {
  std::string_view name, scene;
  Overrides overrides = {};
};

std::vector<PassScene> passScenes() {
  return {
      {"empty", "empty"},
      {"resting", "resting-column"},
      {"no walls", "zero-gravity-drop"},
      {"no solids", "dam10k"},
      {"everything", "dam10k", {{"fluid.viscosity", "1"}, {"fluid.vorticity", "0.2"}, {"solver.iterations", "3"}, {"solids", kMoving}}},
  };
}

Expected<void> passes(Bench& bench, const std::vector<PassScene>& scenes, Report& report) {
  Table cost{"Scenes, in frames of 1/60 s",
             {"scene", "particles", "ms a frame", "substeps", "passes that ran", "kinds", "skipped"},
             {},
             "passes that ran: as recorded in one frame, figures too."};
  Table ran{"Passes of a scene: how often each is recorded in one frame",
            {"pass"},
            {},
            "What the device then finds nothing to do for is an empty dispatch. -: not there."};
  Table skipped{"Passes that were skipped, and why", {"pass", "reason", "scenes"}, {}, ""};
  std::vector<std::vector<PassTime>> all;
  std::map<std::pair<std::string, std::string>, std::string> reasons;
  for (const PassScene& scene : scenes) {
    if (bench.stopped()) break;
    const std::string name(scene.name);
    bench.step(name + ", passes");
    auto lane = Lane::open(bench, std::string(scene.scene), scene.overrides);
    if (!lane) return lane.error();
    std::vector<double> ms;
    for (int frame = 0; frame < kWarmUp + 3; ++frame) {
      const auto took = lane->frame(1.0 / 60);
      if (!took) return took.error();
      if (frame >= kWarmUp) ms.push_back(*took);
    }
    const auto stats = lane->stats();
    if (!stats) return stats.error();
    uint64_t runs = 0;
    Json json{{"case", name + ", passes"}, {"scene", scene.scene}, {"ms_a_frame", sampled(ms)}, {"substeps", stats->substeps}};
    json["passes"] = passesJson(stats->pass_ms);
    json["skipped"] = Json::object();
    for (const PassTime& pass : stats->pass_ms) runs += pass.runs;
    for (const auto& [pass, reason] : stats->skipped) {
      json["skipped"][pass] = reason;
      std::string& where = reasons[{pass, reason}];
      where += (where.empty() ? "" : ", ") + name;
    }
    report.results.push_back(std::move(json));
    cost.rows.push_back({name, grouped(stats->particles), number(median(ms)), std::to_string(stats->substeps), std::to_string(runs),
                         std::to_string(stats->pass_ms.size()), std::to_string(stats->skipped.size())});
    ran.columns.push_back(name);
    if (stats->particles == 0 && runs > 0)
      report.failures.push_back(name + ": a scene without particles ran " + passList(stats->pass_ms) + "; expected no pass at all");
    all.push_back(stats->pass_ms);
  }
  std::vector<std::string> names;
  for (const auto& list : all)
    for (const PassTime& pass : list)
      if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
  for (const std::string& name : names) {
    std::vector<std::string> row{name};
    for (const auto& list : all) {
      const auto found = std::ranges::find(list, name, &PassTime::name);
      row.push_back(found == list.end() ? "-" : std::to_string(found->runs));
    }
    ran.rows.push_back(std::move(row));
  }
  for (const auto& [what, where] : reasons) skipped.rows.push_back({what.first, what.second, where});
  for (Table* table : {&cost, &ran, &skipped})
    if (!table->rows.empty()) report.tables.push_back(std::move(*table));
  return {};
}

}  // namespace

Expected<Report> runFeatures(Bench& bench) {
  std::vector<Feature> wanted = features();
  std::erase_if(wanted, [&](const Feature& feature) { return !bench.wanted(feature.name); });
  std::vector<PassScene> scenes = passScenes();
  std::erase_if(scenes, [&](const PassScene& scene) { return !bench.wanted(std::string(scene.name) + ", passes"); });
  bench.plan(wanted.size() * bench.options().repeat + scenes.size());
  Report report;
  if (auto ran = costs(bench, wanted, report); !ran) return ran.error();
  if (auto ran = passes(bench, scenes, report); !ran) return ran.error();
  return report;
}

}  // namespace rill::bench
