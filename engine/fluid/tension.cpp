#include "fluid/tension.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/words.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "fluid/steps.hpp"
#include "shape/shape.hpp"
#include "sph/surface_tension.hpp"

namespace rill {
namespace {

/// "fluid.surface_tension 0.072 N/m", or the key of the fluid that asks for the shortest step.
std::string shownTension(const Scene& scene) {
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  const InterfaceCover cover = interfaceCover(scene);
  KinematicTension fastest;
  for (size_t i = 0; i < fluids.size(); ++i)
    if (const KinematicTension next = kinematicTension(fluids, cover, i); next.value > fastest.value) fastest = next;
  const size_t k = fastest.fluid;
  const bool own = k < scene.fluids.size() && scene.fluids[k].surface_tension;
  return (own ? "fluids." + fluids[k].name : std::string("fluid")) + ".surface_tension " + roundedNumber(fluids[k].surfaceTension) + " N/m";
}

void warnOfRaisedTensions(const Scene& scene, FluidSetup& setup) {
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  for (size_t k = 0; k < scene.fluids.size(); ++k)
    if (const double given = scene.fluids[k].surface_tension.value_or(scene.fluid.surface_tension); given < fluids[k].surfaceTension)
      setup.warnings.push_back("fluids." + fluids[k].name + ".surface_tension: found " + roundedNumber(given) + " N/m, expected at least " +
                               roundedNumber(fluids[k].surfaceTension) + " for the tension of its interfaces; it is simulated with that");
}

/// The body that asks for the shortest step, s: in longer ones the pull at its surface would make it oscillate.
struct StiffestBody {
  size_t solid = 0;
  double step = std::numeric_limits<double>::infinity();
};
StiffestBody stiffestBody(const Scene& scene, const FluidSetup& setup, double tension) {
  constexpr double kStiffness = 3;  // over the tension, for each square spacing of surface
  const double d = scene.fluid.spacing;
  StiffestBody stiffest;
  for (const BodyRecord& body : setup.bodies) {
    const Double3 half = halfExtents(scene.solids[body.solid].shape);
    const double x = half.x + d / 2, y = half.y + d / 2, z = half.z + d / 2, area = 8 * (x * y + y * z + z * x);
    const double step = d * std::sqrt(double{body.mass} / (kStiffness * tension * area));
    if (step < stiffest.step) stiffest = {body.solid, step};
  }
  return stiffest;
}

}  // namespace

void addTension(const Scene& scene, FluidSetup& setup) {
  constexpr double kDeepShare = 0.95;  // of the neighbors of a particle in the middle of others: the third layer has 0.93
  constexpr double kMaxRate = 1e20;    // 1/s^2 and m/s^2: no step is as short as these would ask for
  FluidParams& p = setup.params;
  const double tension = largestTension(scene), d = scene.fluid.spacing;
  if (tension <= 0) {
    if (scene.fluid.contact_angle != FluidSettings{}.contact_angle)
      setup.warnings.push_back("fluid.contact_angle: has no effect: the surface tension is 0, expected more (N/m)");
    return;
  }
  warnOfRaisedTensions(scene, setup);
  const TensionRates rates = tensionRates(tension, densestFluid(scene), d);
  p.tensionRate = f(std::min(rates.rate, kMaxRate));
  p.tensionWall = f(std::min(rates.wall, kMaxRate));
  p.wettingCosine = f(std::cos(scene.fluid.contact_angle * std::numbers::pi / 180));
  p.deepNeighbors = f(std::floor(kDeepShare * 4 / 3 * std::numbers::pi * std::pow(listReach(scene), 3)));
  double step = capillaryStep(largestKinematicTension(scene), 1, d);
  std::string why = shownTension(scene);
  if (const StiffestBody body = stiffestBody(scene, setup, tension); body.step < step) {
    constexpr double kShortest = 0.1;  // of the step without bodies
    why = elementPath("solids", body.solid) + ".body with " + why;
    step = std::max(body.step, kShortest * step);
    if (body.step < step)
      setup.warnings.push_back(why + ": the body is light for its surface: expected steps of at most " + roundedNumber(body.step) +
                               " s for it, found " + roundedNumber(step) + " s; it may be thrown about");
  }
  if (scene.solver.time_step && *scene.solver.time_step > step)
    setup.warnings.push_back("solver.time_step " + roundedNumber(*scene.solver.time_step) + " s is more than " + why +
                             " allows at this spacing: steps are at most " + roundedNumber(step) + " s");
  boundStep(step, why, setup);
  warnOfDropping(why, step, setup);
}

}  // namespace rill
