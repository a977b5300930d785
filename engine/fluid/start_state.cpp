// What the device holds before the first step: the scene's records, and the particles of its start or of a snapshot.
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "fluid/fluid_impl.hpp"
#include "fluid/snapshot.hpp"

namespace rill {
namespace {

/// The vectors as four floats each; `last` follows them where there is one.
std::function<void(std::byte*)> quads(std::vector<Float3> vectors, float w, std::optional<Float4> last = {}) {
  return [vectors = std::move(vectors), w, last](std::byte* to) {
    for (const Float3& v : vectors) {
      const Float4 quad{v.x, v.y, v.z, w};
      std::memcpy(to, &quad, sizeof quad);
      to += sizeof quad;
    }
    if (last) std::memcpy(to, &*last, sizeof *last);
  };
}

template <class T>
std::function<void(std::byte*)> bytesOf(std::vector<T> values) {
  return [values = std::move(values)](std::byte* to) { std::memcpy(to, values.data(), values.size() * sizeof(T)); };
}

}  // namespace

void FluidImpl::stageScene() {
  staging_.emplace();
  std::vector<uint32_t> shapes(3 * kMaxCommands, 0);
  const auto shape = [&](uint32_t command, GroupCount groups) { std::copy(groups.begin(), groups.end(), shapes.begin() + 3 * command); };
  const GroupCount all = foldGroups(divideUp(count, kFluidGroup));
  const GroupCount chunk = foldGroups(chunks_.front().groups());
  for (uint32_t k : {kCommandPredict, kCommandKeys, kCommandReorder}) shape(k, all);
  for (uint32_t k : {kCommandDensity, kCommandCorrect, kCommandCorrect + 1, kCommandIterate, kCommandNoiseDamping, kCommandBuild})
    shape(k, chunk);
  for (uint32_t k = kCommandWalks; k < kCommandSort; ++k) shape(k, chunk);
  shape(kCommandPose, {1, 1, 1});
  uint32_t next = kCommandSort;
  for (const GroupCount& groups : sort_->groups()) shape(next++, groups);
  assert(next <= kMaxCommands);

  staging_->add(buffers_.params, &setup.params, sizeof setup.params);
  staging_->add(buffers_.shapes, shapes.size() * 4, bytesOf(shapes));
  staging_->add(buffers_.gravity, setup.gravity.data(), setup.gravity.size() * 4);
  staging_->add(buffers_.tables, setup.tables.data(), setup.tables.size() * 4);
  staging_->add(buffers_.keyframes, setup.keyframes.data(), setup.keyframes.size() * 4);
  staging_->clear(buffers_.commands);
}

void FluidImpl::stageParticles(std::vector<Float3> positions, std::vector<Float3> velocities) {
  const Float4 dummy{kInactivePosition, kInactivePosition, kInactivePosition, 0.0f};
  staging_->add(buffers_.position, buffers_.position.size(), quads(std::move(positions), 0.0f, dummy));
  staging_->add(buffers_.velocity, buffers_.velocity.size(), quads(std::move(velocities), 1.0f, Float4{0, 0, 0, 1}));
  // Predictions start as the positions; they and `work` end with the dummy neighbor.
  staging_->addSame(buffers_.prediction, buffers_.position);
  staging_->addSame(buffers_.work, buffers_.position);
}

void FluidImpl::stageStart(const ParticleSet& particles, bool settle) {
  std::vector<Float3> positions = particles.positions, velocities = particles.velocities;
  std::vector<uint32_t> id(count);
  FluidSums sums{};
  float fastest = 0;
  for (uint32_t i = 0; i < count; ++i) {
    Float3 &x = positions[i], &v = velocities[i];
    const float speed = speedOf(v);
    const bool good = finite(x) && std::isfinite(speed);  // a speed that overflows would make every step 0
    if (!good) {
      ++sums.nonFinite;
      x = {kInactivePosition, kInactivePosition, kInactivePosition};
      v = {};
    }
    if (good) fastest = std::max(fastest, speed);
    id[i] = i;
  }
  sums.speedMax = std::bit_cast<uint32_t>(fastest);

  FluidControl control{};
  control.listState = kListNone;
  control.speed = fastest;
  control.nextPhase = settle ? kPhaseSettling : kPhaseAdvancing;
  control.phaseLeft = settle ? kSettleSubsteps : 0;
  control.head = static_cast<float>(setup.head);
  control.desiredStep = static_cast<float>(setup.firstStep);

  stageParticles(std::move(positions), std::move(velocities));
  staging_->add(buffers_.control, sizeof control, bytesOf(std::vector{control}));
  staging_->add(buffers_.sums, sizeof sums, bytesOf(std::vector{sums}));
  staging_->add(buffers_.solids, setup.solids.data(), setup.solids.size() * sizeof(SolidRecord));
  staging_->add(buffers_.id, id.size() * 4, bytesOf(id));
  staging_->clear(buffers_.warm);
  staging_->clear(buffers_.warmAcceleration);
}

// `snapshot` has been checked; it lives until the staging is made.
void FluidImpl::stageSnapshot(const FluidSnapshot& s) {
  resumed_ = true;
  stageParticles(s.position, s.velocity);
  staging_->add(buffers_.control, s.control.data(), s.control.size() * 4);
  staging_->add(buffers_.sums, s.sums.data(), s.sums.size() * 4);
  std::vector<SolidRecord> solids = setup.solids;
  for (size_t k = 0; 6 * k < s.solids.size(); ++k) {
    const float* six = s.solids.data() + 6 * k;
    solids[k].centerX = six[0];
    solids[k].centerY = six[1];
    solids[k].centerZ = six[2];
    solids[k].velocityX = six[3];
    solids[k].velocityY = six[4];
    solids[k].velocityZ = six[5];
  }
  for (DrivenSolid& driven : setup.driven) std::copy_n(s.solids.data() + 6 * driven.solid, 3, driven.center);
  staging_->add(buffers_.solids, solids.size() * sizeof(SolidRecord), bytesOf(solids));
  staging_->add(buffers_.id, s.id.data(), s.id.size() * 4);
  if (setup.warm && s.warm.empty()) {
    staging_->clear(buffers_.warm);
    staging_->clear(buffers_.warmAcceleration);
  } else if (setup.warm) {
    staging_->add(buffers_.warm, s.warm.data(), s.warm.size() * 4);
    staging_->add(buffers_.warmAcceleration, s.push.size() * 16, bytesOf(s.push));
  }
  if (setup.near) {
    staging_->add(buffers_.nearList, uint64_t{count} * 4, [this, &s](std::byte* to) {
      std::memset(to, 0, size_t{count} * 4);
      std::memcpy(to, s.nearWall.data(), s.nearWall.size() * 4);
      std::memcpy(to + 4 * (count - s.nearMore.size()), s.nearMore.data(), s.nearMore.size() * 4);
    });
    staging_->clear(buffers_.nearSample);  // of those near nothing; the others' are looked up before they are used
  }
  if (!hasNeighbors(s)) return;
  if (!s.cell.empty()) {
    staging_->add(buffers_.cell, s.cell.data(), s.cell.size() * 4);
    std::vector<uint32_t> start(setup.grid.cells() + 1);
    cellStarts(s.cell, start);
    staging_->add(buffers_.start, start.size() * 4, bytesOf(start));
  }
  staging_->add(buffers_.neighborCount, s.neighborCount.data(), s.neighborCount.size() * 4);
  if (s.listCapacity == 0) return;
  for (size_t c = 0; c < chunks_.size(); ++c)
    staging_->add(buffers_.lists[c], buffers_.lists[c].size(), [this, &s, c, bytes = buffers_.lists[c].size()](std::byte* to) {
      std::vector<uint32_t> list(bytes / 4, count);
      layOutList(s, chunks_[c].first, chunks_[c].last, list);
      std::memcpy(to, list.data(), bytes);
    });
}

}  // namespace rill
