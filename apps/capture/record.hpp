#pragma once
#include <string>
#include <utility>
#include <vector>

#include "capture/requirement.hpp"
#include "rill/offline.hpp"
#include "shared/run_figures.hpp"

namespace rill::capture {

/// What a capture has measured so far: the object that --stats writes, the figures that --require judges, the passes that --explain lists.
class Record {
 public:
  /// `command` is the command line, as one would type it again; `start_s` the simulated time at which this run began.
  Record(const Scene& scene, const DeviceInfo& device, std::string command, double start_s = 0);

  /// Frames in order; `time_s` is the frame's instant.
  void add(double time_s, offline::Stats stats);
  size_t frames() const { return frames_.size(); }

  /// Names of all figures of a scene, known before anything runs.
  static std::vector<std::string> figureNames(const Scene& scene);
  /// In the order of figureNames(). Figures of the density error leave out the first tenth of the frames.
  std::vector<Figure> figures() const;

  /// What the run left out: time, loops at their bound, particles, parts of pictures. A line each.
  std::vector<std::string> warnings() const;

  /// One JSON object, ended by a line feed; what is not finite is null.
  std::string json() const;

  /// A table of passes: how often each was recorded and ran, and milliseconds over all frames, or why a pass was skipped.
  std::string passTable() const;

 private:
  double droppedSeconds() const;    ///< of this run
  double simulatedSeconds() const;  ///< likewise, without those
  uint64_t pictureBoundHits() const;

  const Scene* scene_;
  DeviceInfo device_;
  std::string command_;
  double start_s_;
  std::vector<apps::Instant> frames_;
};

/// What is said where pictures lost something to a bound.
std::string boundHitsWarning(uint64_t hits);

}  // namespace rill::capture
