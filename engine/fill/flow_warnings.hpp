#pragma once
// What emitters, drains, inflow and outflow of a scene cannot do as they are given.
#include <cstdint>
#include <string>
#include <vector>

#include "rill/scene.hpp"

namespace rill {

/// A message for each, which begins with its key: mouths that are blocked at the start, never open, overlap or whose fluid is drained at
/// once, drains that nothing can reach, levels below a layer, and a closed domain that overflows. The scene has a spacing; `filled`:
/// particles at the start.
std::vector<std::string> flowWarnings(const Scene& scene, uint64_t filled);

}  // namespace rill
