#pragma once
// Checks that a user can run on a card without a source tree: results of the device against the host's.
#include <string>
#include <vector>

#include "bench/bench.hpp"

namespace rill::bench {

struct CheckResult {
  std::string name;
  bool passed = false;
  std::string found;     ///< what was measured
  std::string expected;  ///< and what it had to be
};

/// Names of the checks, in the order in which they run.
std::vector<std::string> selfCheckNames();
/// Runs one. An error is one of the run, not a failed check.
Expected<CheckResult> selfCheck(const Bench& bench, const std::string& name);

}  // namespace rill::bench
