#pragma once
#include <cstdint>

namespace rill::offline {

/// Splits advances of a fluid into pieces of as many substeps as fit into a time budget, by the measured cost of earlier pieces. Thus a
/// window stays responsive, and no submission runs into a driver's time limit. The minimum is one block of substeps. A piece may be
/// submitted while others are in flight.
class Pacing {
 public:
  explicit Pacing(uint32_t block) : block_(block) {}
  /// Call where a change of settings changes the length of a block.
  void setBlock(uint32_t block) { block_ = block; }
  uint32_t block() const { return block_; }
  /// The least number of substeps in whole blocks that is not below `substeps`.
  uint32_t wholeBlocks(uint32_t substeps) const { return (substeps + block_ - 1) / block_ * block_; }

  /// Substeps of the next piece of this advance, a multiple of the block: limited by the budget and by the expected rest of the advance.
  /// 0: it is expected to be complete after the pieces in flight. In the first advance each piece is twice as long as the one before.
  uint32_t next(double budget_s) const;
  /// Substeps of the first piece of the next advance, while this one is in flight.
  uint32_t first(double budget_s) const;
  /// Call when a piece is submitted; `ahead`: as the first of the next advance.
  void submit(uint32_t substeps, bool ahead = false);
  /// Call after a piece, with its substeps recorded and executed and its duration. `ahead`: as in submit(), if this advance took it.
  void addPiece(uint32_t recorded, uint32_t executed, double seconds, bool ahead = false);
  /// Call after an advance, with the substeps that had to be recorded for it; 0: as before. What is in flight counts for the next one.
  void endStep(uint32_t needed);
  /// Forgets the advance under way and all pieces in flight; the cost and the expected length stay.
  void abandon() { recorded_ = ahead_ = inFlight_ = 0; }

  /// Recent cost of a substep, s; 0: unknown.
  double cost() const { return cost_; }

 private:
  uint32_t affordable(double budget_s) const;

  uint32_t block_;
  double cost_ = 0;
  uint32_t expected_ = 0;  // substeps of the last advance; 0: unknown
  uint32_t recorded_ = 0;  // in the current advance
  uint32_t ahead_ = 0;     // recorded for the next one
  uint32_t inFlight_ = 0;  // pieces
};

}  // namespace rill::offline
