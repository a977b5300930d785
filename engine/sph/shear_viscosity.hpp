#pragma once
// Fluids whose viscosity depends on the rate of shear: those of Herschel and Bulkley (1926). See docs/notes/viscosity.md.

namespace rill {

/// The shear stress is  yieldStress + consistency rate^flowIndex,  with  rate = sqrt(2 D : D)  for the strain rate D.
struct Rheology {
  double consistency = 0;  ///< Pa s^n
  double yieldStress = 0;  ///< Pa
  double flowIndex = 1;    ///< n
};

/// Whether shear changes the viscosity.
bool isShearDependent(const Rheology& rheology);

/// Shear stress over rate, Pa s. `rate`, 1/s, is taken as at least kMinShearRate and at most kMaxShearRate (shared/shear_viscosity.h).
double viscosityAt(const Rheology& rheology, double rate);

/// At any rate, Pa s.
double largestViscosity(const Rheology& rheology);

/// The largest bound of eigenvalues that the solve for viscosity reaches with this many steps.
double reachedBound(unsigned steps);

}  // namespace rill
