#include "offline/piece_queue.hpp"

#include <algorithm>

namespace rill::offline {

size_t PieceQueue::starts() const {
  return static_cast<size_t>(std::ranges::count_if(pieces_, [](const Piece& piece) { return piece.begins || piece.queued; }));
}

Expected<void> PieceQueue::submit(Fluid& fluid, const FluidStep& step) {
  graph_.reset();
  static_cast<void>(fluid.addTo(graph_, step));
  if (auto compiled = graph_.compile(); !compiled) return compiled;
  Piece piece{0, step.substeps, !step.resume && !step.queued, step.queued, Clock::now()};
  const auto report = graph_.report();
  piece.report.assign(report.begin(), report.end());  // names and reasons outlive the frame
  if (runsAnything(report)) {
    auto begun = context_.beginFrame();
    if (!begun) return begun.error();
    piece.frame = begun->recording;
    if (auto prepared = graph_.prepare(context_.device()); !prepared) return prepared;
    if (auto ran = context_.submit([&](VkCommandBuffer commands) { graph_.record(commands); }); !ran) return ran;
  }
  pieces_.push_back(std::move(piece));
  return {};
}

Expected<PieceQueue::Finished> PieceQueue::finish(const Fluid& fluid, PassLog& log) {
  const Piece piece = std::move(pieces_.front());
  pieces_.pop_front();
  Finished finished{piece.substeps, 0};
  log.add(piece.report, piece.frame > 0);
  if (piece.frame == 0) return finished;
  if (auto waited = context_.waitFor(piece.frame); !waited) return waited.error();
  const Clock::time_point now = Clock::now();
  for (const Timing& timing : graph_.timings()) finished.seconds += 1e-3 * timing.ms;
  if (finished.seconds == 0) finished.seconds = std::chrono::duration<double>(now - std::max(piece.submitted, last_)).count();
  last_ = now;
  log.add(graph_.timings());
  log.add(fluid.passRuns(), piece.report);
  return finished;
}

}  // namespace rill::offline
