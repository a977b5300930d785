#pragma once
// A scene's fluid, run in steps of rill-capture's length, each in pieces that bound how long the window has to wait.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "offline/context.hpp"
#include "offline/pass_log.hpp"
#include "rill/fluid.hpp"
#include "rill/scene_io.hpp"
#include "sph/solid_pose.hpp"
#include "view/pacing.hpp"
#include "views/bounds.hpp"

namespace rill::view {

/// What a step was, once it is over.
struct StepFigures {
  uint32_t substeps = 0, iterations = 0, pieces = 0;
  double time_dropped_s = 0;
  double wall_s = 0;  ///< of its pieces
};

/// After N steps the state has the bits of `rill-capture --fps 60` in frame N, however they were cut into pieces: a piece ends before the
/// next one begins, since only then is it known whether the step is over.
class Runner {
 public:
  /// BadInput, TooLarge, OutOfMemory as Fluid::create. The context outlives it.
  static Expected<std::unique_ptr<Runner>> create(offline::Context& context, Scene scene);

  /// Begins a step, or goes on with the one under way, by as much as about `budget_s` of real time allows, and waits for it.
  Expected<void> piece(double budget_s);
  /// A step to its end, or the rest of the one under way.
  Expected<void> step();
  bool between() const { return recorded_ == 0; }  ///< no step is under way

  uint64_t steps() const { return steps_; }  ///< finished
  double time_s() const { return fluid_->progress().known ? fluid_->progress().time_s : 0; }
  const StepFigures& last() const { return last_; }
  const Pacing& pacing() const { return pacing_; }

  /// Between steps: figures of this instant, with the density that the view `density` shows. No later bit depends on it.
  Expected<FluidStats> measure();
  /// Between steps: as `state_hash` in rill-capture's figures.
  Expected<uint64_t> hash();

  // Goes on from the present instant with something changed; a step under way is finished first. Errors as create(), and then nothing has.

  /// Other settings: those of a scene that differs in what leaves the particles and their neighborhoods as they are (Session::isLive()).
  /// Solids stay as they are.
  Expected<void> change(Scene scene);
  /// Other solids. Those that were there before come first, in the same order, and are where their pose() was.
  Expected<void> changeSolids(std::vector<Solid> solids);
  /// More particles, as the fill makes them where there is room: how many. BadInput where that is less than a quarter.
  Expected<uint64_t> add(const Fill& fill);

  /// Where a solid is at present, m in the scene's coordinates.
  SolidPose pose(uint32_t solid) const;
  /// Where a driven solid is to be at the end of the next step, and of those that follow.
  void steer(const SolidTarget& target);
  void letGo() { targets_.clear(); }  ///< of all: they stay where they are
  /// The particles at present, m relative to start().origin, in the device's order.
  Expected<std::vector<Float3>> positions();

  /// Makes the start known to the device, so that it can be shown before the first step.
  Expected<void> begin();
  FluidState present(Graph& graph) const { return fluid_->present(graph); }
  /// Passes of the last step: runs, and ms where they are timed; and those left out, with the reason.
  const offline::PassLog& log() const { return shown_; }
  void timePasses(bool enabled) { graph_.enableTimings(enabled); }
  const Graph& stepGraph() const { return graph_; }

  const Scene& scene() const { return scene_; }
  const ParticleSet& start() const { return start_; }
  const Bounds& firstBounds() const { return firstBounds_; }  ///< of the fluid, before anything was added
  Fluid& fluid() { return *fluid_; }
  const Fluid& fluid() const { return *fluid_; }
  std::vector<std::string> warnings() const;

 private:
  Runner(offline::Context& context, Scene scene) : context_(context), scene_(std::move(scene)) {}
  template <class Declare>
  Expected<void> run(Graph& graph, Declare&& declare);
  Expected<FluidSnapshot> snapshot();
  uint32_t count() const { return fluid_->count(); }
  Expected<void> goOn(Scene scene, ParticleSet start, const FluidSnapshot& from);

  offline::Context& context_;
  Scene scene_;
  ParticleSet start_;  ///< and what was added since
  Bounds firstBounds_;
  std::unique_ptr<Fluid> fluid_;
  std::vector<SolidTarget> targets_;
  Graph graph_, measureGraph_;
  Pacing pacing_{1};
  uint64_t steps_ = 0;
  uint32_t recorded_ = 0;  ///< substeps of the step under way
  uint32_t done_ = 0;      ///< of them, those that were due
  StepFigures current_, last_;
  offline::PassLog log_, shown_;
};

}  // namespace rill::view
