#pragma once
// The tables of the suite `waves`: which experiments share one, and its columns.
#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/waves.hpp"

namespace rill::bench {

/// An experiment that ran.
struct WaveResult {
  Experiment experiment;
  Outcome outcome;
  std::vector<double> wall = {};  ///< samples of settingCost()

  const Figure& figure(std::string_view name) const { return *std::ranges::find(outcome.figures, name, &Figure::name); }
  double residual() const { return outcome.curves["fit"]["residual"]; }
  double cost() const { return outcome.run.wall_s / std::max(outcome.run.simulated_s, 1e-12); }  // wall seconds per simulated second
};

/// A group of experiments that share a table. `row`: cells after the name, the number of particles and the spacing.
struct WaveGroup {
  const char* title;
  std::vector<Experiment> experiments;
  std::vector<std::string> columns;
  std::function<std::vector<std::string>(const WaveResult&, const std::vector<WaveResult>& group)> row;
  const char* note;
};

std::vector<WaveGroup> waveGroups();

}  // namespace rill::bench
