#include "fluid/viscosity.hpp"

#include <algorithm>
#include <cmath>

#include "core/words.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "model/scene_facts.hpp"
#include "shared/shear_viscosity.h"
#include "shared/viscosity_steps.h"
#include "sph/shear_viscosity.hpp"
#include "sph/viscosity.hpp"

namespace rill {
namespace {

// Of a fluid at rest, over density x spacing x sqrt(g spacing).
constexpr double kArtificialViscosity = 1;

// XSPH coefficient a second that a dynamic viscosity (Pa s) asks for.
double xsphRate(double viscosity, const Scene& scene, const SmoothingKernel& kernel) {
  return 2 * viscosity / (densestFluid(scene) * kernel.secondMoment());
}

}  // namespace

void setViscosity(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  constexpr double kMaxViscosityRate = 1e20;  // 1/s; in a step far more than the solve takes, and its squares are floats
  setup.params.viscosityRate = f(std::min(viscosityRate(largestViscosity(scene), densestFluid(scene), kernel), kMaxViscosityRate));
}

void setViscositySteps(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  constexpr uint32_t kMaxSteps = 64;
  constexpr double kCrowded = 1.5;
  if (largestViscosity(scene) <= 0) return;
  const double rate = setup.params.viscosityRate * fastestViscosity(scene);
  const double room = setup.shearViscosity ? kCrowded * double{kShearMargin} : kCrowded;
  const double bound = 1 + room * (latticeBound(rate * setup.longestStep, kernel) - 1);
  setup.params.viscositySteps = shared::viscositySteps(bound, kMaxSteps).count;
  // Somewhat less than what the steps reach, so that rounding does not ask for one more.
  if (!setup.shearViscosity) return;
  setup.params.shearBound = f(0.99 * reachedBound(setup.params.viscositySteps));
  setup.params.shearMoment = f(pairMoment(kernel, 4));
}

void setNoiseDamping(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  setup.artificialViscosity = artificialViscosity(scene);
  setup.params.noiseDampingRate = f(xsphRate(setup.artificialViscosity, scene, kernel));
  if (setup.artificialViscosity > 0) return;
  setup.whyNoNoiseDamping = strongestGravity(scene) == 0                         ? "no gravity"
                            : scene.solver.artificial_viscosity.value_or(1) == 0 ? "artificial viscosity is 0"
                                                                                 : "the viscosity is larger";
}

void setNoSlip(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup) {
  const bool walls = hasWalls(scene) && !scene.domain->slip;
  setup.noSlipWalls = walls && largestViscosity(scene) > 0;
  for (const Solid& solid : scene.solids) {
    setup.noSlipSolids |= sticks(scene, solid);
    setup.noSlipBodies |= sticks(scene, solid) && solid.body;
  }
  if (setup.noSlipSolids) addNoSlipTable(kernel, setup);
  if (largestViscosity(scene) > 0) return;
  const auto found = std::ranges::find(scene.solids, false, &Solid::slip);
  if (!walls && found == scene.solids.end()) return;
  const std::string key = walls ? "domain" : elementPath("solids", static_cast<size_t>(found - scene.solids.begin()));
  const std::string what = scene.fluids.empty() ? "fluid.viscosity is 0" : "the viscosity of every fluid is 0";
  setup.warnings.push_back(key + ".slip: false has no effect: " + what + ", expected more (Pa s)");
}

double artificialViscosity(const Scene& scene) {
  const double d = scene.fluid.spacing;
  const double wanted =
      scene.solver.artificial_viscosity.value_or(kArtificialViscosity) * densestFluid(scene) * d * std::sqrt(strongestGravity(scene) * d);
  return std::max(0.0, wanted - smallestKinematicViscosity(scene) * densestFluid(scene));
}

bool sticks(const Scene& scene, const Solid& solid) { return !solid.slip && largestViscosity(scene) > 0; }

}  // namespace rill
