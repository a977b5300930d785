#include "view/pacing.hpp"

#include <algorithm>

namespace rill::view {

uint32_t Pacing::next(double budget_s) const {
  if (!(cost_ > 0)) return block_;  // the first piece measures the cost
  const double fits = std::clamp(budget_s / cost_, 0.0, 1e6);
  const uint32_t affordable = std::max(static_cast<uint32_t>(fits) / block_ * block_, block_);
  // Substeps that are not executed cost empty dispatches: pieces of the first step double, and a step that is longer than
  // the one before is extended block by block.
  const uint32_t needed = expected_ == 0 ? wholeBlocks(done_ + 1) : expected_ > done_ ? wholeBlocks(expected_ - done_) : block_;
  return std::min(affordable, needed);
}

void Pacing::addPiece(uint32_t recorded, uint32_t executed, double seconds) {
  done_ += executed;
  if (executed == 0) return;  // no measurement of the cost
  const double cost = seconds / std::min(executed, recorded);
  // Increases apply at once, decreases gradually: shader compilation and other programs cause outliers.
  cost_ = cost_ > 0 && cost < cost_ ? 0.7 * cost_ + 0.3 * cost : cost_ > 0 ? std::min(cost, 4 * cost_) : cost;
}

void Pacing::endStep(uint32_t substeps) {
  expected_ = substeps;
  done_ = 0;
}

namespace {

constexpr double kSlow = 0.060, kFast = 0.030;  // s
constexpr double kWorth = 0.8;                  // maximum time of a coarser image, relative to the finer one
constexpr uint32_t kFastImages = 20;            // consecutive fast images before the next finer level
constexpr uint32_t kRetryImages = 100;          // images after which all levels are tried again

}  // namespace

void PictureScale::setLevel(size_t level) {
  level_ = level;
  fastInRow_ = 0;
  ignored_ = 1;
}

void PictureScale::addImage(double seconds) {
  if (ignored_ > 0) {
    --ignored_;
    return;
  }
  double& took = took_s_[level_];
  if (++age_ == kRetryImages) took_s_ = {}, age_ = 0;
  took = took > 0 ? 0.5 * (took + seconds) : seconds;
  const bool first = level_ == 0, last = level_ + 1 == kScales.size();
  if (!first && took_s_[level_ - 1] > 0 && took > kWorth * took_s_[level_ - 1]) return setLevel(level_ - 1);  // coarser is not faster
  if (!last && took > kSlow && took_s_[level_ + 1] <= kWorth * took) return setLevel(level_ + 1);
  if (first) return;
  const double finer = kScales[level_ - 1] / kScales[level_];
  fastInRow_ = took * finer * finer < kFast ? fastInRow_ + 1 : 0;
  if (fastInRow_ >= kFastImages) {
    took_s_[level_ - 1] = 0;
    setLevel(level_ - 1);
  }
}

}  // namespace rill::view
