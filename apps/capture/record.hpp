#pragma once
#include <string>
#include <utility>
#include <vector>

#include "capture/requirement.hpp"
#include "rill/offline.hpp"
#include "shared/run_figures.hpp"

namespace rill::capture {

/// The measurements of a capture: for the JSON of --stats, the figures of --require and the passes of --explain.
class Record {
 public:
  /// `command`: the command line, quoted for a shell; `start_s`: simulated time at the start of this run.
  Record(const Scene& scene, const DeviceInfo& device, std::string command, double start_s = 0);

  /// Adds the next frame, at the simulated time `time_s`.
  void add(double time_s, offline::Stats stats);
  size_t frames() const { return frames_.size(); }

  /// Names of all figures of a scene; does not need a run.
  static std::vector<std::string> figureNames(const Scene& scene);
  /// In the order of figureNames(). Figures of the density error exclude the first tenth of the frames.
  std::vector<Figure> figures() const;

  /// One line each for dropped time, loops that reached their limit, inactive particles and incomplete images.
  std::vector<std::string> warnings() const;

  /// One JSON object and a line feed; numbers that are not finite are null.
  std::string json() const;

  /// A table of passes: how often recorded and run, milliseconds over all frames, or the reason why skipped.
  std::string passTable() const;
  /// How many particles sleep at the end; empty unless the scene asks for sleep.
  std::string sleepText() const;

 private:
  double droppedSeconds() const;    ///< of this run
  double simulatedSeconds() const;  ///< of this run, without dropped time
  uint64_t pictureBoundHits() const;

  const Scene* scene_;
  DeviceInfo device_;
  std::string command_;
  double start_s_;
  std::vector<apps::Instant> frames_;
};

/// The warning about images that are incomplete because loops reached their limit.
std::string boundHitsWarning(uint64_t hits);

}  // namespace rill::capture
