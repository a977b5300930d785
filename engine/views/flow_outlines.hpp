#pragma once
// Outlines of mouths, drains, and the outflow's crest.
#include <vector>

#include "rill/scene.hpp"
#include "views/particle_records.h"

namespace rill {

/// Lines relative to `origin` (m). Those of mouths that move name entries of `keyframes`, which are appended.
std::vector<particle_view::LineRecord> flowOutlines(const Scene& scene, const Double3& origin, std::vector<KeyframeRecord>& keyframes);

}  // namespace rill
