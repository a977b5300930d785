#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <new>
#include <numbers>
#include <optional>

#include "core/shares.hpp"
#include "core/words.hpp"
#include "fluid/settings.hpp"
#include "offline/advances.hpp"
#include "offline/context.hpp"
#include "offline/mesh_readout.hpp"
#include "offline/painter.hpp"
#include "offline/pass_log.hpp"
#include "offline/picture_run.hpp"
#include "offline/probe_values.hpp"
#include "offline/probes.hpp"
#include "offline/readout.hpp"
#include "offline/simulation_keys.hpp"
#include "offline/state_hash.hpp"
#include "offline/whitewater_run.hpp"
#include "rill/offline.hpp"
#include "rill/version.hpp"
#include "shape/mass.hpp"
#include "whitewater/whitewater_records.h"

namespace rill::offline {
namespace {

constexpr double kPiece = 0.1;  // s that a submission should take: drivers give up on one after about two seconds

/// Runs `work` and turns std::bad_alloc into an error.
template <class Work>
auto guarded(const char* what, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) { return Error{ErrorKind::OutOfMemory, std::string(what) + ": out of memory"}; }
}

}  // namespace

class Simulation::Impl {
 public:
  Impl(Scene scene, const Options& options) : scene_(std::move(scene)), options_(options) {}

  /// Uses the given particles, or makes those of the scene's fills.
  Expected<void> place(std::optional<ParticleSet> given) {
    if (auto valid = checkScene(scene_); !valid) return valid;
    if (auto valid = Painter::checkOptions(options_); !valid) return valid;
    constexpr double kShortestFrame = 1e-6;  // s; limits the number of frames of an advance
    if (!(options_.longestFrame_s >= kShortestFrame))
      return Error{ErrorKind::BadInput, "Options::longestFrame_s is " + shortestNumber(options_.longestFrame_s) + "; expected at least " +
                                            shortestNumber(kShortestFrame) + " (s)"};
    auto start = given ? Expected<ParticleSet>(std::move(*given)) : makeParticles(scene_);
    if (!start) return start.error();
    start_ = std::move(*start);
    if (start_.spacing > 0) scene_.fluid.spacing = start_.spacing;
    return {};
  }

  /// Adds what the fluid needs in all, and what the device has, to the error of a failed allocation.
  Error withMemoryNeeded(Error error) const {
    const auto mebibytes = [](uint64_t bytes) { return grouped(bytes >> 20) + " MiB"; };
    const DeviceInfo& device = context_->device().info();
    const uint64_t particles = std::max<uint64_t>(capacityOf(scene_, start_.positions.size()), start_.positions.size());
    error.message += "\n" + grouped(particles) + " particles need " + mebibytes(fluidMemory(scene_, particles).total()) +
                     " on the device; " + inQuotes(device.name) + " has " + mebibytes(device.deviceLocalBytes);
    return error;
  }

  /// `from`: the checkpoint to continue from, or null.
  Expected<void> open(const Checkpoint* from) {
    if (from)
      if (const std::string difference = firstDifference(from->keys, simulationKeys(scene_, start_)); !difference.empty())
        return Error{ErrorKind::BadInput, "the checkpoint was written by another scene: " + difference};
    ContextDesc desc;
    desc.device = options_.device;
    desc.deviceOrigin = options_.deviceOrigin;
    desc.validation = options_.validation;
    desc.pipelineCache = options_.pipelineCache;
    desc.reads = options_.reads;
    desc.framesInFlight = PieceQueue::kMaxInFlight;
    auto context = Context::create(desc);
    if (!context) return context.error();
    context_ = std::move(*context);
    auto fluid = Fluid::create(context_->device(), {.scene = &scene_, .particles = &start_, .snapshot = from ? &from->fluid : nullptr});
    if (!fluid) return fluid.error().kind == ErrorKind::OutOfMemory ? withMemoryNeeded(fluid.error()) : fluid.error();
    fluid_ = std::move(*fluid);
    advances_.emplace(*context_, advanceGraph_);
    advances_->setFluid(*fluid_, scene_);
    if (from) {
      time_s_ = from->time_s;
      addResumeWarnings(*from);
    }
    for (Graph* graph : {&advanceGraph_, &measureGraph_, &whiteGraph_}) graph->enableTimings(options_.passTimes);
    pictures_.enableTimings(options_.passTimes);
    return scene_.look.whitewater && fluid_->capacity() > 0 ? openWhitewater(from) : Expected<void>();
  }

  Expected<void> advance(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0)
      return Error{ErrorKind::BadInput, "advance: found " + std::to_string(seconds) + " s, expected a finite time of at least 0"};
    if (seconds == 0) return {};
    beginAdvance();
    advances_->abandon();  // what an error or an exception has left of the last one
    const auto before = std::chrono::steady_clock::now();
    if (auto ran = advanceFrames(seconds); !ran) return ran;
    wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    time_s_ += seconds;
    advanced_s_ = seconds;
    return {};
  }

  double time() const { return time_s_; }

  Expected<Particles> particles(Order order) {
    if (auto measured = measure(); !measured) return measured.error();
    std::vector<uint32_t> visit;
    if (order == Order::ById) visit = orderById(readout_.ids);
    Particles particles;
    const size_t count = readout_.ids.size();
    particles.positions.resize(count);
    particles.velocities.resize(count);
    particles.densities.resize(count);
    particles.ids.resize(count);
    if (!scene_.fluids.empty()) particles.fluids.resize(count);
    const std::vector<ResolvedFluid> fluids = resolvedFluids(scene_);
    for (size_t k = 0; k < count; ++k) {
      const size_t i = visit.empty() ? k : visit[k];
      const Float3& p = readout_.positions[i];
      particles.positions[k] = {static_cast<float>(start_.origin[0] + p.x), static_cast<float>(start_.origin[1] + p.y),
                                static_cast<float>(start_.origin[2] + p.z)};
      particles.velocities[k] = readout_.velocities[i];
      const size_t fluid = std::min<size_t>(readout_.fluids[i], fluids.size() - 1);
      particles.densities[k] = static_cast<float>(readout_.relativeDensities[i] * fluids[fluid].density);
      particles.ids[k] = readout_.ids[i];
      if (!particles.fluids.empty()) particles.fluids[k] = static_cast<uint8_t>(fluid);
    }
    if (!readout_.concentrations.empty()) particles.diffusing = diffusingFluids(scene_);
    for (size_t n = 0; n < particles.diffusing.size(); ++n) {
      std::vector<float>& all = particles.concentrations.emplace_back(count);
      for (size_t k = 0; k < count; ++k) all[k] = readout_.concentrations[visit.empty() ? k : visit[k]].*kShares[n];
    }
    return particles;
  }

  Expected<SurfaceTriangles> mesh(double cell) {
    if (auto measured = measure(); !measured) return measured.error();
    SurfaceMesherDesc desc{.capacity = std::max(fluidCapacity(), 1u), .cell = cell};
    MeshReadout made;
    // A mesh that had no room says what it needs; where blocks had none, the second try knows the vertices.
    for (int tries = 0; tries < 3; ++tries) {
      if (!mesher_ || mesherCell_ != cell) {
        meshGraph_ = Graph();
        mesher_.reset();
        auto created = SurfaceMesher::create(context_->device(), desc);
        if (!created) return created.error();
        mesher_.emplace(*std::move(created));
        mesherCell_ = cell;
      }
      MeshTickets tickets;
      auto ran = run(meshGraph_, [&](Graph& graph) { tickets = meshReadout(graph, mesher_->addTo(graph, fluid_->addTo(graph, {}))); });
      if (!ran) return ran.error();
      made = collect(meshGraph_, tickets, start_.origin);
      if (fits(made.needed, mesher_->limits())) return std::move(made.triangles);
      desc = roomFor(made.needed, mesher_->limits());
      mesher_.reset();
    }
    return Error{ErrorKind::Failed, "making the mesh: its size is not what it was found to be"};
  }

  Expected<DiffuseParticles> whitewater() {
    if (!white_) return DiffuseParticles{};
    auto state = readWhitewater();
    if (!state) return state.error();
    return diffuseParticles(*state, start_.origin);
  }

  Expected<std::vector<PoseValue>> poses() {
    if (auto measured = measure(); !measured) return measured.error();
    std::vector<PoseValue> all;
    for (const Solid& solid : scene_.solids) all.push_back(valueOf(solidPose(solid, measured_->time_s)));
    for (const BodyMotion& body : fluid_->bodies())
      all[body.solid] = valueOf(poseOfSolid(
          scene_.solids[body.solid].shape,
          {.center = body.center, .rotation = body.rotation, .velocity = body.velocity, .angularVelocity = body.angularVelocity}));
    return all;
  }

  Expected<Stats> stats() {
    if (auto measured = measure(); !measured) return measured.error();
    Stats stats;
    static_cast<FluidStats&>(stats) = *measured_;
    stats.substeps = advanced_.substeps;
    stats.iterations = advanced_.iterations;
    stats.timeDropped_s = advanced_.timeDropped_s;
    stats.listBuilds = advanced_.listBuilds;
    const ProbeReader reader(scene_, readout_.positions, start_.origin);
    stats.front_m = reader.front(Axis::PlusX);
    stats.stateHash =
        stateHash(readout_.positions, readout_.velocities, readout_.ids, fluid_->bodies(), readout_.fluids, readout_.concentrations);
    stats.probes = probes_.read(*fluid_, reader, measured_->time_s, advanced_s_ - advanced_.timeDropped_s);
    if (white_) stats.whitewater = whiteStats_;
    stats.pictureBoundHits = pictureBoundHits_;
    stats.wall_s = wall_s_;
    stats.passes = log_.times();
    stats.skipped = log_.skipped();
    return stats;
  }

  Expected<Checkpoint> checkpoint(uint64_t frame, double fps) {
    // measure() uploads the state and completes the last advance.
    if (auto measured = measure(); !measured) return measured.error();
    Checkpoint c;
    c.rill = RILL_VERSION;
    c.scene = scene_.name;
    c.device = device().name;
    c.driver = device().driver;
    c.time_s = time_s_;
    c.frame = frame;
    c.fps = fps;
    c.keys = simulationKeys(scene_, start_);
    SnapshotReader reader(*fluid_);
    for (Graph graph; !reader.done();) {  // a separate graph, to release its read-back memory afterwards
      auto ran = runUnlogged(graph, [&](Graph& g) { reader.declare(g); });
      if (!ran) return ran.error();
      if (auto taken = reader.take(graph); !taken) return taken.error();
    }
    c.fluid = std::move(reader.snapshot());
    if (white_) {
      auto state = readWhitewater();
      if (!state) return state.error();
      c.whitewater = *std::move(state);
    }
    return c;
  }

  Expected<void> prepareRender(std::string_view view, uint32_t width, uint32_t height) {
    return painter_.prepare(context_->device(), view, width, height);
  }
  Expected<Image> render(std::string_view view, uint32_t width, uint32_t height) {
    Image image{width, height, {}};
    auto now = draw(view, image.rgba, width, height, PixelKind::Display);
    if (!now) return now.error();
    painter_.finish(image, view, *now);
    return image;
  }
  Expected<LinearImage> renderLinear(uint32_t width, uint32_t height) {
    LinearImage image{width, height, {}};
    auto now = draw("final", image.rgba, width, height, PixelKind::Linear);
    if (!now) return now.error();
    return image;
  }

  const Scene& scene() const { return scene_; }
  const ParticleSet& start() const { return start_; }
  const DeviceInfo& device() const { return context_->device().info(); }
  std::string explain() const {
    return passTable(log_.times(), log_.skipped()) + memoryTable(transientMemory()) + readsText(context_->device().info());
  }
  std::vector<FrameMemory> transientMemory() const {
    std::vector<FrameMemory> all;
    for (const auto& [frame, graph] : {std::pair{"advance", &advanceGraph_},
                                       {"measure", &measureGraph_},
                                       {"mesh", &meshGraph_},
                                       {"whitewater", &whiteGraph_},
                                       {"picture", &pictures_.graph()},
                                       {"mean of pictures", &pictures_.meanGraph()}})
      if (const auto heaps = graph->transientHeaps(); !heaps.empty()) all.push_back({frame, {heaps.begin(), heaps.end()}});
    return all;
  }
  std::string graphDot() const { return advanceGraph_.dot(); }
  std::string pictureDot() const { return pictures_.graph().dot(); }
  std::vector<std::string> takeValidationMessages() { return context_->takeMessages(); }

  std::vector<std::string> warnings() const {
    std::vector<std::string> all = start_.warnings;
    all.insert(all.end(), fluid_->warnings().begin(), fluid_->warnings().end());
    all.insert(all.end(), warnings_.begin(), warnings_.end());
    return all;
  }

 private:
  /// Draws into `rgba`; the result is the time of the picture, s.
  template <class T>
  Expected<double> draw(std::string_view view, std::vector<T>& rgba, uint32_t width, uint32_t height, PixelKind kind) {
    if (auto ready = prepareRender(view, width, height); !ready) return ready.error();
    if (auto measured = measure(); !measured) return measured.error();
    const double now = measured_->time_s;  // on the device, which is behind time() if time was dropped
    const PictureRun::Source source{.time_s = now,
                                    .content = [&](Graph& graph) { return drawn(graph); },
                                    .run = [&](Graph& graph, const auto& declare) { return run(graph, declare); }};
    if (auto ok = pictures_.draw(painter_, source, view, width, height, kind, rgba); !ok) return ok.error();
    pictureBoundHits_ += pictures_.boundHits();
    return now;
  }

  PictureRun::Content drawn(Graph& graph) {
    PictureRun::Content content{.fluid = fluid_->addTo(graph, {})};
    if (white_) content.white = {white_->addTo(graph, content.fluid, 0), drawnRadius(white_->desc())};
    return content;
  }

  void beginAdvance() {
    probes_.beginAdvance(*fluid_);
    pictures_.contentChanged();
    advanced_s_ = 0;
    if (measured_) asleep_ = fluid_->progress().asleep ? measured_ : std::nullopt;
    measured_.reset();
    advanced_ = {};
    wall_s_ = 0;
    pictureBoundHits_ = 0;
    log_.clear();
  }

  /// Warns of differences to the run that wrote the checkpoint that may change results.
  void addResumeWarnings(const Checkpoint& from) {
    const auto compare = [&](const char* what, const std::string& expected, const std::string& found) {
      if (expected != found)
        warnings_.push_back("the checkpoint was written with the " + std::string(what) + " " + inQuotes(expected) + ", this is " +
                            inQuotes(found) + "; results may differ bitwise");
    };
    compare("device", from.device, device().name);
    compare("driver", from.driver, device().driver);
    compare("Rill", from.rill, RILL_VERSION);
    if (!scene_.look.whitewater && !from.whitewater.counts.empty())
      warnings_.push_back("look.whitewater is false: the whitewater of the checkpoint is left out");
    if (from.fluid.loads.empty() && std::ranges::any_of(scene_.probes, [](const Probe& probe) { return !probe.load.empty(); }))
      warnings_.push_back("the checkpoint has no loads on solids: those of the first frame lack a part of its first substep");
  }

  /// Like run(), without an entry in the pass log.
  template <class Declare>
  Expected<void> runUnlogged(Graph& graph, Declare&& declare) {
    const PassLog log = log_;
    auto ran = run(graph, std::forward<Declare>(declare));
    log_ = log;
    return ran;
  }

  /// Declares a graph, runs it and waits. Graphs without passes to run are not submitted, which makes empty scenes cheap.
  template <class Declare>
  Expected<void> run(Graph& graph, Declare&& declare) {
    graph.reset();
    declare(graph);
    if (auto compiled = graph.compile(); !compiled) return compiled;
    const auto report = graph.report();
    const bool anything = runsAnything(report);
    log_.add(report, anything);
    if (!anything) return {};
    if (auto began = context_->beginFrame(); !began) return began.error();
    if (auto prepared = graph.prepare(context_->device()); !prepared) return prepared;
    if (auto ran = context_->submit([&](VkCommandBuffer commands) { graph.record(commands); }); !ran) return ran;
    if (auto waited = context_->wait(); !waited) return waited;
    log_.add(graph.timings());
    log_.add(fluid_->passRuns(), report);
    return {};
  }

  /// Runs `seconds` in frames of equal length, at most longestFrame_s.
  Expected<void> advanceFrames(double seconds) {
    const auto frames = static_cast<uint64_t>(std::max(1.0, std::ceil(seconds / options_.longestFrame_s - 1e-9)));
    if (!white_) return advanceFluid(seconds / double(frames), frames);
    for (uint64_t k = 0; k < frames; ++k) {
      if (auto ran = advanceFluid(seconds / double(frames), 1); !ran) return ran;
      if (auto ran = stepWhitewater(); !ran) return ran;
    }
    return {};
  }

  /// `from`: the checkpoint to continue from, or null.
  Expected<void> openWhitewater(const Checkpoint* from) {
    WhitewaterDesc desc = whitewaterOf(scene_, start_, fluid_->capacity());
    if (from) desc.snapshot = &from->whitewater;
    auto white = Whitewater::create(context_->device(), desc);
    if (!white) {
      const std::string scene = scene_.file.empty() ? scene_.name : scene_.file.string();
      return Error{white.error().kind, scene + ": look.whitewater: " + white.error().message};
    }
    white_.emplace(*std::move(white));
    if (from && from->whitewater.counts.empty()) warnings_.push_back("the checkpoint has no whitewater: the run begins without");
    if (from) whiteStats_ = whitewaterStats(from->whitewater.counts);
    return {};
  }

  /// One step for the advance that has ended.
  Expected<void> stepWhitewater() {
    Ticket counts;
    auto ran = run(whiteGraph_, [&](Graph& graph) {
      const FluidState state = fluid_->addTo(graph, {});
      counts = graph.readback(white_->addTo(graph, state, frame_s_, gravityAt(scene_, fluid_->progress().time_s)).counts);
    });
    if (!ran) return ran;
    std::array<uint32_t, kWhiteCountWords> words{};
    const auto bytes = whiteGraph_.data(counts);
    std::memcpy(words.data(), bytes.data(), std::min(bytes.size(), sizeof words));
    whiteStats_ = whitewaterStats(words);
    return {};
  }

  Expected<WhitewaterSnapshot> readWhitewater() {
    WhitewaterTickets tickets;
    Graph graph;  // a separate graph, to release its read-back memory afterwards
    auto ran = runUnlogged(graph, [&](Graph& g) { tickets = whitewaterReadout(g, white_->addTo(g, {}, 0)); });
    if (!ran) return ran.error();
    return collectWhitewater(graph, tickets);
  }

  /// Runs frames of `seconds` each.
  Expected<void> advanceFluid(double seconds, uint64_t frames) {
    const Advances::Work work{
        .advance_s = seconds, .advances = advances_->ended() + frames, .budget_s = kPiece, .substeps = options_.substepsPerSubmit};
    while (advances_->ended() < work.advances || advances_->inFlight() > 0) {
      if (auto submitted = advances_->submit(work); !submitted) return submitted;
      auto ended = advances_->finish(log_);
      if (!ended) return ended.error();
      if (!*ended) continue;
      const FluidProgress& done = advances_->last().progress;
      advanced_.substeps += done.substeps;
      advanced_.iterations += done.iterations;
      advanced_.listBuilds += done.listBuilds;
      // Time that the recorded substeps did not cover is dropped by the next advance.
      advanced_.timeDropped_s += std::max(done.timeDropped_s, done.timeLeft_s);
      frame_s_ = std::max(0.0, seconds - std::max(done.timeDropped_s, done.timeLeft_s));
      if (!done.asleep || done.substeps > 0) asleep_.reset();
    }
    return {};
  }

  uint32_t fluidCapacity() const {
    return static_cast<uint32_t>(std::max<uint64_t>(capacityOf(scene_, start_.positions.size()), start_.positions.size()));
  }

  /// Measures statistics and reads particles back, once per time.
  Expected<void> measure() {
    if (measured_) return {};
    if (asleep_) {  // as before: nothing has moved since
      measured_ = asleep_;
      measured_->time_s = fluid_->progress().time_s;
      return {};
    }
    ReadoutTickets tickets;
    auto ran = run(measureGraph_, [&](Graph& graph) {
      const FluidState state = fluid_->addTo(graph, {.stats = true});
      tickets = readout(graph, state);
    });
    if (!ran) return ran;
    readout_ = collect(measureGraph_, tickets);
    if (removes(scene_)) readout_ = activeOnly(readout_);
    FluidStats stats = fluid_->stats().value_or(FluidStats{});
    if (fluid_->count() == 0) stats.time_s = time_s_;
    measured_ = stats;
    return {};
  }

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

Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Expected<Simulation> Simulation::open(const std::filesystem::path& scene, const Options& options) {
  auto read = loadScene(scene, options.overrides);
  if (!read) return read.error();
  return open(std::move(*read), options);
}

Expected<Simulation> Simulation::make(Scene scene, std::optional<ParticleSet> start, const Options& options, const Checkpoint* from) {
  return guarded("opening the scene", [&]() -> Expected<Simulation> {
    if (start && start->positions.size() > kMaxParticles)
      return Error{ErrorKind::TooLarge,
                   std::to_string(start->positions.size()) + " particles; expected at most " + std::to_string(kMaxParticles)};
    auto impl = std::make_unique<Impl>(std::move(scene), options);
    if (auto placed = impl->place(std::move(start)); !placed) return placed.error();
    if (auto opened = impl->open(from); !opened) return opened.error();
    return Simulation(std::move(impl));
  });
}

Expected<Simulation> Simulation::open(Scene scene, const Options& options) { return make(std::move(scene), {}, options, nullptr); }

Expected<Simulation> Simulation::open(Scene scene, ParticleSet start, const Options& options) {
  return make(std::move(scene), std::move(start), options, nullptr);
}

Expected<Simulation> Simulation::resume(Scene scene, const Checkpoint& checkpoint, const Options& options) {
  return make(std::move(scene), {}, options, &checkpoint);
}

Expected<void> Simulation::advance(double seconds) {
  return guarded("simulating", [&] { return impl_->advance(seconds); });
}
double Simulation::time() const { return impl_->time(); }
Expected<Particles> Simulation::particles(Order order) {
  return guarded("reading the particles", [&] { return impl_->particles(order); });
}
Expected<SurfaceTriangles> Simulation::mesh(double cell) {
  return guarded("making the mesh", [&] { return impl_->mesh(cell); });
}
Expected<DiffuseParticles> Simulation::whitewater() {
  return guarded("reading the whitewater", [&] { return impl_->whitewater(); });
}
Expected<std::vector<PoseValue>> Simulation::poses() {
  return guarded("reading the poses", [&] { return impl_->poses(); });
}
Expected<Stats> Simulation::stats() {
  return guarded("measuring", [&] { return impl_->stats(); });
}
Expected<Checkpoint> Simulation::checkpoint(uint64_t frame, double fps) {
  return guarded("taking a checkpoint", [&] { return impl_->checkpoint(frame, fps); });
}
Expected<Image> Simulation::render(const std::string& view, uint32_t width, uint32_t height) {
  return guarded("drawing", [&] { return impl_->render(view, width, height); });
}
Expected<LinearImage> Simulation::renderLinear(uint32_t width, uint32_t height) {
  return guarded("drawing", [&] { return impl_->renderLinear(width, height); });
}
Expected<void> Simulation::prepareRender(const std::string& view, uint32_t width, uint32_t height) {
  return guarded("drawing", [&] { return impl_->prepareRender(view, width, height); });
}
Expected<void> Simulation::checkPicture(const std::string& view, uint32_t width, uint32_t height) {
  return Painter::check(view, width, height);
}
std::span<const std::string_view> Simulation::views() { return Painter::views(); }
const Scene& Simulation::scene() const { return impl_->scene(); }
const ParticleSet& Simulation::start() const { return impl_->start(); }
const DeviceInfo& Simulation::device() const { return impl_->device(); }
std::vector<std::string> Simulation::warnings() const { return impl_->warnings(); }
std::string Simulation::explain() const { return impl_->explain(); }
std::vector<FrameMemory> Simulation::transientMemory() const { return impl_->transientMemory(); }
std::string Simulation::graphDot() const { return impl_->graphDot(); }
std::string Simulation::pictureDot() const { return impl_->pictureDot(); }
std::vector<std::string> Simulation::takeValidationMessages() { return impl_->takeValidationMessages(); }

}  // namespace rill::offline
