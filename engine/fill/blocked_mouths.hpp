#pragma once
#include <string>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

/// Warnings "emitters[0]: ..." about mouths that are blocked at the start: wholly inside solids or outside the domain's walls.
/// `spacing`: of the fluid, m.
std::vector<std::string> blockedMouths(const Scene& scene, double spacing);

}  // namespace rill
