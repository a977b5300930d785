#pragma once
#include "fluid/settings.hpp"

namespace rill {

/// Sets what the shaders need of surface tension, and the longest step that it is stable at. Without tension, nothing.
void addTension(const Scene& scene, FluidSetup& setup);

}  // namespace rill
