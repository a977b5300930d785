#include "view/clock.hpp"

#include <algorithm>
#include <cmath>

namespace rill::view {
namespace {

constexpr double kDecay = 1.0;       // s
constexpr double kMaxPending = 0.1;  // s: several steps per frame on a slow display, but no catching up on a slow machine

}  // namespace

void Clock::addRealTime(double real_s) {
  real_s = std::max(real_s, 0.0);
  pending_ = std::min(pending_ + real_s, kMaxPending);
  const double keep = std::exp(-real_s / kDecay);
  real_ = real_ * keep + real_s;
  simulated_ *= keep;
}

void Clock::endStep() { simulated_ += kStep; }

double Clock::speed() const {
  constexpr double kMinMeasured = 0.3;  // s of real time
  return real_ < kMinMeasured ? 1.0 : simulated_ / real_;
}

}  // namespace rill::view
