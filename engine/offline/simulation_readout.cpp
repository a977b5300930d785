// What is read from a simulation: particles, mesh, poses, figures, checkpoint.
#include <algorithm>

#include "core/shares.hpp"
#include "fluid/settings.hpp"
#include "offline/mesh_readout.hpp"
#include "offline/simulation_impl.hpp"
#include "offline/state_hash.hpp"
#include "offline/whitewater_run.hpp"
#include "rill/version.hpp"
#include "shape/mass.hpp"

namespace rill::offline {

Expected<void> Simulation::Impl::measure() {
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

Expected<Particles> Simulation::Impl::particles(Order order) {
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

Expected<SurfaceTriangles> Simulation::Impl::mesh(double cell) {
  if (auto measured = measure(); !measured) return measured.error();
  SurfaceMesherDesc desc{.capacity = std::max(static_cast<uint32_t>(fluidCapacity()), 1u), .cell = cell};
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

Expected<DiffuseParticles> Simulation::Impl::whitewater() {
  if (!white_) return DiffuseParticles{};
  auto state = readWhitewater();
  if (!state) return state.error();
  return diffuseParticles(*state, start_.origin);
}

Expected<WhitewaterSnapshot> Simulation::Impl::readWhitewater() {
  WhitewaterTickets tickets;
  Graph graph;  // a separate graph, to release its read-back memory afterwards
  auto ran = runUnlogged(graph, [&](Graph& g) { tickets = whitewaterReadout(g, white_->addTo(g, {}, 0)); });
  if (!ran) return ran.error();
  return collectWhitewater(graph, tickets);
}

Expected<std::vector<PoseValue>> Simulation::Impl::poses() {
  if (auto measured = measure(); !measured) return measured.error();
  std::vector<PoseValue> all;
  for (const Solid& solid : scene_.solids) all.push_back(valueOf(solidPose(solid, measured_->time_s)));
  for (const BodyMotion& body : fluid_->bodies())
    all[body.solid] = valueOf(poseOfSolid(
        scene_.solids[body.solid].shape,
        {.center = body.center, .rotation = body.rotation, .velocity = body.velocity, .angularVelocity = body.angularVelocity}));
  return all;
}

Expected<Stats> Simulation::Impl::stats() {
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

Expected<Checkpoint> Simulation::Impl::checkpoint(uint64_t frame, double fps) {
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

}  // namespace rill::offline
