#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace rill::view {

/// Splits steps into pieces of as many substeps as fit into a time budget, by the measured cost of earlier pieces, so that
/// the window stays responsive during long steps. The minimum is one block of substeps.
class Pacing {
 public:
  explicit Pacing(uint32_t block) : block_(block) {}
  /// Call where a change of settings changes the length of a block.
  void setBlock(uint32_t block) { block_ = block; }

  /// Substeps of the next piece, a multiple of the block: limited by the budget and by the expected rest of the step. In the
  /// first step each piece is twice as long as the one before.
  uint32_t next(double budget_s) const;
  /// Call after a piece, with its substeps recorded and executed and its duration.
  void addPiece(uint32_t recorded, uint32_t executed, double seconds);
  /// Call after a step, with its total number of substeps.
  void endStep(uint32_t substeps);

  /// Recent cost of a substep, s; 0: unknown.
  double cost() const { return cost_; }

 private:
  uint32_t wholeBlocks(uint32_t substeps) const { return (substeps + block_ - 1) / block_ * block_; }

  uint32_t block_;
  double cost_ = 0;
  uint32_t expected_ = 0;  // substeps of the last step; 0: unknown
  uint32_t done_ = 0;      // of the current step
};

/// Resolution scale of the image: where rendering is slow, the image is rendered smaller and stretched, as long as that
/// saves time (the cost per particle does not depend on the resolution).
class PictureScale {
 public:
  /// Adds the device time of an image at the current scale.
  void addImage(double seconds);
  double scale() const { return kScales[level_]; }  ///< image over window resolution, per side
  void restart() { *this = {}; }

 private:
  static constexpr std::array kScales{1.0, 0.75, 0.5, 0.375};

  void setLevel(size_t level);

  size_t level_ = 0;
  uint32_t ignored_ = 2;                         // images to ignore: the first ones compile shaders and allocate memory
  uint32_t fastInRow_ = 0;                       // consecutive images that are fast enough for the next finer level
  uint32_t age_ = 0;                             // images since the times of all levels were reset
  std::array<double, kScales.size()> took_s_{};  // recent time by level; 0: unknown
};

}  // namespace rill::view
