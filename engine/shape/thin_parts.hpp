#pragma once
// Parts of a mesh that are too thin for a fluid to notice.
#include <cstddef>
#include <optional>

#include "rill/mesh.hpp"

namespace rill {

struct ThinPart {
  Double3 place = {0, 0, 0};  ///< on the surface, m, in the mesh's frame
  double thickness = 0;       ///< m, along the normal there
  size_t triangles = 0;       ///< all that have a thin part behind their middle
};

/// Where a closed mesh is thinnest, if that is less than `limit` (m). None for a sheet.
std::optional<ThinPart> thinnestPart(const Mesh& mesh, double limit);

}  // namespace rill
