#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

/// The scene dam50k with about `count` particles. The spacing divides the box exactly, so that no particle overlaps a wall.
Expected<Scene> tank(uint32_t count, std::vector<Override> changes = {});

/// The number of particles of a scene that tank() made, without making them.
uint64_t tankParticles(const Scene& scene);

}  // namespace rill::bench
