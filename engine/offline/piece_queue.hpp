#pragma once
// Submits an advance of a fluid piece by piece, each while the one before still runs, so that the device never waits for the host.
#include <chrono>
#include <deque>
#include <vector>

#include "offline/context.hpp"
#include "offline/pass_log.hpp"
#include "rill/fluid.hpp"

namespace rill::offline {

class PieceQueue {
 public:
  static constexpr size_t kMaxInFlight = 2;  ///< pieces; the context needs as many frames in flight

  /// A piece that has finished.
  struct Finished {
    uint32_t substeps = 0;  ///< recorded
    double seconds = 0;     ///< on the device, if its passes were timed, else since it or the wait for the one before began
  };

  /// `context` and `graph` must outlive it; no other code may use `graph`.
  PieceQueue(Context& context, Graph& graph) : context_(context), graph_(graph) {}

  /// A piece in flight.
  struct Piece {
    uint64_t frame = 0;     ///< 0: nothing was submitted
    uint32_t substeps = 0;  ///< recorded
    bool begins = false;    ///< an advance, whatever was before
    bool queued = false;    ///< FluidStep::queued
    std::chrono::steady_clock::time_point submitted = {};
    std::vector<PassReport> report = {};
  };

  size_t inFlight() const { return pieces_.size(); }
  const Piece& front() const { return pieces_.front(); }  ///< the oldest
  /// How many of them may begin an advance.
  size_t starts() const;
  /// Submits a piece; at most kMaxInFlight may be in flight then. A fluid without particles has no passes: nothing is submitted, but the
  /// piece has to be finished all the same.
  Expected<void> submit(Fluid& fluid, const FluidStep& step);
  /// Waits for the oldest piece. Fluid::progress() is that after it, whatever else has finished; its passes are added to `log`.
  Expected<Finished> finish(const Fluid& fluid, PassLog& log);
  /// Gives up all pieces, after an error.
  void abandon() { pieces_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  Context& context_;
  Graph& graph_;
  std::deque<Piece> pieces_;
  Clock::time_point last_;  ///< when the last piece was found to have finished
};

}  // namespace rill::offline
