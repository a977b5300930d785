// What a fluid needs, its buffers and its pipelines.
#include "rill/fluid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/words.hpp"
#include "fill/fill_messages.hpp"
#include "fluid/flows.hpp"
#include "fluid/fluid_impl.hpp"
#include "fluid/room.hpp"
#include "fluid/snapshot.hpp"
#include "gpu/device_impl.hpp"
#include "gpu/texel_reads.hpp"
#include "shared/surface_tension.h"

namespace rill {
namespace {

static_assert(kMaxParticles == KeySortDesc::kMaxCount);

uint64_t blocks(uint64_t particles) { return divideUp(particles, kListBlock); }

/// All but positions and velocities, whose numbers may be anything.
Expected<void> checkGiven(const FluidDesc& desc) {
  const auto bad = [](std::string what) { return Error{ErrorKind::BadInput, std::move(what)}; };
  if (!desc.scene) return bad("FluidDesc::scene is null; expected a scene");
  if (!desc.particles) return bad("FluidDesc::particles is null; expected what makeParticles() makes, or a set of the host's own");
  const size_t n = desc.particles->positions.size(), velocities = desc.particles->velocities.size();
  if (velocities != n)
    return bad("a fluid needs as many velocities as positions: " + std::to_string(velocities) + " for " + std::to_string(n));
  const std::vector<uint8_t>& fluids = desc.particles->fluids;
  if (!fluids.empty() && fluids.size() != n)
    return bad("ParticleSet::fluids has " + std::to_string(fluids.size()) + " entries; expected none or one for each of " +
               std::to_string(n) + " positions");
  if (const size_t count = resolvedFluids(*desc.scene).size(); !fluids.empty() && *std::ranges::max_element(fluids) >= count)
    return bad("ParticleSet::fluids has index " + std::to_string(*std::ranges::max_element(fluids)) + "; expected one below " +
               std::to_string(count) + ", the number of the scene's fluids");
  const std::vector<Float4>& mixed = desc.particles->concentrations;
  if (mixed.size() > n)
    return bad("ParticleSet::concentrations has " + std::to_string(mixed.size()) + " entries; expected at most one for each of " +
               std::to_string(n) + " positions");
  for (size_t i = 0; i < mixed.size(); ++i)
    for (const float share : {mixed[i].x, mixed[i].y, mixed[i].z, mixed[i].w})
      if (!(share >= 0 && share <= 1))
        return bad("ParticleSet::concentrations has " + shortestNumber(share) + " in entry " + std::to_string(i) +
                   "; expected numbers from 0 to 1");
  for (const double v : desc.particles->origin)
    if (!(std::abs(v) <= std::numeric_limits<float>::max()))
      return bad("ParticleSet::origin is " + shortestNumber(v) + "; expected numbers (m) that a 32-bit float can hold");
  if (auto valid = checkScene(*desc.scene); !valid) return valid;
  const double own = desc.particles->spacing, scenes = desc.scene->fluid.spacing;
  if (!(own >= 0 && std::isfinite(own)) || (own > 0 && scenes > 0 && own != scenes))
    return bad("ParticleSet::spacing is " + shortestNumber(own) + "; expected " +
               (scenes > 0 ? "the scene's fluid.spacing, " + shortestNumber(scenes) + " (m)" : "a length above 0 (m)"));
  return {};
}

}  // namespace

FluidMemory fluidMemory(const Scene& scene, uint64_t particles) { return memoryOf(arrayShape(scene, particles)); }

Expected<std::unique_ptr<FluidImpl>> FluidImpl::create(Device& device, const FluidDesc& desc) {
  if (auto given = checkGiven(desc); !given) return given.error();
  if (auto able = checkClusters(device); !able) return able.error();
  const ParticleSet& particles = *desc.particles;
  Scene scene = *desc.scene;
  if (particles.spacing > 0) scene.fluid.spacing = particles.spacing;
  const uint64_t n = particles.positions.size(), wanted = desc.capacity > 0 ? desc.capacity : capacityOf(scene, n);
  const uint64_t capacity = std::max({wanted, n, uint64_t{bodyCount(scene) > 0 || removes(scene)}});
  auto impl = std::make_unique<FluidImpl>();
  impl->device_ = &implOf(device);
  impl->memory = fluidMemory(scene, capacity);
  const char* remedy = desc.capacity > 0 || capacity == n ? "make fluid.spacing larger or fluid.particles smaller"
                       : scene.fluid.capacity > 0         ? "make fluid.capacity smaller"
                                                          : "set fluid.capacity to that or less; emitters, which ask for the others, wait "
                                                            "while it is full";
  if (auto fits = checkRoom(device, scene, capacity, remedy); !fits) return fits.error();

  StartFigures start{.capacity = static_cast<uint32_t>(capacity)};
  Double3 low = {0, 0, 0}, high = {0, 0, 0};
  bool any = false;
  for (size_t i = 0; i < n; ++i) {
    const Float3 &x = particles.positions[i], &u = particles.velocities[i];
    if (!finite(x)) continue;
    if (const float speed = speedOf(u); std::isfinite(speed)) start.fastest = std::max<double>(start.fastest, speed);
    const Double3 v = {x.x, x.y, x.z};
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
  for (std::string& warning : impl->setup.warnings) warning.insert(0, scenePrefix(scene));
  impl->setup.loads = !scene.solids.empty() && (desc.loads || measuresLoads(scene));
  if (impl->setup.loads) impl->solidLoads.resize(scene.solids.size());
  const bool allLoads = desc.loads || probesLoads(scene);
  for (SolidRecord& solid : impl->setup.solids) solid.holdsAwake = allLoads || solid.keyCount > 0 || solid.body != kNoBody ? 1 : 0;
  impl->pressures.resize(impl->setup.pressureProbes.size());
  impl->takePressures(std::as_bytes(std::span(impl->setup.pressureProbes)));
  impl->setup.mergesPasses = desc.mergePasses.value_or(!impl->device_->isCpu);
  impl->capacity = static_cast<uint32_t>(capacity);
  impl->count = static_cast<uint32_t>(desc.snapshot ? desc.snapshot->id.size() : n);
  impl->origin = particles.origin;
  impl->emitted.resize(impl->setup.emitters.size());
  impl->drained.resize(impl->setup.drains.size());
  impl->bodyRecords = impl->setup.bodies;
  impl->bodyMotions.resize(impl->bodyRecords.size());
  impl->takeBodies(std::as_bytes(std::span(impl->setup.bodies)));

  if (desc.snapshot)
    if (auto fits = checkSnapshot(*desc.snapshot, snapshotShape(impl->setup)); !fits) return fits.error();

  if (impl->capacity == 0) return impl;
  if (auto ok = impl->makeBuffers(device, desc.storageReads); !ok) return ok.error();
  if (auto ok = impl->preparePasses(device); !ok) return ok.error();
  impl->stageScene();
  if (desc.snapshot)
    impl->stageSnapshot(*desc.snapshot);
  else
    impl->stageStart(particles, desc.settle);
  if (auto ok = impl->staging_->make(device); !ok) return ok.error();
  return impl;
}

Expected<void> FluidImpl::makeBuffers(Device& device, bool storageReads) {
  const uint64_t n = capacity, more = n + 1;
  const FluidParams& p = setup.params;

  const uint64_t blockBytes = uint64_t{kListBlock} * p.listCapacity * kListEntryBytes;
  const uint64_t chunkBlocks = divideUp(blocks(n), listChunks(device.info(), arrayShape(setup)));
  const uint32_t chunk = p.listCapacity == 0 ? capacity : static_cast<uint32_t>(chunkBlocks * kListBlock);
  setup.params.chunkParticles = chunk;
  for (uint32_t first = 0; first < capacity; first += chunk) chunks_.push_back({first, std::min(capacity, first + chunk)});
  static_assert(kMaxListChunks <= kMaxSurfaceChunks);
  assert(chunks_.size() <= kMaxListChunks);  // checkRoom()
  const uint64_t maxTexels =
      std::max({p.tensionRate > 0 ? n + kMaxSurfaceChunks : more, uint64_t{chunk} * p.listCapacity / 4, paddedWords(keyRange(setup) + 1),
                uint64_t{setup.tables.size() / 4}, uint64_t{setup.meshWords.size()}});
  texel_ = !storageReads && usesTexelReads(device, maxTexels);

  auto sort = KeySort::create(
      device, {.count = capacity, .keyRange = keyRange(setup), .start = true, .storageReads = storageReads, .fusedEnds = true});
  if (!sort) return sort.error();
  sort_ = std::move(*sort);

  const ArrayShape shape = arrayShape(setup);
  const auto add = [&](const ArrayRow& row, uint32_t c, uint64_t bytes) -> Expected<void> {
    auto created = createBuffer(device, row.label, bytes);
    if (!created) return created.error();
    buffers_[slotOf(row.id, c)] = std::move(*created);
    made.push_back({row.label, bytes});
    return {};
  };
  for (const ArrayRow& row : arrayTable()) {
    if (row.lifetime != Lifetime::Fluid) continue;
    const bool lists = row.id == FluidArray::List && shape.lists;
    for (uint32_t c = 0; c < (lists ? chunkCount() : 1); ++c)
      if (auto ok = add(row, c, lists ? blocks(chunks_[c].last - chunks_[c].first) * blockBytes : arrayBytes(row.id, shape)); !ok)
        return ok;
  }
  return {};
}

}  // namespace rill
