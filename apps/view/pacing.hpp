#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace rill::view {

/// How much of a step a displayed frame simulates, so that the window answers while a step takes long: a piece of as many substeps as fit
/// into a budget of time, by what the last pieces took. The device cannot split a block of substeps, which is the least.
class Pacing {
 public:
  explicit Pacing(uint32_t block) : block_(block) {}
  /// The fluid's settings have changed, and with them the length of its blocks.
  void setBlock(uint32_t block) { block_ = block; }

  /// Substeps of the next piece, whole blocks: what the budget allows, and at most what the step is expected to need still; the first
  /// step's double.
  uint32_t next(double budget_s) const;
  /// A piece was simulated: substeps recorded, those of them that were due, and how long it took.
  void ran(uint32_t recorded, uint32_t due, double seconds);
  /// A step came to its end after so many substeps, all its pieces added up.
  void finished(uint32_t substeps);

  /// s a substep, of late; 0: not known yet.
  double cost() const { return cost_; }

 private:
  uint32_t wholeBlocks(uint32_t substeps) const { return (substeps + block_ - 1) / block_ * block_; }

  uint32_t block_;
  double cost_ = 0;
  uint32_t expected_ = 0;  // substeps of a step, by the last one; 0: not known yet
  uint32_t done_ = 0;      // of the step under way
};

/// How fine the picture is where drawing it takes so long that the window would not answer: it is drawn smaller and stretched, as far as
/// that makes it quicker (what is done for each particle costs the same at any size).
class PictureScale {
 public:
  /// A picture of this scale took so long on the device.
  void drew(double seconds);
  double scale() const { return kScales[level_]; }  ///< pixels of the picture over pixels of the window, a side
  void restart() { *this = {}; }

 private:
  static constexpr std::array kScales{1.0, 0.75, 0.5, 0.375};

  void go(size_t level);

  size_t level_ = 0;
  uint32_t ignored_ = 2;                         // pictures: the first ones compile shaders, and find their memory
  uint32_t calm_ = 0;                            // pictures in a row that would have been quick enough a level finer
  uint32_t age_ = 0;                             // pictures since other levels were forgotten
  std::array<double, kScales.size()> took_s_{};  // of late, by level; 0: not known
};

}  // namespace rill::view
