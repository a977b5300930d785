// A report of one device for an issue: limits and chosen variants, checks, times.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/device/description.hpp"
#include "bench/device/device_speed.hpp"
#include "bench/device/picture_times.hpp"
#include "bench/device/self_check.hpp"
#include "bench/device/simulation_times.hpp"
#include "bench/device/sort_rates.hpp"
#include "bench/device/viewer_rate.hpp"
#include "bench/suites/count_name.hpp"
#include "bench/suites/suites.hpp"
#include "core/words.hpp"

namespace rill::bench {
namespace device_suite {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kCounts[] = {50'000, 200'000, 1'000'000, 4'000'000};
constexpr uint32_t kSortCounts[] = {100'000, 1'000'000, 4'000'000};
constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{1920, 1080}, {3840, 2160}};
constexpr double kShareOfSimulation = 0.6, kShareOfSorts = 0.1,
                 kShareOfPictures = 0.15;  // of the whole time; the rest is for what comes first
constexpr double kViewer_s = 20;

/// Without an exponent.
std::string milliseconds(double ms) { return number(ms, ms >= 1000 ? std::max(3, int(std::log10(ms)) + 1) : 3); }

/// The suite, section by section. Each ends within its time, or says what it left out.
class DeviceReport {
 public:
  explicit DeviceReport(Bench& bench) : bench_(bench) {}

  Expected<Report> run() {
    bench_.plan(kSteps + selfCheckNames().size(), "step");
    // A part that fails is a finding of the report, which goes on while the device is there.
    for (const auto part : {&DeviceReport::describe, &DeviceReport::check, &DeviceReport::measureSpeed, &DeviceReport::simulate,
                            &DeviceReport::sort, &DeviceReport::draw, &DeviceReport::view}) {
      if (bench_.stopped()) break;
      const auto done = (this->*part)();
      if (done) continue;
      report_.failures.push_back(done.error().message);
      summarize("error", done.error().message);
      if (done.error().kind == ErrorKind::DeviceLost) break;
    }
    report_.tables.push_back(std::move(summary_));
    return std::move(report_);
  }

 private:
  static constexpr size_t kSteps = 2 + std::size(kCounts) + std::size(kSortCounts) + std::size(kSizes) + 1;

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  double left() const { return std::max(0.0, bench_.options().budget_s - elapsed()); }
  bool selected(std::string_view name) const { return bench_.selected(name); }
  void summarize(const std::string& what, const std::string& found) { summary_.rows.push_back({what, found}); }

  Expected<void> describe() {
    auto workbench = Workbench::open(bench_);
    if (!workbench) return workbench.error();
    DeviceDescription device = describeDevice(workbench->device());
    name_ = device.name;
    availableBytes_ = device.availableBytes;
    summarize("device", device.identity);
    summarize("variants", device.variants);
    if (selected("device")) report_.results.push_back(std::move(device.result));
    report_.tables.push_back(std::move(device.table));
    return {};
  }

  Expected<void> check() {
    Table table{"Checks", {"check", "result", "found", "expected"}, {}, ""};
    size_t passed = 0;
    for (const std::string& name : selfCheckNames()) {
      if (bench_.stopped()) break;
      if (!selected(name)) continue;
      bench_.step(name);
      // An error of one check, such as a shader that the driver refuses, is a finding: the others run.
      auto result = selfCheck(bench_, name);
      if (!result && result.error().kind == ErrorKind::DeviceLost) return result.error();
      const CheckResult found = result ? *result : CheckResult{name, false, result.error().message, "no error"};
      passed += found.passed;
      table.rows.push_back({name, found.passed ? "passed" : "FAILED", found.found, found.expected});
      if (!found.passed) report_.failures.push_back(name + ": found " + found.found + ", expected " + found.expected);
      report_.results.push_back({{"case", name}, {"passed", found.passed}, {"found", found.found}, {"expected", found.expected}});
    }
    if (table.rows.empty()) return {};
    summarize("checks", std::to_string(passed) + " of " + std::to_string(table.rows.size()) + " passed");
    report_.tables.push_back(std::move(table));
    return {};
  }

  Expected<void> measureSpeed() {
    const bool simulates = std::ranges::any_of(kCounts, [&](uint32_t count) { return selected("simulation-" + countName(count)); });
    if (!selected("speed") && !simulates) return {};
    bench_.step("bandwidth and latency");
    auto workbench = Workbench::open(bench_);
    if (!workbench) return workbench.error();
    const auto speed = measureDeviceSpeed(*workbench);
    if (!speed) return speed.error();
    measured_ = speed->card(name_);
    vendors_ = cardOf(name_);
    Table table{"Bandwidth and latency",
                {"what", "measured", vendors_ ? "card in the model" : "card in the model: none of this name"},
                {},
                vendors_ ? std::string(vendors_->source) : ""};
    const auto add = [&](const char* what, double value, double of, const char* unit) {
      table.rows.push_back({what, number(value) + unit, vendors_ ? number(of) + unit : "-"});
    };
    add("copies, read and written", speed->copied_GBps, vendors_ ? kReachedBandwidth * vendors_->bandwidth_GBps : 0, " GB/s");
    add("a dispatch", speed->dispatch_us, vendors_ ? vendors_->dispatch_us : 0, " us");
    add("a barrier, in addition", speed->barrier_us, vendors_ ? vendors_->barrier_us : 0, " us");
    report_.results.push_back(
        {{"case", "speed"}, {"copied_GBps", speed->copied_GBps}, {"dispatch_us", speed->dispatch_us}, {"barrier_us", speed->barrier_us}});
    report_.tables.push_back(std::move(table));
    bench_.step("traffic");
    auto small = smallRun(bench_);
    if (!small) return small.error();
    small_ = std::move(*small);
    return {};
  }

  Expected<void> simulate() {
    Table table{
        "A dam break, ms per frame of 1/60 s",
        {"particles", "ms", "mean error", "substeps", "ns per particle and substep", "predicted, measured speed", "predicted, vendor's",
         "frames", "left out"},
        {},
        "predicted: ms by the traffic model (docs/notes/traffic.md) for the substeps of the run: from the bandwidth and latency measured\n"
        "above, and from the vendor's. It leaves out arithmetic and gathers, so a CPU is far slower than predicted.\n"
        "The error is the mean over the frames: it is small where there are few, before the fluid moves."};
    Pace pace = small_.pace;
    const double end = std::min(elapsed() + kShareOfSimulation * bench_.options().budget_s, bench_.options().budget_s);
    for (const uint32_t count : kCounts) {
      if (bench_.stopped()) break;
      const std::string name = "simulation-" + countName(count);
      if (!selected(name)) continue;
      bench_.step(grouped(count) + " particles");
      const auto times = timeSimulation(bench_, count, pace, availableBytes_, std::max(end - elapsed(), 0.0));
      if (!times) return times.error();
      if (times->frames == 0) {
        table.rows.push_back({grouped(times->particles), "-", "-", "-", "-", "-", "-", "0", times->leftOut});
        summarize(grouped(count) + " particles", "left out: " + times->leftOut);
        report_.results.push_back({{"case", name}, {"left_out", times->leftOut}});
        continue;
      }
      pace = {times->ns(), times->substeps, double(times->particles)};
      const DeviceWork work = frameWork(small_.traffic, double(times->particles), times->substeps);
      const double byMeasured = 1e3 * predictedSeconds(measured_, work);
      const double byVendor = vendors_ ? 1e3 * predictedSeconds(*vendors_, work) : std::nan("");
      table.rows.push_back({grouped(times->particles), milliseconds(times->frame_ms), percent(times->error), number(times->substeps),
                            number(times->ns()), milliseconds(byMeasured), milliseconds(byVendor), std::to_string(times->frames), ""});
      summarize(grouped(count) + " particles",
                milliseconds(times->frame_ms) + " ms a frame at " + percent(times->error) + "; predicted " + milliseconds(byMeasured));
      report_.results.push_back({{"case", name},
                                 {"particles", times->particles},
                                 {"frame_ms", times->frame_ms},
                                 {"mean_error", times->error},
                                 {"substeps", times->substeps},
                                 {"predicted_ms", byMeasured},
                                 {"frames", times->frames}});
    }
    if (!table.rows.empty()) report_.tables.push_back(std::move(table));
    return {};
  }

  Expected<void> sort() {
    Table table{"Sorts of cell keys, million keys per second", {"keys", "counting", "radix", "std::sort", "left out"}, {}, ""};
    const double end = elapsed() + kShareOfSorts * bench_.options().budget_s;
    double last_s = 0;
    for (const uint32_t count : kSortCounts) {
      if (bench_.stopped()) break;
      if (!selected("sort-" + countName(count))) continue;
      bench_.step("sort of " + grouped(count) + " keys");
      const double needed = 10 * last_s;
      if (elapsed() + needed > std::min(end, bench_.options().budget_s)) {
        table.rows.push_back({grouped(count), "-", "-", "-", "would take about " + number(needed) + " s"});
        continue;
      }
      const auto sorted = timeSorts(bench_, count);
      if (!sorted) return sorted.error();
      last_s = sorted->took_s;
      report_.failures.insert(report_.failures.end(), sorted->failures.begin(), sorted->failures.end());
      if (sorted->stopped) continue;
      table.rows.push_back({grouped(count), number(sorted->counting), number(sorted->radix), number(sorted->stdSort), ""});
      summarize("sort of " + grouped(count) + " keys", number(sorted->counting) + " M keys/s; std::sort " + number(sorted->stdSort));
      report_.results.push_back(
          {{"case", "sort-" + countName(count)}, {"counting_Mkeys", sorted->counting}, {"radix_Mkeys", sorted->radix}});
    }
    if (!table.rows.empty()) report_.tables.push_back(std::move(table));
    return {};
  }

  Expected<void> draw() {
    Table table{
        "A picture of 50,000 particles, ms", {"size", "surface and look", "frames", "left out"}, {}, "Without the copy to the host."};
    const double budget_s = std::min(kShareOfPictures * bench_.options().budget_s, left());
    const auto timed = timePictures(bench_, kSizes, budget_s, [&](const PictureTimes& picture) {
      const auto& [size, ms, leftOut] = picture;
      table.rows.push_back({size, ms.empty() ? "-" : milliseconds(median(ms)), std::to_string(ms.size()), leftOut});
      if (!leftOut.empty()) return;
      summarize("picture, " + size, milliseconds(median(ms)) + " ms");
      report_.results.push_back({{"case", "picture-" + size}, {"ms", sampleStatistics(ms)}});
    });
    if (!timed) return timed.error();
    if (!table.rows.empty()) report_.tables.push_back(std::move(table));
    return {};
  }

  Expected<void> view() {
    if (!selected("viewer")) return {};
    bench_.step("viewer");
    ViewerRate rate;
    if (left() < kViewer_s)
      rate.leftOut = "no time left";
    else
      rate = viewerRate(bench_, "dam50k", 60);
    const std::string found = rate.leftOut.empty() ? number(1e3 / rate.frame_ms) + " frames/s (median " + number(rate.frame_ms) +
                                                         " ms, 95 % within " + number(rate.frame_p95_ms) + " ms)"
                                                   : "left out: " + rate.leftOut;
    summarize("rill-view, dam50k, 1280x720", found);
    report_.results.push_back({{"case", "viewer"}, {"found", found}});
    return {};
  }

  Bench& bench_;
  Report report_;
  Table summary_{"For an issue", {"what", "found"}, {}, ""};
  const Clock::time_point begin_ = Clock::now();
  std::string name_;
  uint64_t availableBytes_ = 0;  ///< of device memory, at the start
  Card measured_;
  const Card* vendors_ = nullptr;
  SmallRun small_;
};

}  // namespace
}  // namespace device_suite

Expected<Report> runDevice(Bench& bench) { return device_suite::DeviceReport(bench).run(); }

}  // namespace rill::bench
