#include "offline/advances.hpp"

#include <algorithm>

namespace rill::offline {

void Advances::setFluid(Fluid& fluid, const Scene& scene) {
  fluid_ = &fluid;
  iterations_ = scene.solver.iterations;
  pacing_.setBlock(std::max(1u, fluid.substepsPerBlock()));
  mayQueue_ = std::ranges::none_of(scene.solids, [](const Solid& solid) { return solid.driven > 0; });
}

Expected<void> Advances::submit(const Work& work) {
  while (pieces_.inFlight() < PieceQueue::kMaxInFlight) {
    FluidStep step{.advance_s = work.advance_s, .targets = work.targets, .pulls = work.pulls, .emitters = work.emitters};
    const bool asleep = fluid_->progress().asleep;  // then an advance needs no substeps unless it wakes the fluid
    if (idle()) {
      if (ended_ >= work.advances) return {};
      step.substeps = asleep ? 0 : pacing_.first(work.budget_s);
    } else if (const uint32_t rest = asleep && inFlight() > 0 ? 0 : pacing_.next(work.budget_s); rest > 0) {
      step.resume = true;
      step.substeps = rest;
    } else if (mayQueue_ && work.pulls.empty() && work.emitters.empty() && begun() < work.advances) {
      step.queued = true;
      step.substeps = asleep ? 0 : pacing_.first(work.budget_s);
    } else {
      return {};
    }
    if (work.substeps > 0) step.substeps = pacing_.wholeBlocks(work.substeps);
    if (auto submitted = pieces_.submit(*fluid_, step); !submitted) return submitted;
    pacing_.submit(step.substeps, step.queued);
  }
  return {};
}

bool Advances::isComplete() const { return !(fluid_->progress().timeLeft_s > 0); }

Expected<bool> Advances::finish(PassLog& log, bool clear) {
  if (pieces_.inFlight() == 0) return false;
  while (true) {
    const bool queued = pieces_.front().queued, begins = pieces_.front().begins || (queued && !open_);
    if (clear && begins) log.clear();
    auto piece = pieces_.finish(*fluid_, log);
    if (!piece) {
      abandon();
      return piece.error();
    }
    if (begins) {
      open_ = true;
      current_ = {};
    }
    const FluidProgress& progress = fluid_->progress();
    // During settling, substeps consist of iterations only.
    const uint32_t due = open_ ? std::max(progress.substeps, progress.iterations / iterations_) : executed_;
    pacing_.addPiece(piece->substeps, due - std::min(executed_, due), piece->seconds, queued && !begins);
    if (!open_) return false;
    executed_ = due;
    recorded_ += piece->substeps;
    ++current_.pieces;
    current_.seconds += piece->seconds;
    // An advance that its substeps do not complete is given up; nothing may continue it then.
    if (isComplete()) break;
    if (recorded_ < fluid_->substepsToComplete()) return false;
    if (pieces_.inFlight() == 0) break;
  }
  current_.progress = fluid_->progress();
  last_ = current_;
  pacing_.endStep(std::max(last_.progress.substeps, last_.progress.listBuilds * pacing_.block()));
  open_ = false;
  executed_ = recorded_ = 0;
  ++ended_;
  return true;
}

void Advances::abandon() {
  pieces_.abandon();
  pacing_.abandon();
  open_ = false;
  executed_ = recorded_ = 0;
}

}  // namespace rill::offline
