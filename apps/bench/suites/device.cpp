// A report of one device for an issue: limits and chosen variants, checks, times.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/device/device_speed.hpp"
#include "bench/device/self_check.hpp"
#include "bench/device/simulation_times.hpp"
#include "bench/device/viewer_rate.hpp"
#include "bench/suites/count_name.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/tank.hpp"
#include "core/words.hpp"
#include "gpu/device_impl.hpp"
#include "gpu/subgroups.hpp"
#include "gpu/vulkan_error.hpp"
#include "offline/painter.hpp"
#include "shared/fluid_records.h"

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

std::string sizeText(const std::pair<uint32_t, uint32_t>& size) { return std::to_string(size.first) + "x" + std::to_string(size.second); }

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
    const DeviceImpl& device = implOf(workbench->device());
    const DeviceInfo& info = device.info;
    const ClusterChoice cluster = chooseCluster(info, device.canSetSubgroupSize, device.vendor, kFluidGroup);
    const VkPhysicalDeviceLimits& limits = device.limits;
    availableBytes_ = workbench->device().availableBytes();
    Table table{"Device, limits and chosen variants", {"what", "value"}, {}, ""};
    const auto add = [&](const char* what, std::string value) { table.rows.push_back({what, std::move(value)}); };
    add("device", info.name);
    add("driver", info.driver);
    add("Vulkan", info.api);
    add("device memory", bytesText(info.deviceLocalBytes) + ", available " + bytesText(availableBytes_));
    add("largest buffer", bytesText(info.maxBufferBytes) + " (" + std::string(info.maxBufferName) + ")");
    add("texels of a buffer", grouped(info.maxTexelBufferElements));
    add("workgroup",
        grouped(limits.maxComputeWorkGroupInvocations) + " invocations, " + bytesText(limits.maxComputeSharedMemorySize) + " shared");
    add("timestamps", device.timestampMask ? number(limits.timestampPeriod) + " ns" : "none");
    add("subgroups", std::to_string(info.subgroupSize) + ", from " + std::to_string(info.minSubgroupSize) + " to " +
                         std::to_string(info.maxSubgroupSize) + (device.canSetSubgroupSize ? ", can be required" : ", cannot be required"));
    add("subgroup size required", cluster.need.size ? std::to_string(cluster.need.size) : "none");
    add("particles a cluster", std::to_string(cluster.cluster));
    add("arrays are read through",
        std::string(info.texelReads ? "uniform texel buffers: " : "storage buffers: ") + std::string(info.readsBecause));
    add("passes", device.isCpu ? "separate (CPU)" : "merged (not a CPU)");
    name_ = info.name;
    summarize("device", info.name + ", " + info.driver + ", Vulkan " + info.api);
    summarize("variants", "clusters of " + std::to_string(cluster.cluster) + ", subgroups of " +
                              (cluster.need.size ? std::to_string(cluster.need.size)
                                                 : std::to_string(info.minSubgroupSize) + " to " + std::to_string(info.maxSubgroupSize)) +
                              ", " + (info.texelReads ? "texel buffers" : "storage buffers"));
    if (selected("device"))
      report_.results.push_back({{"case", "device"},
                                 {"cluster", cluster.cluster},
                                 {"required_subgroup_size", cluster.need.size},
                                 {"texel_reads", info.texelReads},
                                 {"available_bytes", availableBytes_}});
    report_.tables.push_back(std::move(table));
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
      const Clock::time_point begin = Clock::now();
      Options options = bench_.options();
      options.quiet = true;
      options.quick = false;
      options.only = "cells-" + countName(count);
      Bench one(options);
      auto sorted = runSort(one);
      if (!sorted) return sorted.error();
      last_s = std::chrono::duration<double>(Clock::now() - begin).count();
      report_.failures.insert(report_.failures.end(), sorted->failures.begin(), sorted->failures.end());
      if (sorted->results.empty()) continue;
      const Json& result = sorted->results.front();
      const auto rate = [&](const char* method) {
        return result[method].contains("ms") ? count / (1e3 * result[method]["ms"]["median"].get<double>()) : std::nan("");
      };
      table.rows.push_back({grouped(count), number(rate("counting")), number(rate("radix")), number(rate("std_sort")), ""});
      summarize("sort of " + grouped(count) + " keys", number(rate("counting")) + " M keys/s; std::sort " + number(rate("std_sort")));
      report_.results.push_back(
          {{"case", "sort-" + countName(count)}, {"counting_Mkeys", rate("counting")}, {"radix_Mkeys", rate("radix")}});
    }
    if (!table.rows.empty()) report_.tables.push_back(std::move(table));
    return {};
  }

  Expected<void> draw() {
    Table table{
        "A picture of 50,000 particles, ms", {"size", "surface and look", "frames", "left out"}, {}, "Without the copy to the host."};
    const double end = std::min(elapsed() + kShareOfPictures * bench_.options().budget_s, bench_.options().budget_s);
    auto workbench = Workbench::open(bench_);
    if (!workbench) return workbench.error();
    const auto scene = tank(50'000);
    if (!scene) return scene.error();
    const auto start = makeParticles(*scene);
    if (!start) return start.error();
    auto fluid = Fluid::create(workbench->device(), {.scene = &*scene, .particles = &*start});
    if (!fluid) return fluid.error();
    if (auto advanced = advanceFluid(*workbench, *fluid, 2.0 / 60); !advanced) return advanced.error();
    workbench->timePasses(true);
    offline::Painter painter(*scene, *start);
    for (const auto& [width, height] : kSizes) {
      if (bench_.stopped()) break;
      const std::string size = sizeText({width, height});
      if (!selected("picture-" + size)) continue;
      bench_.step("picture of " + size);
      if (elapsed() >= end) {
        table.rows.push_back({size, "-", "0", "no time left"});
        continue;
      }
      if (auto ready = painter.prepare(workbench->device(), "final", width, height); !ready) return ready.error();
      std::vector<double> ms;
      for (int frame = 0; frame <= 20 && (frame < 3 || elapsed() < end) && !bench_.stopped(); ++frame) {  // the first compiles shaders
        const auto drawn =
            workbench->run([&](Graph& graph) { (void)painter.declare(graph, fluid->present(graph), "final", width, height, 0); });
        if (!drawn) return drawn.error();
        double sum = 0;
        for (const Timing& pass : workbench->passTimes())
          if (!pass.name.starts_with("readback")) sum += pass.ms;
        if (frame > 0) ms.push_back(sum > 0 ? sum : drawn->run_ms);
      }
      table.rows.push_back({size, milliseconds(median(ms)), std::to_string(ms.size()), ""});
      summarize("picture, " + size, milliseconds(median(ms)) + " ms");
      report_.results.push_back({{"case", "picture-" + size}, {"ms", sampleStatistics(ms)}});
    }
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
