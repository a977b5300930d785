#pragma once
// Implementation of offline::Simulation. simulation.cpp has the public functions; each group below names its file.
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "offline/advances.hpp"
#include "offline/context.hpp"
#include "offline/painter.hpp"
#include "offline/pass_log.hpp"
#include "offline/picture_run.hpp"
#include "offline/probe_values.hpp"
#include "offline/probes.hpp"
#include "offline/readout.hpp"
#include "offline/simulation_keys.hpp"
#include "rill/offline.hpp"
#include "rill/surface_mesher.hpp"
#include "rill/whitewater.hpp"

namespace rill::offline {

class Simulation::Impl {
 public:
  Impl(Scene scene, const Options& options) : scene_(std::move(scene)), options_(options) {}

  // simulation_open.cpp
  /// Uses the given particles, or makes those of the scene's fills.
  Expected<void> place(std::optional<ParticleSet> given);
  /// `from`: the checkpoint to continue from, or null.
  Expected<void> open(const Checkpoint* from);

  // simulation_advance.cpp
  Expected<void> advance(double seconds);

  // simulation_readout.cpp
  Expected<Particles> particles(Order order);
  Expected<SurfaceTriangles> mesh(double cell);
  Expected<DiffuseParticles> whitewater();
  Expected<std::vector<PoseValue>> poses();
  Expected<Stats> stats();
  Expected<Checkpoint> checkpoint(uint64_t frame, double fps);

  // simulation_pictures.cpp
  Expected<void> prepareRender(std::string_view view, uint32_t width, uint32_t height) {
    return painter_.prepare(context_->device(), view, width, height);
  }
  Expected<Image> render(std::string_view view, uint32_t width, uint32_t height);
  Expected<LinearImage> renderLinear(uint32_t width, uint32_t height);

  // simulation.cpp
  double time() const { return time_s_; }
  const Scene& scene() const { return scene_; }
  const ParticleSet& start() const { return start_; }
  const DeviceInfo& device() const { return context_->device().info(); }
  std::string explain() const;
  std::vector<FrameMemory> transientMemory() const;
  std::string graphDot() const { return advanceGraph_.dot(); }
  std::string pictureDot() const { return pictures_.graph().dot(); }
  std::vector<std::string> takeValidationMessages() { return context_->takeMessages(); }
  std::vector<std::string> warnings() const;

 private:
  // simulation_open.cpp
  /// Adds what the fluid needs in all, and what the device has, to the error of a failed allocation.
  Error withMemoryNeeded(Error error) const;
  /// Warns of differences to the run that wrote the checkpoint that may change results.
  void addResumeWarnings(const Checkpoint& from);
  Expected<void> openWhitewater(const Checkpoint* from);
  uint64_t fluidCapacity() const { return std::max<uint64_t>(capacityOf(scene_, start_.positions.size()), start_.positions.size()); }

  // simulation_advance.cpp
  void beginAdvance();
  /// Runs `seconds` in frames of equal length, at most longestFrame_s.
  Expected<void> advanceFrames(double seconds);
  /// Runs frames of `seconds` each.
  Expected<void> advanceFluid(double seconds, uint64_t frames);
  /// One step for the advance that has ended.
  Expected<void> stepWhitewater();
  using Declare = std::function<void(Graph&)>;
  /// Declares a graph, runs it and waits. Graphs without passes to run are not submitted, which makes empty scenes cheap.
  Expected<void> run(Graph& graph, const Declare& declare);
  /// Like run(), without an entry in the pass log.
  Expected<void> runUnlogged(Graph& graph, const Declare& declare);

  // simulation_readout.cpp
  /// Measures statistics and reads particles back, once per time.
  Expected<void> measure();
  Expected<WhitewaterSnapshot> readWhitewater();

  // simulation_pictures.cpp
  /// Draws into `rgba`; the result is the time of the picture, s.
  template <class T>
  Expected<double> draw(std::string_view view, std::vector<T>& rgba, uint32_t width, uint32_t height, PixelKind kind);
  PictureRun::Content drawn(Graph& graph);

  Scene scene_;
  Options options_;
  ParticleSet start_;
  std::vector<std::string> warnings_;
  std::optional<Context> context_;
  std::optional<Fluid> fluid_;
  Painter painter_{scene_, start_, options_};
  PictureRun pictures_;
  // One graph per kind of frame, so that each keeps its memory plan.
  Graph advanceGraph_, measureGraph_, meshGraph_, whiteGraph_;
  std::optional<Whitewater> white_;  ///< with Look::whitewater
  WhitewaterStats whiteStats_;       ///< at the current time
  double frame_s_ = 0;               ///< simulated time of the last frame
  std::optional<SurfaceMesher> mesher_;
  double mesherCell_ = 0;  ///< spacings
  std::optional<Advances> advances_;
  PassLog log_;                         ///< since the last advance() began
  FluidProgress advanced_;              ///< of the last advance(), summed over its frames
  std::optional<FluidStats> measured_;  ///< at the current time
  std::optional<FluidStats> asleep_;    ///< at an earlier time, since which the fluid sleeps
  Readout readout_;                     ///< at the current time, or then
  double time_s_ = 0;
  double wall_s_ = 0;
  uint64_t pictureBoundHits_ = 0;  ///< at the current time
  ProbeValues probes_{scene_};
  double advanced_s_ = 0;  ///< of the last advance(), dropped time included
};

}  // namespace rill::offline
