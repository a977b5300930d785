#include "bench/device/sort_rates.hpp"

#include <chrono>
#include <cmath>

#include "bench/suites/count_name.hpp"
#include "bench/suites/suites.hpp"

namespace rill::bench {

Expected<SortRates> timeSorts(const Bench& bench, uint32_t count) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Options options = bench.options();
  options.quiet = true;
  options.quick = false;
  options.only = "cells-" + countName(count);
  Bench one(options);
  auto sorted = runSort(one);
  if (!sorted) return sorted.error();
  SortRates rates;
  rates.took_s = std::chrono::duration<double>(Clock::now() - begin).count();
  rates.failures = std::move(sorted->failures);
  rates.stopped = sorted->results.empty();
  if (rates.stopped) return rates;
  const Json& result = sorted->results.front();
  const auto rate = [&](const char* method) {
    return result[method].contains("ms") ? count / (1e3 * result[method]["ms"]["median"].get<double>()) : std::nan("");
  };
  rates.counting = rate("counting");
  rates.radix = rate("radix");
  rates.stdSort = rate("std_sort");
  return rates;
}

}  // namespace rill::bench
