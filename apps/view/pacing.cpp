#include "view/pacing.hpp"

#include <algorithm>

namespace rill::view {

uint32_t Pacing::next(double budget_s) const {
  if (!(cost_ > 0)) return block_;  // the first says what one costs
  const double fits = std::clamp(budget_s / cost_, 0.0, 1e6);
  const uint32_t affordable = std::max(static_cast<uint32_t>(fits) / block_ * block_, block_);
  // Substeps that are not due cost empty dispatches: the pieces of the first step double, a step that needs more than the one
  // before another block.
  const uint32_t needed = expected_ == 0 ? wholeBlocks(done_ + 1) : expected_ > done_ ? wholeBlocks(expected_ - done_) : block_;
  return std::min(affordable, needed);
}

void Pacing::ran(uint32_t recorded, uint32_t due, double seconds) {
  done_ += due;
  if (due == 0) return;  // tells nothing of what a substep costs
  const double cost = seconds / std::min(due, recorded);
  // Up at once, down slowly: shaders are compiled at their first use, other programs come and go.
  cost_ = cost_ > 0 && cost < cost_ ? 0.7 * cost_ + 0.3 * cost : cost_ > 0 ? std::min(cost, 4 * cost_) : cost;
}

void Pacing::finished(uint32_t substeps) {
  expected_ = substeps;
  done_ = 0;
}

namespace {

constexpr double kTooLong = 0.060, kQuick = 0.030;  // s
constexpr double kWorth = 0.8;                      // of the time that a coarser picture may take at most
constexpr uint32_t kPatience = 20;                  // pictures, before it gets finer again
constexpr uint32_t kMemory = 100;                   // pictures, after which other levels are tried anew

}  // namespace

void PictureScale::go(size_t level) {
  level_ = level;
  calm_ = 0;
  ignored_ = 1;
}

void PictureScale::drew(double seconds) {
  if (ignored_ > 0) {
    --ignored_;
    return;
  }
  double& took = took_s_[level_];
  if (++age_ == kMemory) took_s_ = {}, age_ = 0;
  took = took > 0 ? 0.5 * (took + seconds) : seconds;
  const bool first = level_ == 0, last = level_ + 1 == kScales.size();
  if (!first && took_s_[level_ - 1] > 0 && took > kWorth * took_s_[level_ - 1]) return go(level_ - 1);  // it brought nothing
  if (!last && took > kTooLong && took_s_[level_ + 1] <= kWorth * took) return go(level_ + 1);
  if (first) return;
  const double finer = kScales[level_ - 1] / kScales[level_];
  calm_ = took * finer * finer < kQuick ? calm_ + 1 : 0;
  if (calm_ >= kPatience) {
    took_s_[level_ - 1] = 0;
    go(level_ - 1);
  }
}

}  // namespace rill::view
