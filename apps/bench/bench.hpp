#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "bench/options.hpp"
#include "bench/report.hpp"
#include "rill/offline.hpp"
#include "shared/progress.hpp"
#include "shared/run_figures.hpp"

namespace rill::bench {

/// What a suite works with: the options, progress on standard error, scenes run to their figures.
class Bench {
 public:
  explicit Bench(const Options& options);

  const Options& options() const { return options_; }
  bool quick() const { return options_.quick; }
  /// Whether a case is asked for (--only).
  bool wanted(std::string_view name) const { return options_.only.empty() || name.find(options_.only) != std::string_view::npos; }

  /// How many steps there will be; then each step when it begins, and so that progress can say how long the rest takes.
  /// Where steps are far from equally long, they are counted in parts, each step as many as it takes time.
  void plan(size_t steps, std::string_view unit = "case");
  void step(const std::string& about, size_t parts = 1);
  void finished();
  /// A signal came: the suite returns what it has.
  bool stopped() const;

 private:
  const Options& options_;
  apps::Progress progress_;
  std::string unit_ = "case";
  uint32_t done_ = 0, total_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

/// What is run, and how it is looked at.
struct SceneRun {
  Scene scene;
  std::optional<ParticleSet> start = {};  ///< in place of the scene's fills
  double duration_s = 0;
  double frame_s = 1.0 / 60;  ///< figures are measured at its multiples
  bool passTimes = false;
  bool validation = false;                                             ///< with the validation layer; NoDevice where it is not installed
  std::function<void(offline::Simulation&, double time_s)> look = {};  ///< called at each instant, the start too
};

struct RunFigures {
  std::vector<apps::Instant> instants;
  apps::DensityFigures density;
  apps::EnergyFigures energy;
  double simulated_s = 0;
  double wall_s = 0;   ///< of the simulation alone
  double total_s = 0;  ///< with opening the device, measuring and looking
  uint64_t particles = 0, substeps = 0, iterations = 0, list_builds = 0, outside = 0, non_finite = 0;
  double time_dropped_s = 0;
  DeviceInfo device;
  std::vector<offline::PassTime> passes;  ///< added up
  std::vector<std::string> messages;      ///< of the validation layer, where it was asked for
};

/// Runs a scene on a device of its own, until its end or a signal.
Expected<RunFigures> runScene(const Bench& bench, const SceneRun& run);

/// A scene of assets/scenes, with keys changed.
Expected<Scene> namedScene(const std::string& name, const std::vector<Override>& overrides = {});

/// The figures that every suite reports of a run.
Json runJson(const RunFigures& run);

/// One suite.
struct Suite {
  std::string_view name, about;
  Expected<Report> (*run)(Bench&);
};
/// All there are.
std::span<const Suite> suites();

/// Runs the suite and writes what was asked for; the program's exit code.
int runBench(const Options& options);

}  // namespace rill::bench
