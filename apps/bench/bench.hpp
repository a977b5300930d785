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

/// The context of a suite: its options, and progress on standard error.
class Bench {
 public:
  explicit Bench(const Options& options);

  const Options& options() const { return options_; }
  bool quick() const { return options_.quick; }
  /// Whether --only selects this case.
  bool selected(std::string_view name) const { return options_.only.empty() || name.find(options_.only) != std::string_view::npos; }

  /// Sets the number of steps; call step() at the beginning of each. Progress estimates the time left from them.
  /// Where steps differ much in length, count parts: a step has `parts` in proportion to its expected time.
  void plan(size_t steps, std::string_view unit = "case");
  void step(const std::string& label, size_t parts = 1);
  void finish();
  /// Whether a signal has been received; the suite then returns the results so far.
  bool stopped() const;

 private:
  const Options& options_;
  apps::Progress progress_;
  std::string unit_ = "case";
  uint32_t done_ = 0, total_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

/// Whether the error is a limit of the device or host, which is reported as a result instead of a failure.
inline bool isLimit(const Error& error) { return error.kind == ErrorKind::TooLarge || error.kind == ErrorKind::OutOfMemory; }

/// The options of every simulation of a suite: the device of --device and the pipeline cache of the user.
offline::Options simulationOptions(const Bench& bench);

/// A scene to run, and what to measure.
struct SceneRun {
  Scene scene;
  std::optional<ParticleSet> start = {};  ///< replaces the scene's fills
  double duration_s = 0;
  double frame_s = 1.0 / 60;  ///< interval between measurements
  bool passTimes = false;
  bool validation = false;                                                ///< enables the validation layer; NoDevice if it is not installed
  std::function<void(offline::Simulation&, double time_s)> onFrame = {};  ///< called at every measurement, including t = 0
};

struct RunFigures {
  std::vector<apps::Instant> instants;
  apps::DensityFigures density;
  apps::EnergyFigures energy;
  double simulated_s = 0;
  double wall_s = 0;   ///< simulation only
  double total_s = 0;  ///< including device creation, measurement and onFrame
  uint64_t particles = 0, substeps = 0, iterations = 0, listBuilds = 0, outside = 0, nonFinite = 0;
  double timeDropped_s = 0;
  DeviceInfo device;
  std::vector<offline::PassTime> passes;  ///< sums over the run
  std::vector<std::string> messages;      ///< of the validation layer, if enabled
};

/// Runs a scene on its own device until the end or a signal.
Expected<RunFigures> runScene(const Bench& bench, const SceneRun& run);

/// Loads a scene of assets/scenes with overrides.
Expected<Scene> namedScene(const std::string& name, const std::vector<Override>& overrides = {});

/// The figures that every suite reports for a run.
Json runJson(const RunFigures& run);

struct Suite {
  std::string_view name, description;
  Expected<Report> (*run)(Bench&);
};
/// All suites.
std::span<const Suite> suites();

/// Runs the suite and writes the requested outputs. Returns the exit code of the program.
int runBench(const Options& options);

}  // namespace rill::bench
