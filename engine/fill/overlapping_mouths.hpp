#pragma once
#include <string>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

/// Warnings "emitters[1]: ..." about mouths without motion that overlap another's while both are open: their fluid is in the same place.
/// `spacing`: m.
std::vector<std::string> overlappingMouths(const Scene& scene, double spacing);

}  // namespace rill
