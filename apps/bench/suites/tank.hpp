#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

/// The water of the scene dam50k in about `count` particles: as many layers as fill its box exactly, so that none overlaps a wall.
Expected<Scene> tank(uint32_t count, std::vector<Override> changes = {});

}  // namespace rill::bench
