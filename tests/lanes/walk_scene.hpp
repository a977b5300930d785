// Particles around the seams of a small wrapped grid, sorted by cell as the solver sorts them, and the shaders that walk the grid on them.
#pragma once
#include <string>
#include <vector>

#include "gpu/shader_library.hpp"
#include "lanes/subgroup.hpp"
#include "shared/fluid_records.h"

namespace rill::lanes {

constexpr uint32_t kListCapacity = 16;

struct WalkScene {
  WalkScene();
  FluidParams params{};
  std::vector<std::array<float, 4>> particles;  ///< m, sorted; w: the number as numberFromFloat() reads it; the dummy is the last
  std::vector<uint32_t> keys, cellStart;

  uint32_t count() const { return static_cast<uint32_t>(particles.size() - 1); }
  /// By comparing all pairs: neighbors within `distance` (m) of an active particle, none of others.
  std::vector<uint32_t> neighborsOf(uint32_t i, float distance) const;
  /// Density over rest density, in double precision, from all pairs.
  double densityOf(uint32_t i) const;
};

struct Outcome {
  std::map<std::string, std::vector<uint32_t>> arrays;  ///< by their names in the shader
  uint64_t strayShuffles = 0;
};

/// Runs all workgroups of a shader that walks the grid.
Outcome walk(const WalkScene& scene, const EmbeddedShader& shader, uint32_t subgroupSize, uint32_t cluster, Rules rules, uint32_t seed);

}  // namespace rill::lanes
