#pragma once
// When the next snapshot for a loss of the device is due: so rarely that snapshots take a hundredth of the time.
#include <algorithm>
#include <chrono>

#include "view/session.hpp"

namespace rill::view {

class SnapshotTimer {
 public:
  /// `now_s`: real time.
  bool due(double now_s) const { return now_s >= dueAt_s_; }
  /// Takes a snapshot where the session is between two steps.
  Expected<void> take(Session& session, double now_s) {
    if (!session.runner().betweenSteps()) return {};
    const auto begin = std::chrono::steady_clock::now();
    auto kept = session.keep(kMaxParticles);
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    dueAt_s_ = now_s + std::max(kInterval, took_s / kShare);
    return kept;
  }

 private:
  static constexpr double kInterval = 2, kShare = 0.01;  // s
  static constexpr uint32_t kMaxParticles = 2'000'000;   // some 400 MiB of host memory

  double dueAt_s_ = 0;
};

}  // namespace rill::view
