// Counting and radix sort against the standard library, by number, range and distribution of the keys.
#include <algorithm>
#include <chrono>
#include <random>

#include "bench/suites/count_name.hpp"
#include "bench/suites/suites.hpp"
#include "bench/workbench.hpp"
#include "core/words.hpp"
#include "sort/dispatches.hpp"
#include "sort/key_sort.hpp"

namespace rill::bench {
namespace sort_suite {
namespace {

using Keys = std::vector<uint32_t>;
using Pair = std::pair<uint32_t, uint32_t>;  // key, index

/// A distribution of keys.
struct Kind {
  std::string_view name, description;
  uint64_t (*range)(uint64_t count);
  uint32_t (*key)(uint32_t index, uint32_t count, std::mt19937& random);
  bool start = false;  ///< also builds the table of first indices per key
};

uint64_t asKeys(uint64_t count) { return count; }
uint32_t below(uint64_t range, std::mt19937& random) {
  return std::uniform_int_distribution<uint32_t>(0, static_cast<uint32_t>(range - 1))(random);
}

constexpr Kind kKinds[] = {
    {"random", "uniform random, range = number of keys", asKeys,
     [](uint32_t, uint32_t count, std::mt19937& random) { return below(count, random); }},
    {"cells", "uniform random, range = 4 x number of keys, with the table of starts, as in the fluid's grid",
     [](uint64_t count) { return 4 * count; },
     [](uint32_t, uint32_t count, std::mt19937& random) { return below(uint64_t{4} * count, random); }, true},
    {"sorted", "sorted, distinct", asKeys, [](uint32_t index, uint32_t, std::mt19937&) { return index; }},
    {"reversed", "reversed, distinct", asKeys, [](uint32_t index, uint32_t count, std::mt19937&) { return count - 1 - index; }},
    {"few", "uniform random of 16 values, range = 16", [](uint64_t) { return uint64_t{16}; },
     [](uint32_t, uint32_t, std::mt19937& random) { return below(16, random); }},
    {"hidden-few", "uniform random of 16 values, range = number of keys", asKeys,
     [](uint32_t, uint32_t count, std::mt19937& random) { return below(16, random) * (count / 16); }},
    {"equal", "all equal, range = number of keys", asKeys, [](uint32_t, uint32_t count, std::mt19937&) { return count / 2; }},
    {"many", "uniform random, range = 2^32", [](uint64_t) { return KeySortDesc::kMaxKeyRange; },
     [](uint32_t, uint32_t, std::mt19937& random) { return uint32_t(random()); }},
};

/// Samples of one sort, or the reason why there are none.
struct Samples {
  std::vector<double> run_ms, total_ms;
  std::string skipReason;
  double medianMs() const { return median(run_ms); }
};

template <class Work>
Samples timedOnHost(uint32_t repeat, const std::vector<Pair>& pairs, std::vector<Pair>& sorted, Work&& work) {
  Samples samples;
  for (uint32_t k = 0; k <= repeat; ++k) {
    sorted = pairs;
    const auto begin = std::chrono::steady_clock::now();
    work(sorted);
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (k > 0) samples.run_ms.push_back(ms);  // the first run warms the caches
  }
  samples.total_ms = samples.run_ms;
  return samples;
}

/// Times one method on the device and compares its result with `expected`.
Expected<Samples> timedOnDevice(Workbench& workbench, uint32_t repeat, const KeySortDesc& desc, const Buffer& keys,
                                const std::vector<Pair>& expected, const std::string& name, Report& report) {
  Samples samples;
  if (desc.method == SortMethod::Counting && desc.keyRange > maxStartRange(workbench.device())) {
    samples.skipReason = "key range above the limit of counting sort";
    return samples;
  }
  auto sort = KeySort::create(workbench.device(), desc);
  if (!sort) return sort.error();
  auto order = workbench.make("bench order", uint64_t{desc.count} * sizeof(uint32_t));
  if (!order) return order.error();
  Buffer start;
  if (desc.start) {
    auto made = workbench.make("bench start", paddedWords(desc.keyRange + 1) * sizeof(uint32_t));
    if (!made) return made.error();
    start = std::move(*made);
  }
  auto taken = sampleGraph(workbench, repeat, [&](Graph& graph) {
    SortTargets targets{.order = importWhole(graph, "bench order", *order), .start = {}, .keys = {}};
    if (desc.start) targets.start = importWhole(graph, "bench start", start);
    (void)sort->addTo(graph, importWhole(graph, "bench keys", keys), targets);
  });
  if (!taken) return taken.error();
  samples.run_ms = std::move(taken->run_ms);
  samples.total_ms = std::move(taken->total_ms);
  const auto result = workbench.download<uint32_t>(*order);
  if (!result) return result.error();
  size_t wrong = 0, first = expected.size();
  for (size_t slot = expected.size(); slot-- > 0;) {
    if ((*result)[slot] == expected[slot].second) continue;
    wrong += 1;
    first = slot;
  }
  if (wrong > 0)
    report.failures.push_back(name + ", " + (desc.method == SortMethod::Counting ? "counting" : "radix") + ": " + std::to_string(wrong) +
                              " entries differ from std::stable_sort: at " + std::to_string(first) + " expected " +
                              std::to_string(expected[first].second) + ", found " + std::to_string((*result)[first]));
  return samples;
}

struct SamplesOfAll {
  Samples counting, radix, std, stable;
};

/// Times the sorts of one case, on the device and of the standard library.
Expected<SamplesOfAll> timedByAll(Workbench& workbench, uint32_t repeat, const Kind& kind, KeySortDesc desc, const std::string& name,
                                  Report& report) {
  std::mt19937 random(desc.count);
  Keys keys(desc.count);
  std::vector<Pair> pairs(desc.count), sorted;
  for (uint32_t i = 0; i < desc.count; ++i) {
    keys[i] = kind.key(i, desc.count, random);
    pairs[i] = {keys[i], i};
  }
  SamplesOfAll all;
  // By key, then by index, which equals the result of a stable sort.
  all.std = timedOnHost(repeat, pairs, sorted, [](std::vector<Pair>& p) { std::sort(p.begin(), p.end()); });
  all.stable = timedOnHost(repeat, pairs, sorted, [](std::vector<Pair>& p) {
    std::stable_sort(p.begin(), p.end(), [](const Pair& a, const Pair& b) { return a.first < b.first; });
  });
  const auto uploaded = workbench.upload("bench keys", std::span<const uint32_t>(keys));
  if (!uploaded) return uploaded.error();
  for (const bool counting : {true, false}) {
    desc.method = counting ? SortMethod::Counting : SortMethod::Radix;
    auto samples = timedOnDevice(workbench, repeat, desc, *uploaded, sorted, name, report);
    if (!samples) return samples.error();
    (counting ? all.counting : all.radix) = std::move(*samples);
  }
  return all;
}

Json json(const Samples& samples) {
  if (!samples.skipReason.empty()) return {{"skipped", samples.skipReason}};
  return {{"ms", sampleStatistics(samples.run_ms)}, {"with_everything_ms", sampleStatistics(samples.total_ms)}};
}

/// Short runs are sampled more often: they are cheap, and other load disturbs them more.
uint32_t samplesOf(const Bench& bench, uint32_t count) {
  return count <= 100'000 ? std::max(5u, bench.options().repeat) : bench.options().repeat;
}

std::string cell(const Samples& samples) {
  const double ms = samples.medianMs();  // NaN if skipped
  return number(ms, ms >= 1000 ? 4 : 3);
}

Expected<Report> runAll(Bench& bench) {
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  const std::vector<uint32_t> counts =
      bench.quick() ? std::vector<uint32_t>{1000, 10'000, 100'000} : std::vector<uint32_t>{1000, 10'000, 100'000, 1'000'000, 4'000'000};
  const auto nameOf = [](const Kind& kind, uint32_t count) { return std::string(kind.name) + "-" + countName(count); };
  const auto partsOf = [](uint32_t count) { return 1 + count / 10'000; };
  size_t parts = 0;
  for (const Kind& kind : kKinds)
    for (const uint32_t count : counts) parts += bench.selected(nameOf(kind, count)) ? partsOf(count) : 0;
  bench.plan(parts, "part");

  Report report;
  Table table;
  table.title = "Sorting pairs of a 32-bit key and an index, ms (medians)";
  table.columns = {"case", "counting", "radix", "std::sort", "std::stable_sort", "Auto", "Auto / best", "Auto / std"};
  table.note =
      "Auto: method that SortMethod::Auto chooses. Auto / best: its time divided by the faster of the two methods; Auto / std: by the\n"
      "faster of the standard library's sorts on one thread. -: not supported, the counters of a counting sort of this key range do not "
      "fit into a buffer of the device.";
  for (const Kind& kind : kKinds) table.note += "\n" + std::string(kind.name) + ": " + std::string(kind.description);

  for (const Kind& kind : kKinds) {
    Plot plot;
    plot.title = "Sort: " + std::string(kind.name);
    plot.x = "keys";
    plot.y = "ns per key";
    plot.logX = plot.logY = true;
    for (const char* series : {"counting", "radix", "std::sort", "std::stable_sort"})
      plot.series.push_back({series, Series::Style::Both, {}, {}});
    for (const uint32_t count : counts) {
      const std::string name = nameOf(kind, count);
      if (!bench.selected(name)) continue;
      if (bench.stopped()) break;
      bench.step(name, partsOf(count));
      const KeySortDesc desc{.count = count, .keyRange = kind.range(count), .start = kind.start};
      const bool autoCounts = chooseSortMethod(desc) == SortMethod::Counting;
      const auto timed = timedByAll(*workbench, samplesOf(bench, count), kind, desc, name, report);
      if (!timed) return timed.error();
      const auto& [byCounting, byRadix, byStd, byStable] = *timed;
      const double chosen = (autoCounts ? byCounting : byRadix).medianMs();
      const double best = byCounting.skipReason.empty() ? std::min(byCounting.medianMs(), byRadix.medianMs()) : byRadix.medianMs();
      const double host = std::min(byStd.medianMs(), byStable.medianMs());
      table.rows.push_back({name, cell(byCounting), cell(byRadix), cell(byStd), cell(byStable), autoCounts ? "counting" : "radix",
                            number(chosen / best), number(chosen / host)});
      report.results.push_back({{"case", name},
                                {"keys", count},
                                {"key_range", desc.keyRange},
                                {"counting", json(byCounting)},
                                {"radix", json(byRadix)},
                                {"std_sort", json(byStd)},
                                {"std_stable_sort", json(byStable)},
                                {"auto", autoCounts ? "counting" : "radix"},
                                {"auto_over_best", chosen / best},
                                {"auto_over_std", chosen / host}});
      const Samples* const all[] = {&byCounting, &byRadix, &byStd, &byStable};
      for (size_t s = 0; s < std::size(all); ++s)
        if (all[s]->skipReason.empty()) plot.series[s].points.emplace_back(count, 1e6 * all[s]->medianMs() / count);
    }
    if (!plot.series[2].points.empty()) report.plots.push_back(std::move(plot));
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace
}  // namespace sort_suite

Expected<Report> runSort(Bench& bench) { return sort_suite::runAll(bench); }

}  // namespace rill::bench
