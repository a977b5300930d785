#pragma once
// What the reference solver is given. Lengths in m.
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "reference/bodies.hpp"
#include "reference/emitters.hpp"
#include "rill/scene.hpp"
#include "sph/interface_tension.hpp"

namespace rill::reference {

/// One of several fluids.
struct ReferenceFluid {
  double density = 1000;      ///< kg/m^3, > 0
  double viscosity = 0;       ///< Pa s, >= 0; of one that shear changes, its consistency, Pa s^n
  double yieldStress = 0;     ///< Pa, >= 0
  double flowIndex = 1;       ///< n
  double surfaceTension = 0;  ///< against air, N/m, >= 0
  double diffusion = 0;       ///< m^2/s, >= 0, in the others
};

/// All coefficients, explicitly; there is no "auto".
struct ReferenceSettings {
  KernelChoice kernel = KernelChoice::Wendland;
  double spacing = 0.05;               ///< d, m, > 0
  double smoothingRatio = 2;           ///< h / d, 1.2 .. 4
  double density = 1000;               ///< rho0, kg/m^3, > 0; of the densest of several fluids
  glm::dvec3 gravity = {0, -9.81, 0};  ///< m/s^2

  glm::dvec3 lo = glm::dvec3(-std::numeric_limits<double>::infinity());  ///< m, walls; -infinity: open
  glm::dvec3 hi = glm::dvec3(std::numeric_limits<double>::infinity());   ///< m, walls; infinity: open
  int outflowAxis = -1;                   ///< of the side that is a wall up to a level only; negative: every wall is whole
  bool outflowHigh = false;               ///< it is the high one
  double outflowLevel = 0;                ///< m, along y
  glm::dvec3 origin = {0, 0, 0};          ///< m, origin of the positions in scene coordinates
  std::vector<Solid> solids;              ///< in scene coordinates; should not overlap each other or walls, since densities add up
  std::vector<EmitterSettings> emitters;  ///< nothing is born, but open mouths act on fluid beside them: see mouths.hpp
  bool tabulated = false;                 ///< use the shaders' tables for solids instead of lattice sums

  int iterations = 1;         ///< Jacobi iterations per substep, >= 1
  double relaxation = 0.5;    ///< omega in motion, > 0 .. 2
  double regularization = 0;  ///< eps, a fraction of D_rest, >= 0
  double warmStart = 0.01;    ///< kappa in motion, 0 .. 0.5
  double momentum = 0;        ///< of a multiplier's change in motion, what is added to the next in a block of substeps, 0 .. 0.5
  double warmRelease = 1.5;   ///< factor on kappa where the density is below rest density

  double motionSpeed = 0;  ///< speed of the flow (FluidControl::flowSpeed), m/s, from which on omega and kappa are those above; 0: always
  double relaxationAtRest = 0;  ///< omega at rest; interpolated by the fourth power of the speed
  double warmStartAtRest = 0;   ///< kappa at rest
  double startTime = 0;         ///< s, time() at the beginning
  double meltingTime = 0;      ///< s, in which the scale of the density goes from the lattice's to liquidScale(); 0: it stays the lattice's
  double viscosityAtRest = 0;  ///< noise damping: viscosity at rest in addition to `viscosity`, Pa s; 0 at motionSpeed
  double sparedFlow = 0;       ///< m/s: noise damping is half where neighbors have this mean speed, less where more; 0: all have it
  double travelLimit = std::numeric_limits<double>::infinity();  ///< m that the fastest particle in motion moves before a block ends
  int substepsPerBlock = 1;  ///< noise damping is applied once per block of this many substeps; momentum not in its first

  double tensile = 0;           ///< strength of the artificial pressure, 0 .. 1; see sph/artificial_pressure.hpp
  double tensileRadius = 0.25;  ///< delta q / h
  double tensilePower = 16;     ///< n

  std::vector<ReferenceFluid> fluids;                           ///< empty: one
  double viscosity = 0;                                         ///< mu, Pa s; the largest of several fluids
  bool shearViscosity = false;                                  ///< shear changes that of some of `fluids`, given for one, too
  double shearBound = std::numeric_limits<double>::infinity();  ///< of the eigenvalues of its solve: the viscosity is bounded by it
  int viscositySteps = 0;                                       ///< of its solve, at most, as the shaders take them; 0: solved exactly
  int diffusionStages = 0;                                      ///< of a step, at most, as the shaders take them; 0: very short steps
  bool noSlipWalls = false;                                     ///< viscous fluid sticks to the walls
  double vorticity = 0;                                         ///< eps_v, 0 .. 1
  double surfaceTension = 0;                                    ///< against air, N/m, >= 0; of one fluid
  double wettingCosine = 0;                                     ///< cosine of the contact angle
  InterfaceCover cover = wholeCover();                          ///< of samples of one fluid by particles of another
  double drag = 0;                                              ///< 1/s
  double separationSpeed = 0;                                   ///< m/s, at which bodies that overlap come apart, at most
  std::vector<Pull> pulls;                                      ///< of bodies, from the next prediction on
  double speedLimit = std::numeric_limits<double>::infinity();  ///< largest speed after a substep, m/s
  double warmLimit = std::numeric_limits<double>::infinity();   ///< m^2/s^2: w >= -warmLimit dt^2
  /// The last correction may add at most clamp(half of the largest speed or five times that of a body, minSpeedGain, maxSpeedGain) + 4 g dt
  /// to the speed of a particle; what solids, walls and earlier corrections push it by, that much more than their approach. m/s.
  double minSpeedGain = std::numeric_limits<double>::infinity();
  double maxSpeedGain = std::numeric_limits<double>::infinity();
  double solidSpeed = 0;  ///< m/s, of the fastest solid that keyframes move
};

}  // namespace rill::reference
