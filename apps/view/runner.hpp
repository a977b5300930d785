#pragma once
// Simulates a scene in steps of the length that rill-capture uses, split into pieces so that the window stays responsive.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "offline/advances.hpp"
#include "offline/context.hpp"
#include "offline/painter.hpp"
#include "offline/pass_log.hpp"
#include "rill/fluid.hpp"
#include "rill/scene_io.hpp"
#include "rill/snapshot.hpp"
#include "rill/whitewater.hpp"
#include "shape/pose.hpp"
#include "views/bounds.hpp"

namespace rill::view {

/// Whether particles come or go.
inline bool hasFlows(const Scene& scene) {
  return !scene.emitters.empty() || !scene.drains.empty() || (scene.domain && scene.domain->open_removes);
}

/// Figures of a completed step.
struct StepFigures {
  uint32_t substeps = 0, iterations = 0, pieces = 0;
  double timeDropped_s = 0;
  double seconds = 0;  ///< of its pieces
};

/// What a simulation needs to continue on the same or another device.
struct KeptState {
  Scene scene;
  std::shared_ptr<const ParticleSet> start;  ///< including particles that were added
  Bounds firstBounds;
  std::optional<FluidSnapshot> snapshot = {};  ///< none: from the start
  uint64_t steps = 0;                          ///< finished
  std::vector<double> flows = {};              ///< of the emitters, m^3/s
  uint64_t tapRoom = 0;                        ///< particles; 0: no tap was added
};

/// After N steps the state is bitwise equal to frame N of `rill-capture --fps 60`, however the steps are split. Pieces, of the next step,
/// too, are submitted before it is known whether the step is complete.
class Runner {
 public:
  /// BadInput, TooLarge, OutOfMemory as Fluid::create. The context outlives it.
  static Expected<std::unique_ptr<Runner>> create(offline::Context& context, Scene scene);
  /// Continues from kept() of another one, whose context may be gone. Errors as create().
  static Expected<std::unique_ptr<Runner>> resume(offline::Context& context, const KeptState& kept);

  /// Starts a step or continues the current one by pieces of about `budget_s` of real time. Waits for the oldest piece; one may still
  /// be in flight then. `more`: a step may begin behind the current one.
  Expected<void> advancePiece(double budget_s, bool more = false);
  /// Waits for all pieces in flight. The step that they belong to may need more.
  Expected<void> settle();
  /// Completes the steps that have begun, or simulates a whole one.
  Expected<void> step();
  bool betweenSteps() const { return advances_.idle(); }

  uint64_t steps() const { return steps_; }  ///< finished
  /// With those that are under way, of which the last may not have begun after all.
  uint64_t begun() const { return steps_ + advances_.begun() - advances_.ended(); }
  double time_s() const { return fluid_->progress().known ? fluid_->progress().time_s : 0; }
  const StepFigures& last() const { return last_; }

  /// Only between steps: measures figures, and the density for the view `density`. Does not change later results.
  Expected<FluidStats> measure();
  /// Only between steps: the `stateHash` of rill-capture's figures.
  Expected<uint64_t> hash();

  // These continue from the current state with a change (runner_changes.cpp); the current step is completed first. Errors as
  // create(); then nothing is changed.

  /// Applies the settings of a scene that differs only in keys for which Session::isLive() is true. Emitters and solids stay as they are,
  /// but for the mass of bodies.
  Expected<void> change(Scene scene);
  /// Replaces the solids. Existing ones come first, in the same order, and keep their pose(), bodies also their velocity and load.
  Expected<void> changeSolids(std::vector<Solid> solids);
  /// Adds an emitter, closed, behind those of the scene, with room for `room` > 0 particles in addition, where the device has it. Once.
  Expected<void> addTap(const Emitter& emitter, uint64_t room);
  /// Changes what the tap, which was added, emits to one of the scene's fluids.
  Expected<void> changeTap(const std::string& fluid);
  /// Adds the particles of a fill where there is room, and returns their number. BadInput where less than a quarter fit.
  Expected<uint64_t> add(const Fill& fill);

  /// Completes the current step and takes a snapshot for kept(), of at most `particles`. Does not change later results.
  Expected<void> keep(uint32_t particles = UINT32_MAX);
  /// The state at the last keep() or change that continued the simulation, else the start.
  const KeptState& kept() const { return kept_; }

  /// Current pose of a solid, m in scene coordinates.
  Pose pose(uint32_t solid) const;
  /// Sets the target of a driven solid for the next step and those that follow.
  void setTarget(const SolidTarget& target);
  void clearTargets() { targets_.clear(); }  ///< driven solids then stay where they are
  /// Pulls a body in the next step and those that follow, in place of a pull before.
  void setPull(const BodyPull& pull) { pulls_ = {pull}; }
  void clearPulls() { pulls_.clear(); }
  /// Index of the emitter that was added.
  std::optional<uint32_t> tap() const;
  /// Changes an emitter from the next step on.
  void setEmitter(const EmitterTarget& target);
  /// Flows of the emitters, m^3/s: those of the scene, or the last that were set.
  std::span<const double> flows() const { return flows_; }
  /// Current positions, m relative to start().origin, in the order of the device.
  Expected<std::vector<Float3>> positions();

  /// Uploads the initial state, so that it can be drawn before the first step.
  Expected<void> begin();
  FluidState present(Graph& graph) const { return fluid_->present(graph); }
  /// Whitewater of the last step, for the same graph; none unless the scene has look.whitewater.
  offline::DrawnWhitewater presentWhitewater(Graph& graph, const FluidState& fluid);
  /// The same on the host. Only between steps.
  Expected<WhitewaterSnapshot> whitewater();
  /// Passes of the last step: runs, milliseconds if timed, and skipped passes with the reason.
  const offline::PassLog& log() const { return shown_; }
  void timePasses(bool enabled) {
    timed_ = enabled;
    graph_.enableTimings(enabled);
  }
  /// Whether a piece may be in flight while the window is drawn: the device measures its time, and the particles, which are drawn as they
  /// are after it, go with solids that are drawn where they were before.
  bool mayStayBusy() const;
  const Graph& stepGraph() const { return graph_; }

  const Scene& scene() const { return scene_; }
  const ParticleSet& start() const { return *start_; }
  const Bounds& firstBounds() const { return firstBounds_; }  ///< of the fluid at the start
  Fluid& fluid() { return *fluid_; }
  const Fluid& fluid() const { return *fluid_; }
  std::vector<std::string> warnings() const;

 private:
  Runner(offline::Context& context, Scene scene) : context_(context), scene_(std::move(scene)), advances_(context, graph_) {}
  Expected<void> finishPiece();
  template <class Declare>
  Expected<void> run(Graph& graph, Declare&& declare);
  Expected<FluidSnapshot> snapshot();
  uint32_t count() const { return fluid_->count(); }
  Expected<void> continueFrom(Scene scene, std::shared_ptr<const ParticleSet> start, FluidSnapshot from);
  Expected<Fluid> fluidOf(const Scene& scene, const ParticleSet& start, const FluidSnapshot* from);
  Expected<void> makeFluid(const FluidSnapshot* from);
  Expected<std::optional<Whitewater>> whitewaterOf(const Fluid& fluid, const Scene& scene, const ParticleSet& start,
                                                   const WhitewaterSnapshot* from);
  Expected<void> stepWhitewater();
  void keep(FluidSnapshot now);

  offline::Context& context_;
  Scene scene_;
  std::shared_ptr<const ParticleSet> start_;  ///< including particles that were added
  Bounds firstBounds_;
  std::optional<Fluid> fluid_;
  std::vector<SolidTarget> targets_;
  std::vector<BodyPull> pulls_;
  std::vector<EmitterTarget> emitters_;  ///< for the next step that begins
  std::vector<double> flows_;
  uint64_t tapRoom_ = 0;
  std::optional<Whitewater> white_;  ///< with Look::whitewater
  Graph graph_, measureGraph_, whiteGraph_;
  offline::Advances advances_;
  uint64_t steps_ = 0;
  bool timed_ = true;
  StepFigures last_;
  KeptState kept_;
  offline::PassLog log_, shown_;
};

}  // namespace rill::view
