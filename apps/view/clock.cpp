#include "view/clock.hpp"

#include <algorithm>
#include <cmath>

namespace rill::view {
namespace {

constexpr double kMemory = 1.0;   // s
constexpr double kMaxOwed = 0.1;  // s: the frames of a slow display hold several steps, what a slow machine misses is not run after

}  // namespace

void Clock::passed(double real_s) {
  real_s = std::max(real_s, 0.0);
  owed_ = std::min(owed_ + real_s, kMaxOwed);
  const double keep = std::exp(-real_s / kMemory);
  real_ = real_ * keep + real_s;
  simulated_ *= keep;
}

void Clock::finished() { simulated_ += kStep; }

double Clock::speed() const {
  constexpr double kKnown = 0.3;  // s of real time before anything is said
  return real_ < kKnown ? 1.0 : simulated_ / real_;
}

}  // namespace rill::view
