#pragma once
// Reference settings of a scene, equal to the device's.
#include "fluid/settings.hpp"
#include "reference/solver.hpp"

namespace rill::reference {

/// `setup`: of makeFluidSetup() for this scene. `origin`: of the positions in scene coordinates, m. Solids do not use the shaders' tables.
ReferenceSettings settingsOf(const Scene& scene, const FluidSetup& setup, const Double3& origin);

}  // namespace rill::reference
