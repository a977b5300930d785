#include "bench/suites/scene_passes.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "bench/suites/frame_stepper.hpp"
#include "core/words.hpp"

namespace rill::bench {
namespace {

using offline::PassTime;

/// Passes and their counts: "build list 4, density 12".
std::string passList(const std::vector<PassTime>& passes) {
  std::string text;
  for (const PassTime& pass : passes) text += (text.empty() ? "" : ", ") + pass.name + " " + std::to_string(pass.recorded);
  return text;
}

/// A row for each pass, a column for each scene. `lists`: the passes of each scene.
Table recordedTable(const std::vector<std::string>& scenes, const std::vector<std::vector<PassTime>>& lists) {
  Table table{"Passes of a scene, recorded per frame", {"pass"}, {}, "Recorded passes without work are empty dispatches. -: not recorded."};
  table.columns.insert(table.columns.end(), scenes.begin(), scenes.end());
  std::vector<std::string> names;
  for (const auto& list : lists)
    for (const PassTime& pass : list)
      if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
  for (const std::string& name : names) {
    std::vector<std::string> row{name};
    for (const auto& list : lists) {
      const auto found = std::ranges::find(list, name, &PassTime::name);
      row.push_back(found == list.end() ? "-" : std::to_string(found->recorded));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Expected<void> listPasses(Bench& bench, const std::vector<PassScene>& scenes, Report& report) {
  Table cost{"Scenes, in frames of 1/60 s",
             {"scene", "particles", "ms per frame", "substeps", "passes", "kinds", "skipped"},
             {},
             "passes: recorded in one frame, including those that measure figures. kinds: distinct passes. skipped: passes not recorded."};
  Table skipped{"Skipped passes and reasons", {"pass", "reason", "scenes"}, {}, ""};
  std::vector<std::string> named;
  std::vector<std::vector<PassTime>> all;
  std::map<std::pair<std::string, std::string>, std::string> reasons;
  for (const PassScene& scene : scenes) {
    if (bench.stopped()) break;
    const std::string name(scene.name);
    bench.step(name + ", passes");
    auto stepper = FrameStepper::open(bench, std::string(scene.scene), scene.overrides);
    if (!stepper) return stepper.error();
    std::vector<double> ms;
    for (int frame = 0; frame < kWarmUp + 3; ++frame) {
      const auto took = stepper->frame(1.0 / 60);
      if (!took) return took.error();
      if (frame >= kWarmUp) ms.push_back(*took);
    }
    const auto stats = stepper->stats();
    if (!stats) return stats.error();
    uint64_t runs = 0;
    Json json{{"case", name + ", passes"}, {"scene", scene.scene}, {"ms_a_frame", sampleStatistics(ms)}, {"substeps", stats->substeps}};
    json["passes"] = passesJson(stats->passes);
    json["skipped"] = Json::object();
    for (const PassTime& pass : stats->passes) runs += pass.recorded;
    for (const auto& [pass, reason] : stats->skipped) {
      json["skipped"][pass] = reason;
      std::string& where = reasons[{pass, reason}];
      where += (where.empty() ? "" : ", ") + name;
    }
    report.results.push_back(std::move(json));
    cost.rows.push_back({name, grouped(stats->particles), number(median(ms)), std::to_string(stats->substeps), std::to_string(runs),
                         std::to_string(stats->passes.size()), std::to_string(stats->skipped.size())});
    named.push_back(name);
    if (stats->particles == 0 && runs > 0)
      report.failures.push_back(name + ": found passes " + passList(stats->passes) + " in a scene without particles, expected none");
    all.push_back(stats->passes);
  }
  for (const auto& [what, where] : reasons) skipped.rows.push_back({what.first, what.second, where});
  Table recorded = recordedTable(named, all);
  for (Table* table : {&cost, &recorded, &skipped})
    if (!table->rows.empty()) report.tables.push_back(std::move(*table));
  return {};
}

}  // namespace rill::bench
