#pragma once
// What the shaders need of viscosity: the solve's rate and steps, noise damping in a fluid at rest, and fluid that sticks to what it
// touches.
#include "fluid/settings.hpp"
#include "sph/kernel.hpp"

namespace rill {

void setViscosity(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup);

/// As many steps of the solve as the longest substep asks for where the fluid is somewhat denser than its rest lattice.
void setViscositySteps(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup);

void setNoiseDamping(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup);

/// Nothing of it exists where it has no effect, which a warning says.
void setNoSlip(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup);

/// The dynamic viscosity that damps the shortest waves, particle noise, in a fluid at rest, Pa s; 0 without noise damping.
double artificialViscosity(const Scene& scene);

/// Whether viscous fluid sticks to a solid.
bool sticks(const Scene& scene, const Solid& solid);

}  // namespace rill
