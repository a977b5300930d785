// A Fluid's life: what it needs, its buffers and pipelines.
#include "rill/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/words.hpp"
#include "fluid/fluid_impl.hpp"
#include "fluid/snapshot.hpp"
#include "gpu/texel_reads.hpp"

namespace rill {
namespace {

constexpr uint32_t kMaxCluster = 32;  // see shaders/fluid/cluster.glsl: a window of candidates has as many

constexpr uint64_t kMaxBuffer = uint64_t{128} << 20;
static_assert(kMaxParticles == KeySortDesc::kMaxCount);
static_assert(kMaxParticles <= 1u << 24);  // sorted particles carry their numbers as floats

uint64_t listEntries(const Scene& scene) {
  if (scene.solver.neighbors == NeighborChoice::Grid) return 0;
  return listCapacity(scene.fluid.smoothing_ratio + kListSkin);
}

uint64_t blocks(uint64_t particles) { return (particles + kListBlock - 1) / kListBlock; }

std::string mebibytes(uint64_t bytes) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f MiB", double(bytes) / (1 << 20));
  return text;
}

/// All but the numbers of the particles, each of which may be anything.
Expected<void> checkGiven(const FluidDesc& desc) {
  const auto bad = [](std::string what) { return Error{ErrorKind::BadInput, std::move(what)}; };
  if (!desc.scene) return bad("FluidDesc::scene is null; expected a scene");
  if (!desc.particles) return bad("FluidDesc::particles is null; expected what makeParticles() makes, or a set of the host's own");
  const size_t n = desc.particles->positions.size(), velocities = desc.particles->velocities.size();
  if (velocities != n)
    return bad("a fluid needs as many velocities as positions: " + std::to_string(velocities) + " for " + std::to_string(n));
  for (const double v : desc.particles->origin)
    if (!(std::abs(v) <= std::numeric_limits<float>::max()))
      return bad("ParticleSet::origin is " + shortestNumber(v) + "; expected numbers (m) that a 32-bit float can hold");
  return checkScene(*desc.scene);
}

}  // namespace

FluidMemory fluidMemory(const Scene& scene, uint64_t particles) {
  FluidMemory memory;
  // position, velocity, prediction, push, work and two of the near sample; warm, id, count, cell, near list; and while sorting: three vec4,
  // a key, where keys have arrived, and the order of full cells.
  uint64_t each = 7 * 16 + 5 * 4 + (3 * 16 + 3 * 4);
  if (!startsWarm(scene)) each -= 16 + 4;
  if (scene.solver.neighbors == NeighborChoice::Grid) each -= 4;
  if (scene.solver.iterations > 1) each += 4;
  if (scene.fluid.viscosity > 0 || scene.fluid.vorticity > 0) each += 2 * 16;
  if (!scene.solids.empty()) each += 16;
  memory.particle_bytes = each * (particles + 1);
  memory.list_bytes = blocks(particles) * kListBlock * listEntries(scene) * 4;
  memory.grid_bytes = maxGridCells(particles) * 4 * 5 / 4;  // cell starts, and a sort's tile sums
  return memory;
}

Expected<std::unique_ptr<FluidImpl>> FluidImpl::create(Device& device, const FluidDesc& desc) {
  if (auto given = checkGiven(desc); !given) return given.error();
  const Scene& scene = *desc.scene;
  const ParticleSet& particles = *desc.particles;
  const uint64_t n = particles.positions.size();
  auto impl = std::make_unique<FluidImpl>();
  impl->device_ = &device.impl();
  impl->memory = fluidMemory(scene, n);
  const uint64_t available = device.info().deviceLocalBytes;
  const uint64_t largest = std::max((n + 1) * 16, n * 32);  // positions, with the dummy; wall samples
  if (impl->memory.total() > available || largest > kMaxBuffer || n > kMaxParticles)
    return Error{ErrorKind::TooLarge, std::to_string(n) + " particles need " + mebibytes(impl->memory.total()) + " on the device; \"" +
                                          device.info().name + "\" has " + mebibytes(available) + " and holds at most " +
                                          std::to_string(kMaxParticles) +
                                          " particles: make fluid.spacing larger or fluid.particles smaller"};

  StartFigures start{.count = static_cast<uint32_t>(n)};
  double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  bool any = false;
  for (size_t i = 0; i < n; ++i) {
    const Float3 &x = particles.positions[i], &u = particles.velocities[i];
    if (!finite(x)) continue;
    if (const float speed = speedOf(u); std::isfinite(speed)) start.fastest = std::max<double>(start.fastest, speed);
    const double v[3] = {x.x, x.y, x.z};
    for (int a = 0; a < 3; ++a) {
      low[a] = any ? std::min(low[a], v[a]) : v[a];
      high[a] = any ? std::max(high[a], v[a]) : v[a];
    }
    any = true;
  }
  for (int a = 0; a < 3; ++a) {
    start.origin[a] = particles.origin[a];
    start.extent[a] = high[a] - low[a];
  }
  auto setup = makeFluidSetup(scene, start);
  if (!setup) return setup.error();
  impl->setup = std::move(*setup);
  impl->count = static_cast<uint32_t>(n);
  std::copy(particles.origin, particles.origin + 3, impl->origin);

  if (desc.snapshot && impl->count > 0)
    if (auto fits = checkSnapshot(*desc.snapshot, snapshotShape(impl->setup)); !fits) return fits.error();

  if (impl->count == 0) return impl;
  if (auto ok = impl->makeBuffers(device, desc.storageReads); !ok) return ok.error();
  impl->stageScene();
  if (desc.snapshot)
    impl->stageSnapshot(*desc.snapshot);
  else
    impl->stageStart(particles, desc.settle);
  if (auto ok = impl->staging_->make(device); !ok) return ok.error();
  if (auto ok = impl->makePipelines(device); !ok) return ok.error();
  return impl;
}

Expected<void> FluidImpl::makeBuffers(Device& device, bool storageReads) {
  const uint64_t n = count, more = n + 1;
  const FluidParams& p = setup.params;

  const uint64_t blockBytes = uint64_t{kListBlock} * p.listCapacity * 4;
  const uint64_t wanted = p.listCapacity == 0 ? 1 : (blocks(n) * blockBytes + kMaxBuffer - 1) / kMaxBuffer;
  const uint64_t chunkBlocks = (blocks(n) + wanted - 1) / wanted;
  const uint32_t chunk = p.listCapacity == 0 ? count : static_cast<uint32_t>(chunkBlocks * kListBlock);
  setup.params.chunkParticles = chunk;
  for (uint32_t first = 0; first < count; first += chunk) chunks_.push_back({first, std::min(count, first + chunk)});
  if (chunks_.size() > kMaxListChunks)
    return Error{ErrorKind::TooLarge, "the neighbor list of " + std::to_string(n) + " particles at this smoothing_ratio needs " +
                                          mebibytes(memory.list_bytes) + ", more than the " + std::to_string(kMaxListChunks) +
                                          " buffers of 128 MiB that are available: make smoothing_ratio smaller"};
  const uint64_t maxTexels = std::max({more, 2 * uint64_t{n}, uint64_t{chunk} * p.listCapacity / 4, paddedWords(setup.grid.cells() + 1),
                                       uint64_t{setup.tables.size() / 4}});
  texel_ = !storageReads && usesTexelReads(device, maxTexels);

  auto sort = KeySort::create(
      device, {.count = count, .keyRange = setup.grid.cells(), .start = true, .storageReads = storageReads, .fusedEnds = true});
  if (!sort) return sort.error();
  sort_ = std::move(*sort);

  // 64 bytes stand for what this scene has no use for: a binding must be something.
  const auto bytesIf = [](bool used, uint64_t bytes) { return used ? bytes : uint64_t{64}; };
  const struct {
    Buffer* buffer;
    const char* name;
    uint64_t bytes;
  } table[] = {
      {&buffers_.params, "fluid parameters", sizeof(FluidParams)},
      {&buffers_.control, "fluid control", sizeof(FluidControl)},
      {&buffers_.sums, "fluid sums", sizeof(FluidSums)},
      {&buffers_.shapes, "dispatch shapes", kMaxCommands * 12},
      {&buffers_.commands, "dispatch commands", kMaxCommands * 12},
      {&buffers_.gravity, "gravity schedule", setup.gravity.size() * 4},
      {&buffers_.tables, "wall tables", std::max<uint64_t>(64, setup.tables.size() * 4)},
      {&buffers_.solids, "solids", std::max<uint64_t>(64, setup.solids.size() * sizeof(SolidRecord))},
      {&buffers_.keyframes, "keyframes", std::max<uint64_t>(64, setup.keyframes.size() * 4)},
      {&buffers_.position, "positions", more * 16},
      {&buffers_.velocity, "velocities", more * 16},
      {&buffers_.prediction, "predictions", more * 16},
      {&buffers_.warmAcceleration, "warm pushes", bytesIf(setup.warm, n * 16)},
      {&buffers_.work, "multipliers", more * 16},
      {&buffers_.warm, "warm starts", bytesIf(setup.warm, n * 4)},
      {&buffers_.id, "ids", n * 4},
      {&buffers_.multiplier, "iteration multipliers", bytesIf(p.iterations > 1, n * 4)},
      {&buffers_.neighborCount, "neighbor counts", bytesIf(p.listCapacity > 0, n * 4)},
      {&buffers_.cell, "cells", n * 4},
      {&buffers_.start, "cell starts", paddedWords(setup.grid.cells() + 1) * 4},
      {&buffers_.nearSample, "wall samples", bytesIf(setup.near, n * 32)},
      {&buffers_.nearList, "particles near walls", bytesIf(setup.near, n * 4)},
  };
  for (const auto& row : table) {
    auto buffer = createBuffer(device, row.name, row.bytes);
    if (!buffer) return buffer.error();
    *row.buffer = std::move(*buffer);
    made.push_back({row.name, row.bytes});
  }
  for (const Chunk& c : chunks_) {
    auto list = createBuffer(device, "neighbor list", p.listCapacity == 0 ? 64 : blocks(c.last - c.first) * blockBytes);
    if (!list) return list.error();
    made.push_back({"neighbor list", list->size()});
    buffers_.lists.push_back(std::move(*list));
  }
  return {};
}

Expected<void> FluidImpl::makePipelines(Device& device) {
  using enum BindingKind;
  const FluidParams& p = setup.params;
  const uint32_t kernel = setup.kernel, capacity = p.listCapacity, nearWalls = setup.near, warm = setup.warm;
  // Particles that walk the grid together are a subgroup, of which the shader knows that it is whole.
  const uint32_t whole = std::min(device.info().subgroupSize, kFluidGroup), cluster = std::min(whole, kMaxCluster);
  Expected<void> result;
  const auto make = [&](const ComputePipeline*& out, std::string_view shader, std::vector<BindingKind> bindings, uint32_t push,
                        std::vector<uint32_t> constants = {}, uint32_t subgroup = 0) {
    if (!result) return;
    auto pipeline = computePipeline(
        device,
        {.shader = shader, .bindings = bindings, .pushConstantBytes = push, .constants = constants, .requiredSubgroupSize = subgroup});
    if (pipeline)
      out = *pipeline;
    else
      result = pipeline.error();
  };
  // Arrays that are read: see shaders/shared/arrays.glsl.
  const BindingKind vectors = texel_ ? TexelFloat4 : Storage, words = texel_ ? TexelUint : Storage, quads = texel_ ? TexelUint4 : Storage;
  const auto reading = [&](std::string_view shader) { return std::string(shader) + (texel_ ? "_texel" : ""); };
  // A pass that gathers: two uniform blocks, particles, list, counts, cells, cell starts, sums, and its own.
  const auto gather = [&](GatherPipelines& out, std::string_view shader, std::vector<BindingKind> own, uint32_t push,
                          std::vector<uint32_t> constants = {}) {
    std::vector<BindingKind> bindings{Uniform, Uniform, vectors, quads, words, words, words, Storage};
    bindings.insert(bindings.end(), own.begin(), own.end());
    const std::string name = reading(shader);
    constants.insert(constants.begin(), {kernel, cluster, capacity, 0});
    if (capacity > 0) make(out.list, name, bindings, push, constants, whole);
    constants[3] = 1;
    make(out.walk, name, bindings, push, constants, whole);
  };
  const auto plain = [&](size_t uniforms, size_t n) {
    std::vector<BindingKind> bindings(uniforms, Uniform);
    bindings.insert(bindings.end(), n, Storage);
    return bindings;
  };

  make(pipes_.begin, "fluid/begin", plain(1, 5), sizeof(BeginPush));
  make(pipes_.control, "fluid/control", plain(1, 5), sizeof(ControlPush));
  make(pipes_.finishRebuild, "fluid/finish_rebuild", plain(1, 5), 0);
  make(pipes_.predict, reading("fluid/predict"), {Uniform, Uniform, vectors, vectors, vectors, Storage, Storage}, 0, {warm});
  const auto [oversized, counts] = sort_->counterConstants();
  const std::vector<BindingKind> keyed{Uniform, Uniform, vectors, Storage, Storage, Storage, Storage, Storage};
  make(pipes_.keys, reading("fluid/keys"), keyed, 0, {oversized, counts, 1});
  make(pipes_.measureKeys, reading("fluid/keys"), keyed, 0, {oversized, counts, 0});
  make(pipes_.reorder, reading("fluid/reorder"),
       {Uniform, Uniform, words, words, words, words, vectors, vectors, vectors, words, words, Storage, Storage, Storage}, 0, {warm});
  std::vector<BindingKind> building = plain(2, 16);
  building[2] = building[8] = building[9] = vectors;
  building[6] = words;
  make(pipes_.build, reading("fluid/build"), building, sizeof(ChunkPush), {0, cluster, capacity, nearWalls, warm}, whole);
  if (setup.near) {
    const std::vector<BindingKind> bindings{Uniform, Uniform, vectors, words, Storage, vectors, Storage, Storage};
    make(pipes_.walls.plane, reading("fluid/walls"), bindings, 0, {0, 0, 1});
    make(pipes_.walls.corner, reading("fluid/walls"), bindings, 0, {1, p.solidCount > 0, setup.thin ? 2u : 1u});
  }
  if (p.solidCount > 0) make(pipes_.collide, "fluid/collide", plain(2, 11), 0, {0, warm});
  const bool smooths = setup.viscositySweeps > 0 || p.noiseDampingRate > 0;
  if (p.solidCount > 0 && (smooths || p.vorticity > 0)) make(pipes_.predictAfterTerms, "fluid/collide", plain(2, 11), 0, {1, warm});
  if (setup.movingSolids) make(pipes_.pose, "fluid/pose", plain(2, 2), 0);
  gather(pipes_.density, "fluid/density", {Storage, Storage, vectors, Storage}, sizeof(ChunkPush), {nearWalls, p.iterations > 1, warm});
  const auto correct = [&](GatherPipelines& pipelines, bool parts) {
    gather(pipelines, "fluid/correct", {Storage, Storage, vectors, Storage, Storage, Storage, Storage}, sizeof(ChunkPush),
           {nearWalls, parts, p.solidCount > 0, warm});
  };
  correct(pipes_.correct, false);
  if (p.tensileRate > 0) correct(pipes_.correctWithArtificialPressure, true);
  if (p.iterations > 1) gather(pipes_.iterate, "fluid/iterate", {Storage, vectors}, sizeof(ChunkPush), {nearWalls, p.solidCount > 0});
  if (smooths) gather(pipes_.viscosity, "fluid/viscosity", {vectors, Storage, Storage, vectors, vectors}, sizeof(SweepPush), {warm});
  if (setup.viscositySweeps % 2 == 1 || p.noiseDampingRate > 0)
    make(pipes_.copyVelocity, "fluid/copy_velocity", plain(2, 2), sizeof(ChunkPush));
  if (p.vorticity > 0) {
    gather(pipes_.curl, "fluid/curl", {vectors, Storage}, sizeof(ChunkPush));
    gather(pipes_.confine, "fluid/confine", {vectors, Storage, Storage, vectors, vectors}, sizeof(ChunkPush), {warm});
  }
  make(pipes_.measureOrder, reading("fluid/measure_order"), {Uniform, Uniform, words, words, words, words, vectors, Storage}, 0);
  make(pipes_.measure, reading("fluid/measure"), {Uniform, Uniform, vectors, words, vectors, Storage, Storage, Storage}, 0,
       {kernel, cluster, nearWalls}, whole);
  make(pipes_.measureSums, reading("fluid/measure_sums"), {Uniform, Uniform, vectors, vectors, Storage}, 0);
  make(pipes_.reduce, "fluid/measure_reduce", plain(2, 3), 0);
  return result;
}

Fluid::Fluid(std::unique_ptr<FluidImpl> impl) : impl_(std::move(impl)) {}
Fluid::~Fluid() = default;

Expected<std::unique_ptr<Fluid>> Fluid::create(Device& device, const FluidDesc& desc) {
  auto impl = FluidImpl::create(device, desc);
  if (!impl) return impl.error();
  return std::unique_ptr<Fluid>(new Fluid(std::move(*impl)));
}

FluidState Fluid::addTo(Graph& graph, const FluidStep& step) { return impl_->addTo(graph, step); }

FluidState Fluid::present(Graph& graph) const { return impl_->present(graph); }

std::optional<FluidStats> Fluid::stats() const {
  impl_->poll();
  return impl_->stats;
}

const FluidProgress& Fluid::progress() const {
  impl_->poll();
  return impl_->progress;
}

std::vector<FluidPassRuns> Fluid::passRuns() const {
  impl_->poll();
  return impl_->passRuns();
}

std::array<double, 3> Fluid::drivenCenter(uint32_t solid) const {
  const auto& driven = impl_->setup.driven;
  const auto found = std::find_if(driven.begin(), driven.end(), [solid](const DrivenSolid& d) { return d.solid == solid; });
  std::array<double, 3> center;
  center.fill(std::numeric_limits<double>::quiet_NaN());
  if (found == driven.end()) return center;
  for (size_t a = 0; a < 3; ++a) center[a] = impl_->origin[a] + found->center[a];
  return center;
}

uint32_t Fluid::count() const { return impl_->count; }
uint32_t Fluid::substepsPerBlock() const { return impl_->setup.substepsPerBlock; }
uint32_t Fluid::substepsToComplete() const {
  return substepsPerBlock() * (impl_->setup.params.maxSubsteps + kSettleSubsteps + impl_->setup.params.initialPressureIterations);
}
FluidMemory Fluid::memory() const { return impl_->memory; }
std::span<const FluidBuffer> Fluid::buffers() const { return impl_->made; }
std::span<const std::string> Fluid::warnings() const { return impl_->setup.warnings; }

}  // namespace rill
