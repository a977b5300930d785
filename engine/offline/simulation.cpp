#include <optional>

#include "offline/guarded.hpp"
#include "offline/simulation_impl.hpp"

namespace rill::offline {

std::string Simulation::Impl::explain() const {
  return passTable(log_.times(), log_.skipped()) + memoryTable(transientMemory()) + readsText(context_->device().info());
}

std::vector<FrameMemory> Simulation::Impl::transientMemory() const {
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

std::vector<std::string> Simulation::Impl::warnings() const {
  std::vector<std::string> all = start_.warnings;
  all.insert(all.end(), fluid_->warnings().begin(), fluid_->warnings().end());
  all.insert(all.end(), warnings_.begin(), warnings_.end());
  return all;
}

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
