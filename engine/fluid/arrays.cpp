#include "fluid/arrays.hpp"

#include <algorithm>

#include "fluid/fluids.hpp"
#include "fluid/near_solids.hpp"
#include "fluid/steps.hpp"
#include "fluid/viscosity.hpp"
#include "model/scene_facts.hpp"
#include "shape/contact_points.hpp"
#include "shared/region_records.h"
#include "shared/surface_tension.h"
#include "sort/dispatches.hpp"
#include "sort/sort_types.h"

namespace rill {
namespace {

uint64_t one(const ArrayShape&) { return 1; }
uint64_t perParticle(const ArrayShape& s) { return s.particles; }
uint64_t withDummy(const ArrayShape& s) { return s.particles + 1; }  // the neighbor that pads lists comes last

uint64_t perKey(const ArrayShape& s) { return divideUp(s.particles, kCountThreads) * kCountThreads; }  // see keys.comp

uint64_t perParticleIfSolids(const ArrayShape& s) { return s.solids > 0 ? s.particles : 0; }

uint64_t perSolidIfLoads(const ArrayShape& s) { return s.loads ? s.solids : 0; }

uint64_t sumsOfSolids(const ArrayShape& s) {
  return kSolidSumWords * perSolidIfLoads(s) + (s.noSlipBodies ? kNoSlipSumWords * s.bodies : 0);
}

uint64_t concentrations(const ArrayShape& s) { return s.diffuses ? withDummy(s) : 0; }

template <bool ArrayShape::*Feature>
uint64_t perParticleIf(const ArrayShape& s) {
  return s.*Feature ? s.particles : 0;
}

constexpr uint64_t kVector = 16, kWord = 4;

constexpr std::array<ArrayRow, kArrays> makeTable() {
  using enum FluidArray;
  using enum Lifetime;
  return {{
      {Params, "params", "fluid parameters", Fluid, sizeof(FluidParams), one},
      {Control, "control", "fluid control", Fluid, sizeof(FluidControl), one},
      {Sums, "sums", "fluid sums", Fluid, sizeof(FluidSums), one},
      {Shapes, "shapes", "dispatch shapes", Fluid, 12, [](const ArrayShape&) { return uint64_t{kMaxCommands}; }},
      {Commands, "commands", "dispatch commands", Fluid, 4, [](const ArrayShape&) { return uint64_t{kTicketWord} + 1; }},
      {DensityCommands, "densityCommands", "density dispatch commands", Fluid, 12, [](const ArrayShape&) { return uint64_t{2}; }},
      {GravityChanges, "gravityChanges", "gravity schedule", Fluid, kVector, [](const ArrayShape& s) { return s.gravityChanges; }},
      {Table, "table", "density tables of solids", Fluid, kVector, [](const ArrayShape& s) { return s.tableEntries; }},
      {Solids, "solids", "solids", Fluid, sizeof(SolidRecord), [](const ArrayShape& s) { return s.solids; }},
      {SolidSums, "solidSums", "sums of solids", Fluid, kWord, sumsOfSolids},
      {SolidLoads, "solidLoads", "loads on solids", Fluid, sizeof(SolidLoadRecord), perSolidIfLoads},
      {Bodies, "bodies", "rigid bodies", Fluid, sizeof(BodyRecord), [](const ArrayShape& s) { return s.bodies; }},
      {ContactPoints, "contactPoints", "contact points of bodies", Fluid, sizeof(ContactPointRecord),
       [](const ArrayShape& s) { return s.contactPoints; }},
      {Slips, "slips", "slips of contact points", Fluid, sizeof(SlipRecord), [](const ArrayShape& s) { return s.contactPoints; }},
      {Touched, "touched", "solids that bodies touch", Section, sizeof(TouchedRecord), [](const ArrayShape& s) { return s.bodies; }},
      {ContactCandidates, "contactCandidates", "contact points that may touch", Section, 8,
       [](const ArrayShape& s) { return s.bodies > 0 ? s.contactPoints + 1 : 0; }},
      {ContactBodies, "contactBodies", "bodies that may touch, bodies in contact", Section, kWord,
       [](const ArrayShape& s) { return s.bodies > 0 ? kContactLists + (kPointWorkgroups + 1) * s.bodies : 0; }},
      {ContactCommands, "contactCommands", "contact dispatch commands", Fluid, 12, [](const ArrayShape&) { return uint64_t{2}; }},
      {PointCommands, "pointCommands", "contact point dispatch command", Fluid, 12, one},
      {PressureProbes, "pressureProbes", "pressure probes", Fluid, sizeof(PressureProbeRecord),
       [](const ArrayShape& s) { return s.pressureProbes; }},
      {Pulls, "pulls", "pulls of bodies", Fluid, sizeof(PullRecord),
       [](const ArrayShape& s) { return s.bodies > 0 ? uint64_t{kMaxPulls} : 0; }},
      {Emitters, "emitters", "emitters", Fluid, sizeof(EmitterRecord), [](const ArrayShape& s) { return s.emitters; }},
      {MouthPoints, "mouthPoints", "points of emitters' mouths", Fluid, 8, [](const ArrayShape& s) { return s.mouthPoints; }},
      {Drains, "drains", "drains", Fluid, sizeof(DrainRecord), [](const ArrayShape& s) { return s.drains; }},
      {Flow, "flow", "ledger of particles", Fluid, sizeof(FlowRecord), [](const ArrayShape& s) { return uint64_t{s.removes}; }},
      {Regions, "regions", "regions that sleep", Fluid, sizeof(RegionRecord), [](const ArrayShape& s) { return s.regions; }},
      {MeshWords, "meshWord", "fields of meshes", Fluid, kWord, [](const ArrayShape& s) { return s.meshWords; }},
      {Keyframes, "keyframes", "keyframes", Fluid, sizeof(KeyframeRecord), [](const ArrayShape& s) { return s.keyframes; }},

      {Position, "position", "positions", Fluid, kVector, withDummy, Account::Particles, &FluidSnapshot::position, "position"},
      {Velocity, "velocity", "velocities", Fluid, kVector, withDummy, Account::Particles, &FluidSnapshot::velocity, "velocity", false, 1},
      {Prediction, "prediction", "predictions", Fluid, kVector, withDummy, Account::Particles},
      {WarmAcceleration, "warmAcceleration", "warm-start accelerations", Fluid, kVector, perParticleIf<&ArrayShape::warm>,
       Account::Particles, &FluidSnapshot::warmAcceleration, "warmacc", true},
      {Work, "work", "predictions and multipliers", Fluid, kVector, withDummy, Account::Particles},
      {Warm, "warm", "warm-start multipliers", Fluid, kWord, perParticleIf<&ArrayShape::warm>, Account::Particles,
       &FluidSnapshot::warmStart, "warm", true},
      {Id, "id", "ids", Fluid, kWord, perParticle, Account::Particles, &FluidSnapshot::id, "id"},
      {Rest, "rest", "zones of particles", Fluid, kWord, [](const ArrayShape& s) { return s.regions > 0 ? s.particles : 0; },
       Account::Particles, &FluidSnapshot::rest, "rest", true},
      {Multiplier, "multiplier", "multipliers", Fluid, kWord, perParticleIf<&ArrayShape::multipliers>, Account::Particles},
      {Concentration, "concentration", "concentrations", Fluid, kVector, concentrations, Account::Particles, &FluidSnapshot::concentration,
       "mixture", true},
      {ListHead, "listHead", "list heads", Fluid, kWord,
       [](const ArrayShape& s) { return s.lists || s.solids > 0 || s.emitters > 0 || s.regions > 0 ? s.particles : 0; },
       Account::Particles},
      {Cell, "cell", "cells", Fluid, kWord, perParticle, Account::Particles},
      {NearDisplaced, "nearDisplaced", "density that solids and mouths displace", Fluid, kVector,
       [](const ArrayShape& s) { return s.solids > 0 || s.emitters > 0 ? s.particles : 0; }, Account::Particles},
      {NearTangential, "nearTangential", "tangential scales at solids", Fluid, kVector,
       [](const ArrayShape& s) { return s.solids > 0 ? withDummy(s) : 0; }, Account::Particles},
      {NearCorrection, "nearCorrection", "corrections near solids", Fluid, kVector,
       [](const ArrayShape& s) { return 2 * perParticleIfSolids(s); }, Account::Particles},
      {NearStiffness, "nearStiffness", "stiffness of bodies", Fluid, kWord,
       [](const ArrayShape& s) { return s.bodies > 0 ? s.particles : 0; }, Account::Particles},
      {NearSolids, "nearSolids", "particles near solids", Fluid, kVector,
       [](const ArrayShape& s) { return nearSolidQuads(s.solids) * perParticleIfSolids(s); }, Account::Particles},
      {NearMouths, "nearMouths", "particles near mouths", Fluid, kWord,
       [](const ArrayShape& s) { return s.emitters > 0 ? s.particles : 0; }, Account::Particles},

      {CellStart, "cellStart", "cell starts", Fluid, kWord, [](const ArrayShape& s) { return s.cellStarts; }, Account::Grid},
      {List, "list", "neighbor list", Fluid, kListEntryBytes, [](const ArrayShape& s) { return s.listEntries; }, Account::List},

      {Key, "key", "cell keys", Section, kWord, perKey, Account::Particles},
      {SortedPosition, "sortedPosition", "sorted positions", Section, kVector, perParticle, Account::Particles},
      {SortedPrediction, "sortedPrediction", "sorted predictions", Section, kVector, perParticle, Account::Particles},
      {SortedVelocity, "sortedVelocity", "sorted velocities", Section, kVector, perParticle, Account::Particles},
      {FreeVelocity, "freeVelocity", "free velocities", Section, kVector, perParticleIfSolids, Account::Particles},
      {NearMultipliers, "nearMultipliers", "multipliers near solids", Section, 8, perParticleIf<&ArrayShape::loads>, Account::Particles},
      {NearSampled, "nearSampled", "solids that displace density near particles", Section, kWord, perParticleIf<&ArrayShape::loads>,
       Account::Particles},
      {InReach, "inReach", "particles in reach of solids", Section, 8, perParticleIfSolids, Account::Particles},
      {Smoothed, "smoothed", "smoothed velocities", Section, kVector, [](const ArrayShape& s) { return s.smooths ? s.particles + 1 : 0; },
       Account::Particles},
      {Coherence, "coherence", "coherence of motion", Fluid, kWord, perParticleIf<&ArrayShape::smooths>, Account::Particles},
      {Hold, "hold", "hold of solids", Fluid, kVector, perParticleIf<&ArrayShape::noSlipSolids>, Account::Particles},
      {PriorVelocity, "priorVelocity", "velocities before, and viscosities", Fluid, kVector,
       [](const ArrayShape& s) { return s.shearViscosity ? s.particles + 1 : 0; }, Account::Particles},
      {Residual, "residual", "residuals of viscosity", Section, kVector, perParticleIf<&ArrayShape::viscous>, Account::Particles},
      {Direction, "direction", "directions of viscosity", Section, kVector,
       [](const ArrayShape& s) { return s.viscous ? s.particles + 1 : 0; }, Account::Particles},
      {NextDirection, "nextDirection", "next directions of viscosity", Section, kVector,
       [](const ArrayShape& s) { return s.viscous ? s.particles + 1 : 0; }, Account::Particles},
      {NextConcentration, "nextConcentration", "next concentrations", Section, kVector, concentrations, Account::Particles},
      {Curl, "curl", "curl", Section, kVector, [](const ArrayShape& s) { return s.vorticity ? s.particles + 1 : 0; }, Account::Particles},
      {SolidPlane, "solidPlane", "planes of solids, then reactions to tension", Fluid, kVector,
       [](const ArrayShape& s) { return s.tension && s.solids > 0 ? s.particles : 0; }, Account::Particles},
      {SurfaceParticle, "surfaceParticle", "particles near surfaces", Fluid, kWord,
       [](const ArrayShape& s) { return s.tension ? s.particles + kMaxSurfaceChunks : 0; }, Account::Particles},
      {SurfaceForce, "surfaceForce", "forces of surfaces", Section, kWord,
       [](const ArrayShape& s) { return s.tension ? 3 * s.particles : 0; }, Account::Particles},
      {OrderedPosition, "orderedPosition", "ordered positions", Section, kVector, perParticle},
      {Histogram, "histogram", "error histogram", Section, kWord, [](const ArrayShape&) { return uint64_t{3 * kMeasureBins}; }},
      {Partials, "partials", "partial sums", Section, sizeof(MeasurePartial), [](const ArrayShape&) { return uint64_t{kMeasurePartials}; }},
      {FluidFigures, "fluidFigures", "figures of fluids", Section, sizeof(FluidFigureRecord),
       [](const ArrayShape& s) { return s.fluids > 1 ? uint64_t{kMaxFluids} : 0; }},
      {Figures, "figures", "figures", Section, sizeof(MeasureResult), one},

      {Particle, "particle"},
      {Place, "place"},
      {SweepFrom, "sweepFrom"},
      {SweepTo, "sweepTo"},
      {DirectionFrom, "directionFrom"},
      {DirectionTo, "directionTo"},
      {ConcentrationFrom, "concentrationFrom"},
      {ConcentrationTo, "concentrationTo"},
      {SortStart, "start"},
      {SortArrived, "arrived"},
      {SortOrder, "order"},
      {SortRank, "rank"},
      {SortOversized, "oversized"},
  }};
}
constexpr std::array<ArrayRow, kArrays> kArrayTable = makeTable();

}  // namespace

std::span<const ArrayRow, kArrays> arrayTable() { return kArrayTable; }

FluidArray arrayNamed(std::string_view name) {
  const auto found = std::ranges::find(arrayTable(), name, &ArrayRow::name);
  return found == arrayTable().end() ? FluidArray::kCount : found->id;
}

ArrayShape arrayShape(const FluidSetup& setup) {
  const FluidParams& p = setup.params;
  return {.particles = p.capacity,
          .listEntries = divideUp(p.capacity, kListBlock) * kListBlock * p.listCapacity,
          .cellStarts = paddedWords(keyRange(setup) + 1),
          .fluids = setup.fluids,
          .gravityChanges = setup.gravity.size() / 4,
          .tableEntries = setup.tables.size() / 4,
          .solids = p.solidCount,
          .bodies = p.bodyCount,
          .contactPoints = p.contactPoints,
          .pressureProbes = p.pressureProbes,
          .emitters = setup.emitters.size(),
          .mouthPoints = setup.mouthPoints.size(),
          .drains = setup.drains.size(),
          .regions = regionCount(p),
          .meshWords = setup.meshWords.size(),
          .keyframes = setup.keyframes.size() / kKeyframeNumbers,
          .lists = p.listCapacity > 0,
          .warm = setup.warm,
          .multipliers = keepsMultipliers(setup),
          .smooths = p.noiseDampingRate > 0,
          .viscous = p.viscosityRate > 0,
          .shearViscosity = setup.shearViscosity,
          .vorticity = p.vorticity > 0,
          .tension = p.tensionRate > 0,
          .loads = setup.loads,
          .noSlipSolids = setup.noSlipSolids,
          .noSlipBodies = setup.noSlipBodies,
          .removes = setup.removes,
          .diffuses = p.maxDiffusionRate > 0};
}

ArrayShape arrayShape(const Scene& scene, uint64_t particles) {
  const bool lists = scene.solver.neighbors != NeighborChoice::Grid, sleeps = maySleep(scene);
  const uint64_t cells = maxGridCells(particles);
  const uint64_t capacity = lists ? listCapacity(listReach(scene), listsHaveSegments(scene)) : 0;
  return {.particles = particles,
          .listEntries = divideUp(particles, kListBlock) * kListBlock * capacity,
          .cellStarts = (sleeps ? 2 : 1) * cells + 1 + uint64_t{removes(scene)},
          .fluids = std::max<uint64_t>(scene.fluids.size(), 1),
          .solids = scene.solids.size(),
          .bodies = bodyCount(scene),
          .contactPoints = kMaxContactPoints * bodyCount(scene),
          .pressureProbes = pressureProbeCount(scene),
          .regions = sleeps ? cells / (kRegionCellsX * kRegionCellsY * kRegionCellsZ) : 0,
          .lists = lists,
          .warm = startsWarm(scene),
          .multipliers = scene.solver.iterations > 1 || pressureProbeCount(scene) > 0,
          .viscous = largestViscosity(scene) > 0,
          .shearViscosity = hasShearViscosity(scene),
          .vorticity = scene.fluid.vorticity > 0,
          .tension = largestTension(scene) > 0,
          .loads = !scene.solids.empty(),  // a host may ask for them
          .noSlipSolids = std::ranges::any_of(scene.solids, [&](const Solid& solid) { return sticks(scene, solid); }),
          .noSlipBodies = std::ranges::any_of(scene.solids, [&](const Solid& solid) { return sticks(scene, solid) && solid.body; }),
          .diffuses = !diffusingFluids(scene).empty()};
}

uint64_t arrayBytes(FluidArray array, const ArrayShape& shape) {
  constexpr uint64_t kPlaceholder = 64;
  const ArrayRow& row = rowOf(array);
  const uint64_t bytes = row.length(shape) * row.stride;
  return bytes > 0 ? bytes : kPlaceholder;
}

FluidMemory memoryOf(const ArrayShape& shape) {
  FluidMemory memory;
  for (const ArrayRow& row : arrayTable()) {
    if (row.account == Account::None) continue;
    const uint64_t bytes = row.length(shape) * row.stride;
    if (row.account == Account::Particles) memory.particleBytes += bytes;
    if (row.account == Account::List) memory.listBytes += bytes;
    if (row.account == Account::Grid) memory.gridBytes += bytes;
  }
  memory.particleBytes += 2 * kWord * shape.particles;  // the sort: where keys arrived, and the order of full cells
  memory.gridBytes += memory.gridBytes / 4;             // and its tile sums
  return memory;
}

}  // namespace rill
