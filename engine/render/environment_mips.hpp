#pragma once
// Prefiltered levels of an environment map, for directions that a pixel or a rough surface mixes.
#include <cstdint>
#include <vector>

#include "rill/environment.hpp"

namespace rill {

/// All levels one after the other, from the picture's own to that of a single row: each has half as many rows (rounded down) and twice as
/// many columns as rows. A texel is the mean over its solid angle, so that every level has the mean of the picture.
std::vector<uint32_t> environmentLevels(const EnvironmentPicture& picture);

/// Removes the finest levels until the rest has at most `maxBytes`. Returns the rows of the first one that is left.
uint32_t dropFineLevels(std::vector<uint32_t>& levels, uint32_t rows, uint64_t maxBytes);

}  // namespace rill
