#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rill/vectors.hpp"

namespace rill {

/// Splits a polygon of at least three corners into triangles that keep its direction: a fan if it is convex, else by clipping ears.
/// Corners that no ear removes (a polygon that meets itself, or has more than kMaxClippedCorners) become a fan, which encloses the
/// same volume. `triangles`: replaced, indices of corners.
void triangulate(std::span<const Double3> corners, std::vector<std::array<uint32_t, 3>>& triangles);

inline constexpr size_t kMaxClippedCorners = 256;  ///< clipping takes time with the cube of the corners

}  // namespace rill
