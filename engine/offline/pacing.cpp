#include "offline/pacing.hpp"

#include <algorithm>
#include <utility>

namespace rill::offline {

uint32_t Pacing::affordable(double budget_s) const {
  if (!(cost_ > 0)) return block_;  // the first piece measures the cost
  const double fits = std::clamp(budget_s / cost_, 0.0, 1e6);
  return std::max(static_cast<uint32_t>(fits) / block_ * block_, block_);
}

uint32_t Pacing::next(double budget_s) const {
  if (expected_ > recorded_) return std::min(affordable(budget_s), wholeBlocks(expected_ - recorded_));
  if (inFlight_ > 0) return 0;
  // Substeps that are not executed cost empty dispatches: pieces of the first advance double, and an advance that is longer than the
  // one before is extended block by block.
  return expected_ == 0 ? std::min(affordable(budget_s), wholeBlocks(recorded_ + 1)) : block_;
}

uint32_t Pacing::first(double budget_s) const { return std::min(affordable(budget_s), wholeBlocks(std::max(expected_, 1u))); }

void Pacing::submit(uint32_t substeps, bool ahead) {
  (ahead ? ahead_ : recorded_) += substeps;
  ++inFlight_;
}

void Pacing::addPiece(uint32_t recorded, uint32_t executed, double seconds, bool ahead) {
  inFlight_ -= std::min(inFlight_, 1u);
  if (ahead) {
    ahead_ -= std::min(ahead_, recorded);
    recorded_ += recorded;
  }
  if (executed == 0) return;  // no measurement of the cost
  const double cost = seconds / std::min(executed, recorded);
  // Increases apply at once, decreases gradually: shader compilation and other programs cause outliers.
  cost_ = cost_ > 0 && cost < cost_ ? 0.7 * cost_ + 0.3 * cost : cost_ > 0 ? std::min(cost, 4 * cost_) : cost;
}

void Pacing::endStep(uint32_t needed) {
  if (needed > 0) expected_ = needed;
  recorded_ = std::exchange(ahead_, 0);
}

}  // namespace rill::offline
