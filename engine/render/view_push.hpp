#pragma once
// A camera as push constants.
#include "render/surface_records.h"
#include "rill/fluid_renderer.hpp"

namespace rill {

/// Element of a row and a column.
inline double element(const Float4x4& matrix, int row, int column) {
  const Float4& c = matrix.column[column];
  return double{row == 0 ? c.x : row == 1 ? c.y : row == 2 ? c.z : c.w};
}

/// For positions that are stored relative to `origin`. `view` has passed checkView().
surface::SurfacePush viewPush(const FluidView& view, const Double3& origin);

}  // namespace rill
