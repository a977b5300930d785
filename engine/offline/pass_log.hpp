#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/offline.hpp"

namespace rill::offline {

/// Whether a compiled graph has a pass to execute.
bool runsAnything(std::span<const PassReport> report);

/// Sums the pass reports of the graphs of one advance.
class PassLog {
 public:
  void clear() { entries_.clear(); }
  /// Adds a compiled graph. `submitted`: whether its passes were executed.
  void add(std::span<const PassReport> report, bool submitted);
  /// Adds the timings of that graph once it has completed.
  void add(std::span<const Timing> timings);
  /// Subtracts the passes that the device skipped for a fluid in that graph, once it has completed.
  void add(std::span<const FluidPassRuns> passes, std::span<const PassReport> report);

  std::vector<PassTime> times() const;       ///< executed passes, in order of first occurrence
  std::vector<SkippedPass> skipped() const;  ///< passes that were never executed

 private:
  struct Entry {
    std::string name;
    double ms = 0;
    uint32_t recorded = 0, executed = 0;
    std::string reason;
  };
  Entry& entry(std::string_view name);
  std::vector<Entry> entries_;
};

}  // namespace rill::offline
