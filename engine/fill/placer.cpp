#include "fill/placer.hpp"

#include <algorithm>

#include "fill/walls.hpp"

namespace rill {
namespace {

constexpr double kCoincident = 1e-3;  // spacings: closer particles of one file are coincident

/// A deterministic pseudorandom number in [-1, 1): the finalizer of splitmix64 (Steele et al. 2014) over its arguments.
double randomSigned(uint64_t seed, uint64_t fill, uint64_t particle, uint64_t axis) {
  uint64_t h = seed;
  for (const uint64_t part : {fill, particle, axis}) {
    h += 0x9E3779B97F4A7C15ULL + part;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

void ParticlePlacer::add(const Double3& p, const Float3& velocity, size_t fill, uint64_t number, uint8_t fluid, FillSource& source,
                         const Float4* mixed) {
  const double jitter = scene_.fill[fill].jitter * spacing_;
  Double3 at, lattice;
  for (int axis = 0; axis < 3; ++axis) {
    lattice[axis] = p[axis] - out_.origin[axis];
    at[axis] = jitter > 0 ? p[axis] + jitter * randomSigned(scene_.seed, fill, number, static_cast<uint64_t>(axis)) : p[axis];
  }
  if (beyondWall(scene_.domain, at, kWallSlack * spacing_)) {
    ++source.domain;
  } else if (solids_.contain(at, kWallSlack * spacing_)) {
    ++source.solid;
  } else if (placed_ != nullptr &&
             placed_->overlaps(lattice, static_cast<uint32_t>(fill), kFillOverlap * spacing_ * (1 - kWallSlack), kCoincident * spacing_)) {
    ++source.overlap;
  } else {
    if (placed_ != nullptr) placed_->insert(lattice, static_cast<uint32_t>(fill));
    ++source.kept;
    out_.positions.push_back(relative(at));
    out_.velocities.push_back(velocity);
    if (!scene_.fluids.empty()) out_.fluids.push_back(fluid);
    if (mixes_) out_.concentrations.push_back(mixed != nullptr ? *mixed : unmixed(std::span<const size_t>(diffusing_), fluid));
  }
}

Float3 ParticlePlacer::relative(const Double3& p) const {
  float r[3];
  for (int axis = 0; axis < 3; ++axis) {
    r[axis] = static_cast<float>(p[axis] - out_.origin[axis]);
    if (!scene_.domain) continue;
    if (isClosed(*scene_.domain, 2 * axis)) r[axis] = std::max(r[axis], 0.0F);
    if (isClosed(*scene_.domain, 2 * axis + 1))
      r[axis] = std::min(r[axis], static_cast<float>(scene_.domain->max[axis] - scene_.domain->min[axis]));
  }
  return {r[0], r[1], r[2]};
}

void placeFill(const Scene& scene, size_t index, FillSource& source, ParticlePlacer& placer) {
  const Fill& fill = scene.fill[index];
  const Float3 velocity{static_cast<float>(fill.velocity[0]), static_cast<float>(fill.velocity[1]), static_cast<float>(fill.velocity[2])};
  const auto fluid = static_cast<uint8_t>(fluidIndex(scene, fill.fluid));
  if (source.file) {
    const PlyParticles& from = source.particles;
    for (size_t i = 0; i < from.positions.size(); ++i) {
      const Float3 own = from.velocities.empty() ? Float3{} : from.velocities[i];
      placer.add({from.positions[i].x, from.positions[i].y, from.positions[i].z},
                 {own.x + velocity.x, own.y + velocity.y, own.z + velocity.z}, index, i, from.fluids.empty() ? fluid : from.fluids[i],
                 source, from.concentrations.empty() ? nullptr : &from.concentrations[i]);
    }
    return;
  }
  const Lattice& lattice = source.lattice;
  const auto nx = static_cast<uint64_t>(lattice.size[0]), ny = static_cast<uint64_t>(lattice.size[1]),
             nz = static_cast<uint64_t>(lattice.size[2]);
  for (uint64_t k = 0; k < nz; ++k) {
    for (uint64_t j = 0; j < ny; ++j) {
      for (const Run& run : rowOf(lattice, j, k)) {
        for (uint64_t i = run.begin; i < run.end; ++i) {
          const Double3 p = {lattice.first[0] + static_cast<double>(i) * lattice.spacing,
                             lattice.first[1] + static_cast<double>(j) * lattice.spacing,
                             lattice.first[2] + static_cast<double>(k) * lattice.spacing};
          placer.add(p, velocity, index, (k * ny + j) * nx + i, fluid, source);
        }
      }
    }
  }
}

}  // namespace rill
