#include "view/picture_scale.hpp"

namespace rill::view {

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
