#pragma once
// Several fluids, as the solver sees them: masses and viscosities over the largest ones.
#include "rill/scene.hpp"
#include "rill/vectors.hpp"
#include "shared/fluid_records.h"
#include "sph/interface_tension.hpp"
#include "sph/shear_viscosity.hpp"

namespace rill {

struct FluidSetup;

Rheology rheologyOf(const ResolvedFluid& fluid);

double densestFluid(const Scene& scene);                ///< kg/m^3
double largestViscosity(const Scene& scene);            ///< Pa s; at any rate of shear
double largestKinematicViscosity(const Scene& scene);   ///< m^2/s; likewise
double smallestKinematicViscosity(const Scene& scene);  ///< m^2/s, of a fluid at rest
bool hasShearViscosity(const Scene& scene);             ///< whether shear changes the viscosity of a fluid
double largestTension(const Scene& scene);              ///< surface tension, N/m
double largestKinematicTension(const Scene& scene);     ///< what asks for the shortest step: tension over density, m^3/s^2

/// m_ab of sph/interface_tension.hpp.
InterfaceCover interfaceCover(const Scene& scene);
bool hasInterfaces(const Scene& scene);  ///< some fluids have tension between them

/// The fluid whose tension moves particles of fluid k the fastest: its own, or one that it has an interface with; and that tension over
/// the density of fluid k, m^3/s^2.
struct KinematicTension {
  size_t fluid = 0;
  double value = 0;
};
KinematicTension kinematicTension(const std::vector<ResolvedFluid>& fluids, const InterfaceCover& cover, size_t k);

/// The least difference of two fluids' densities over the larger of them; 1 where all are the same. With gravity it drives flows.
double leastDensityDifference(const Scene& scene);

/// The largest product of a fluid's inverse mass and viscosity, each over that of the densest and of the most viscous fluid: at least 1 if
/// any is viscous, else 0. It multiplies FluidParams::viscosityRate.
double fastestViscosity(const Scene& scene);

/// Concentrations in a particle of one fluid that has not mixed, as shaders/fluid/fluids.glsl has them.
Float4 unmixed(const FluidParams& params, uint8_t fluid);

/// Sets FluidSetup::shearViscosity, and what shaders need of fluids whose viscosity shear changes. Without one there is nothing.
void addShearViscosity(const Scene& scene, FluidSetup& setup);

/// Of a flow index without viscosity, and of diffusion in one fluid.
void warnOfKeysWithoutEffect(const Scene& scene, FluidSetup& setup);

/// Sets FluidSetup::fluids and what shaders need of several fluids, and warns of density ratios beyond 1000. With one there is nothing.
void addFluids(const Scene& scene, FluidSetup& setup);

}  // namespace rill
