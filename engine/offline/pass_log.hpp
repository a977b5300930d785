#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/offline.hpp"

namespace rill::offline {

/// Adds up what the graphs of one instant report of their passes.
class PassLog {
 public:
  void clear() { entries_.clear(); }
  /// Of a graph that was compiled; `submitted`: its passes have run.
  void add(std::span<const PassReport> report, bool submitted);
  /// Of that graph, once it has completed.
  void add(std::span<const Timing> timings);
  /// Of a fluid in that graph, likewise: what was empty.
  void add(std::span<const FluidPassRuns> passes, std::span<const PassReport> report);

  std::vector<PassTime> times() const;       ///< passes that ran, in the order met
  std::vector<SkippedPass> skipped() const;  ///< passes that never ran

 private:
  struct Entry {
    std::string name;
    double ms = 0;
    uint32_t runs = 0, ran = 0;
    std::string reason;
  };
  Entry& entry(std::string_view name);
  std::vector<Entry> entries_;
};

}  // namespace rill::offline
