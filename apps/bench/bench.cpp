#include "bench/bench.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <thread>

#include "bench/plot.hpp"
#include "core/words.hpp"
#include "rill/version.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/scene_folders.hpp"
#include "shared/signals.hpp"

namespace rill::bench {
namespace {

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

void message(const std::string& text) { std::fprintf(stderr, "rill-bench: %s\n", text.c_str()); }

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string name = "unknown processor", line;
  while (std::getline(file, line))
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      name = line.substr(line.find(": ") + 2);
      break;
    }
  return name + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::string platform() {
  utsname system{};
  return ::uname(&system) == 0 ? std::string(system.sysname) + " " + system.machine : "unknown";
}

/// The file of --report.
std::string markdown(const Options& options, const DeviceInfo& device, const Report& report) {
  std::string text = "# rill-bench " + options.suite + ": " + device.name + "\n\nRill " RILL_VERSION ", " + device.driver + ", Vulkan " +
                     device.api + ", " + processor() + ", " + platform() + ". `" + options.command + "`\n";
  if (apps::signalReceived() != 0) text += "\nStopped by a signal: the rest is missing.\n";
  for (const std::string& failure : report.failures) text += "\nFAILED " + failure + "\n";
  for (const Table& table : report.tables) text += "\n" + tableMarkdown(table);
  return text;
}

Expected<DeviceInfo> deviceInfo(const Bench& bench) {
  Scene empty;
  empty.fluid.spacing = 1;
  auto simulation = offline::Simulation::open(empty, simulationOptions(bench));
  if (!simulation) return simulation.error();
  return simulation->device();
}

}  // namespace

Bench::Bench(const Options& options)
    : options_(options),
      progress_(options.quiet ? apps::Progress::Style::Quiet : apps::Progress::styleForTerminal()),
      begin_(Clock::now()) {}

void Bench::plan(size_t steps, std::string_view unit) {
  unit_ = unit;
  total_ = static_cast<uint32_t>(steps);
  done_ = 0;
  begin_ = Clock::now();
}

void Bench::step(const std::string& label, size_t parts) {
  progress_.show({unit_, done_, total_, label, secondsSince(begin_)});
  done_ = static_cast<uint32_t>(std::min<size_t>(total_, done_ + parts));
}

void Bench::finish() {
  if (total_ > 0) progress_.show({unit_, total_, total_, "", secondsSince(begin_)});
  progress_.clear();
}

bool Bench::stopped() const { return apps::signalReceived() != 0; }

offline::Options simulationOptions(const Bench& bench) {
  offline::Options options;
  options.device = bench.options().device.name;
  options.deviceOrigin = bench.options().device.origin;
  options.pipelineCache = apps::pipelineCacheFolder();
  return options;
}

Expected<Scene> namedScene(const std::string& name, const std::vector<Override>& overrides) {
  const auto file = apps::SceneFolders::standard().find(name);
  if (!file) return file.error();
  return loadScene(*file, overrides);
}

Expected<RunFigures> runScene(const Bench& bench, const SceneRun& run) {
  const Clock::time_point begin = Clock::now();
  offline::Options settings = simulationOptions(bench);
  settings.passTimes = run.passTimes;
  settings.validation = run.validation;
  auto opened = run.start ? offline::Simulation::open(run.scene, *run.start, settings) : offline::Simulation::open(run.scene, settings);
  if (!opened) return opened.error();
  offline::Simulation& simulation = *opened;
  RunFigures figures;
  figures.device = simulation.device();
  const auto frames = static_cast<uint64_t>(run.duration_s / run.frame_s + 1e-6);
  for (uint64_t k = 0; k <= frames && !bench.stopped(); ++k) {
    if (k > 0)
      if (auto advanced = simulation.advance(run.frame_s); !advanced) return advanced.error();
    auto stats = simulation.stats();
    if (!stats) return stats.error();
    const double time = double(k) * run.frame_s;
    if (run.onFrame) run.onFrame(simulation, time);
    figures.substeps += stats->substeps;
    figures.iterations += stats->iterations;
    figures.listBuilds += stats->listBuilds;
    figures.timeDropped_s += stats->timeDropped_s;
    figures.outside = std::max(figures.outside, stats->outside);
    figures.nonFinite = std::max(figures.nonFinite, stats->nonFinite);
    figures.particles = stats->particles;
    for (const offline::PassTime& pass : stats->passes) {
      auto found = std::ranges::find(figures.passes, pass.name, &offline::PassTime::name);
      if (found == figures.passes.end()) found = figures.passes.insert(figures.passes.end(), {pass.name});
      found->ms += pass.ms;
      found->recorded += pass.recorded;
      found->executed += pass.executed;
    }
    figures.instants.push_back({time, std::move(*stats)});
    figures.simulated_s = time;
  }
  figures.density = apps::densityFigures(figures.instants);
  figures.energy = apps::energyFigures(simulation.scene(), figures.instants);
  figures.wall_s = apps::wallSeconds(figures.instants);
  figures.total_s = secondsSince(begin);
  figures.messages = simulation.takeValidationMessages();
  return figures;
}

Json runJson(const RunFigures& run) {
  Json json;
  json["particles"] = run.particles;
  json["simulated_s"] = run.simulated_s;
  json["wall_s"] = run.wall_s;
  json["total_s"] = run.total_s;
  json["substeps"] = run.substeps;
  json["iterations"] = run.iterations;
  json["list_builds"] = run.listBuilds;
  json["time_dropped_s"] = run.timeDropped_s;
  json["density_error"] = {
      {"mean", run.density.mean}, {"p99", run.density.p99}, {"max", run.density.max}, {"signed_median", run.density.signed_median}};
  json["energy"] = {{"ratio", run.energy.ratio}, {"end_ratio", run.energy.end_ratio}};
  json["outside"] = run.outside;
  json["non_finite"] = run.nonFinite;
  return json;
}

int runBench(const Options& options) {
  const auto fail = [](const Error& error) {
    message(error.message);
    return apps::exitCodeBeforeRun(error);
  };
  const auto suite = std::ranges::find(suites(), std::string_view(options.suite), &Suite::name);
  const std::pair<const char*, const std::optional<std::filesystem::path>&> files[] = {
      {"--json", options.json}, {"--plot", options.plot}, {"--report", options.report}};
  for (const auto& [option, file] : files)
    if (file)
      if (auto writable = apps::checkFilePlace(option, *file); !writable) return fail(writable.error());
  if (options.plot)
    if (auto plotter = checkPlotter(); !plotter) return fail(plotter.error());
  Bench bench(options);
  const auto device = deviceInfo(bench);
  if (!device) return fail(device.error());
  for (const auto& [option, file] : files)  // now: the suite may take minutes
    if (file && file->has_parent_path())
      if (auto made = apps::makeFolder(option, file->parent_path()); !made) return fail(made.error());
  if (!options.quiet)
    message(options.suite + (options.quick ? ", quick" : "") + ": " + device->name + " (" + device->driver + "), " + processor());

  const Clock::time_point begin = Clock::now();
  auto report = suite->run(bench);
  bench.finish();
  if (!report) {
    message(report.error().message);
    return apps::exitCodeBeforeRun(report.error());
  }

  if (!options.only.empty() && report->results.empty() && apps::signalReceived() == 0)
    return fail(Error{ErrorKind::BadInput,
                      "--only: no case of the suite " + options.suite + " has a name that contains " + inQuotes(options.only)});

  std::string text;
  for (const Table& table : report->tables) text += tableText(table) + "\n";
  for (const std::string& failure : report->failures) text += "FAILED " + failure + "\n";
  const auto onStdout = [](const auto& file) { return file && apps::isStandardOutput(*file); };
  const bool textOnStderr = onStdout(options.json) || onStdout(options.report);
  if (!options.quiet || !report->failures.empty())
    if (auto written = apps::writeAll(textOnStderr ? STDERR_FILENO : STDOUT_FILENO, "standard output", text); !written) {
      message(written.error().message);
      return apps::kFailed;
    }
  if (options.json) {
    Json json;
    json["rill"] = RILL_VERSION;
    json["suite"] = options.suite;
    json["command"] = options.command;
    json["quick"] = options.quick;
    json["device"] = {{"name", device->name}, {"driver", device->driver}, {"api", device->api}, {"subgroup_size", device->subgroupSize}};
    json["processor"] = processor();
    json["system"] = platform();
    json["took_s"] = secondsSince(begin);
    json["failures"] = report->failures;
    json["results"] = report->results;
    if (auto written = apps::writeFile(*options.json, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"); !written) {
      message(written.error().message);
      return apps::kFailed;
    }
  }
  if (options.report)
    if (auto written = apps::writeFile(*options.report, markdown(options, *device, *report)); !written) {
      message(written.error().message);
      return apps::kFailed;
    }
  if (options.plot && !report->plots.empty())
    if (auto drawn = writePlots(*options.plot, report->plots); !drawn) {
      message(drawn.error().message);
      return apps::kFailed;
    }
  if (options.plot && report->plots.empty() && !options.quiet)
    message("--plot: the suite " + options.suite + " has no diagrams; no file was written");
  if (const int signal = apps::signalReceived()) return 128 + signal;
  return report->failures.empty() ? apps::kDone : apps::kRequireFailed;
}

}  // namespace rill::bench
