#pragma once
// Advances of a fluid, in pieces that are submitted while earlier ones still run.
#include <limits>

#include "offline/pacing.hpp"
#include "offline/piece_queue.hpp"

namespace rill::offline {

/// Figures of a completed advance.
struct AdvanceFigures {
  FluidProgress progress;
  uint32_t pieces = 0;
  double seconds = 0;  ///< of its pieces
};

/// The bits of the fluid depend on the advances alone, not on pieces or timing: the device decides whether an advance is complete
/// (FluidStep::queued).
class Advances {
 public:
  /// `context` and `graph` must outlive it; no other code may use `graph`.
  Advances(Context& context, Graph& graph) : pieces_(context, graph) {}
  /// Continues with this fluid, which outlives its use; nothing may be in flight. `cost` of substeps is kept.
  void setFluid(Fluid& fluid, const Scene& scene);

  /// Parameters of submit().
  struct Work {
    double advance_s = 0;
    uint64_t advances = 0;                                      ///< how many may have begun, counted as ended()
    double budget_s = std::numeric_limits<double>::infinity();  ///< time that a piece may take
    std::span<const SolidTarget> targets = {};
    std::span<const BodyPull> pulls = {};          ///< with some, an advance begins only once the last one is known to be complete
    std::span<const EmitterTarget> emitters = {};  ///< of the next advance that begins; it waits likewise
    uint32_t substeps = 0;                         ///< of every piece; 0: by the budget
  };
  /// Submits pieces until enough are in flight or nothing else is expected to be necessary.
  Expected<void> submit(const Work& work);
  /// Waits for the oldest piece and adds its passes to `log`. True where it completed an advance: last().
  /// `clear`: the log is emptied where an advance begins. After an error nothing is in flight.
  Expected<bool> finish(PassLog& log, bool clear = false);
  /// Gives up the advance under way and all pieces in flight, after an error; the next submit() begins an advance.
  void abandon();

  uint64_t ended() const { return ended_; }
  /// Advances that have ended, that is under way, and that may have begun behind it.
  uint64_t begun() const { return ended_ + (open_ ? 1 : 0) + pieces_.starts(); }
  size_t inFlight() const { return pieces_.inFlight(); }         ///< pieces
  bool idle() const { return !open_ && pieces_.starts() == 0; }  ///< no advance is under way
  const AdvanceFigures& last() const { return last_; }

 private:
  bool isComplete() const;

  PieceQueue pieces_;
  Fluid* fluid_ = nullptr;
  Pacing pacing_{1};
  uint32_t iterations_ = 1;
  bool mayQueue_ = false;
  bool open_ = false;      ///< an advance has begun and is not known to be complete
  uint32_t executed_ = 0;  ///< of its substeps, and
  uint32_t recorded_ = 0;  ///< how many were recorded, in finished pieces
  uint64_t ended_ = 0;
  AdvanceFigures current_, last_;
};

}  // namespace rill::offline
