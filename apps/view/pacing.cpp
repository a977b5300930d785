#include "view/pacing.hpp"

#include <algorithm>
#include <iterator>

namespace rill::view {

uint32_t Pacing::next(double budget_s) const {
  if (!(cost_ > 0)) return block_;  // the first says what one costs
  const double fits = std::clamp(budget_s / cost_, 0.0, 1e6);
  const uint32_t affordable = std::max(static_cast<uint32_t>(fits) / block_ * block_, block_);
  // Substeps that are not due cost empty dispatches; a step that needs more than the one before gets another piece.
  const uint32_t needed = expected_ > done_ ? wholeBlocks(expected_ - done_) : block_;
  return expected_ == 0 ? affordable : std::min(affordable, needed);
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

constexpr double kScales[] = {1, 0.75, 0.5, 0.375};
constexpr double kTooLong = 0.120, kQuick = 0.060;  // s
constexpr uint32_t kPatience = 20;                  // pictures, before it gets finer again

}  // namespace

double PictureScale::scale() const { return kScales[level_]; }

void PictureScale::drew(double seconds) {
  if (seconds > kTooLong) {
    level_ = std::min<uint32_t>(level_ + 1, std::size(kScales) - 1);
    calm_ = 0;
  } else if (level_ > 0) {
    const double finer = kScales[level_ - 1] / kScales[level_];
    calm_ = seconds * finer * finer < kQuick ? calm_ + 1 : 0;
    if (calm_ >= kPatience) {
      --level_;
      calm_ = 0;
    }
  }
}

}  // namespace rill::view
