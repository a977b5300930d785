#include "reference/scene_settings.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "fill/mouth.hpp"
#include "fluid/fluids.hpp"
#include "fluid/stability_limits.hpp"
#include "shared/fluid_records.h"

namespace rill::reference {
namespace {

EmitterSettings settingsOf(const Emitter& emitter, const EmitterRecord& r, std::span<const std::array<float, 2>> points) {
  const glm::dvec3 center(r.centerX, r.centerY, r.centerZ), arm(r.armX, r.armY, r.armZ);
  const glm::dvec3 across(r.acrossX, r.acrossY, r.acrossZ), up(r.upX, r.upY, r.upZ);
  std::vector<glm::dvec3> layer;
  for (const auto& [x, y] : points.subspan(r.firstPoint, r.points)) layer.push_back(arm + double{x} * across + double{y} * up);
  return {.center = center - arm,
          .points = std::move(layer),
          .velocity = double{r.speed} * glm::dvec3(r.normalX, r.normalY, r.normalZ),
          .rate = r.rate,
          .from = r.from,
          .until = r.until,
          .motion = emitter.motion,
          .arm = arm,
          .across = across,
          .up = up,
          .shape = r.shape,
          .halfAcross = r.halfAcross,
          .halfUp = r.halfUp,
          .motionSpeed = r.motionSpeed};
}

}  // namespace

ReferenceSettings settingsOf(const Scene& scene, const FluidSetup& setup, const Double3& origin) {
  ReferenceSettings s;
  s.kernel = scene.solver.kernel;
  s.spacing = scene.fluid.spacing;
  s.smoothingRatio = scene.fluid.smoothing_ratio;
  s.density = densestFluid(scene);
  s.shearViscosity = setup.shearViscosity;
  if (s.shearViscosity) s.shearBound = setup.params.shearBound;
  if (!scene.fluids.empty() || s.shearViscosity)
    for (const ResolvedFluid& fluid : resolvedFluids(scene))
      s.fluids.push_back({.density = fluid.density,
                          .viscosity = fluid.viscosity,
                          .yieldStress = fluid.yieldStress,
                          .flowIndex = fluid.flowIndex,
                          .surfaceTension = fluid.surfaceTension,
                          .diffusion = fluid.diffusion});
  s.origin = vec(origin);
  for (int a = 0; a < 3; ++a) {
    s.gravity[a] = scene.gravity[a];
    if (!scene.domain) continue;
    if (!(scene.domain->open & (1u << (2 * a)))) s.lo[a] = scene.domain->min[a] - origin[a];
    if (!(scene.domain->open & (2u << (2 * a)))) s.hi[a] = scene.domain->max[a] - origin[a];
  }
  if (scene.domain && scene.domain->outflow) {
    const unsigned side = sideBit(scene.domain->outflow->side);
    s.outflowAxis = static_cast<int>(side / 2);
    s.outflowHigh = side % 2 == 1;
    s.outflowLevel = scene.domain->min.y + scene.domain->outflow->level - origin.y;
  }
  s.solids = scene.solids;
  const std::vector<Emitter> emitters = emittersOf(scene);
  for (size_t k = 0; k < emitters.size(); ++k) s.emitters.push_back(settingsOf(emitters[k], setup.emitters[k], setup.mouthPoints));
  s.iterations = static_cast<int>(scene.solver.iterations);
  s.relaxation = setup.params.relaxationInMotion;
  s.relaxationAtRest = setup.params.relaxationAtRest;
  s.regularization = boundedRegularization(scene).taken;
  s.warmStart = setup.params.warmGainInMotion;
  s.momentum = setup.params.momentum;
  s.warmStartAtRest = setup.limits.warmGainAtRest(setup.head);
  s.warmLimit = setup.params.warmLimit;
  s.motionSpeed = setup.limits.motionSpeed(setup.head);
  s.tensile = scene.fluid.tensile;
  s.tensileRadius = scene.fluid.tensile_radius;
  s.tensilePower = scene.fluid.tensile_power;
  s.viscosity = largestViscosity(scene);
  s.viscositySteps = static_cast<int>(setup.params.viscositySteps);
  s.diffusionStages = static_cast<int>(setup.params.diffusionStages);
  s.noSlipWalls = scene.domain && !scene.domain->slip;
  s.meltingTime = meltingTime(scene);
  s.viscosityAtRest = setup.artificialViscosity;
  s.sparedFlow = double{kSparedFlow} * std::sqrt(setup.params.layerHead);
  s.travelLimit = setup.params.travelLimit;
  s.substepsPerBlock = static_cast<int>(setup.substepsPerBlock);
  s.vorticity = scene.fluid.vorticity;
  s.surfaceTension = largestTension(scene);
  s.cover = interfaceCover(scene);
  s.wettingCosine = setup.params.tensionRate > 0 ? std::cos(scene.fluid.contact_angle * std::numbers::pi / 180) : 0;
  s.drag = scene.fluid.drag;
  s.separationSpeed = setup.params.separationSpeed;
  s.minSpeedGain = setup.params.minSpeedGain;
  s.maxSpeedGain = setup.params.maxSpeedGain;
  s.solidSpeed = setup.params.solidSpeed;
  return s;
}

}  // namespace rill::reference
