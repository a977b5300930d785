#pragma once
// From a scene to the numbers and tables that the shaders read. No Vulkan: what a run needs is known, and refused, before anything is
// allocated.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fluid/grid_size.hpp"
#include "fluid/stability_limits.hpp"
#include "rill/expected.hpp"
#include "rill/fluid.hpp"
#include "shared/flow_records.h"
#include "shared/fluid_records.h"
#include "shared/pressure_probe.h"

namespace rill {

/// Spacings beyond the support, or the reach of surface tension, that the list reaches.
inline constexpr double kListSkin = 0.1;

/// Floats of a KeyframeRecord.
inline constexpr size_t kKeyframeNumbers = sizeof(KeyframeRecord) / sizeof(float);

/// Floats of a SolidLoadRecord.
inline constexpr size_t kLoadNumbers = sizeof(SolidLoadRecord) / sizeof(float);

/// Words of a BodyRecord.
inline constexpr size_t kBodyWords = sizeof(BodyRecord) / sizeof(uint32_t);

/// Words of a SlipRecord.
inline constexpr size_t kSlipWords = sizeof(SlipRecord) / sizeof(uint32_t);

/// Words of a PressureProbeRecord.
inline constexpr size_t kPressureProbeWords = sizeof(PressureProbeRecord) / sizeof(uint32_t);

/// Times that the contacts of bodies are solved in a substep. Weight passes from body to body once each time.
constexpr uint32_t contactIterations(size_t bodies) { return bodies > 1 ? 16 : 4; }

/// A solid that the host moves.
struct DrivenSolid {
  uint32_t solid = 0;
  double fastest = 0;  ///< m/s, of its points
  double radius = 0;   ///< m, about its center
  PoseRecord pose{};   ///< relative to the particles' origin, at the end of the last advance that was declared; velocities are unused
};

/// What turns a flow into a speed, and that into layers.
struct MouthSize {
  double area = 0;       ///< m^2
  double thickness = 0;  ///< m, of a layer of particles
};

struct FluidSetup {
  FluidParams params{};
  GridSize grid;
  std::vector<float> tables;                             ///< half-space and ball tables: value and slope, then those of the next entry
  std::vector<SolidRecord> solids;                       ///< relative to the particles' origin, at time 0
  std::vector<BodyRecord> bodies;                        ///< likewise
  std::vector<ContactPointRecord> contactPoints;         ///< of the bodies, in their order
  std::vector<PressureProbeRecord> pressureProbes;       ///< in the order of the scene's probes
  std::vector<EmitterRecord> emitters;                   ///< in the order of the scene's
  std::vector<std::array<float, 2>> mouthPoints;         ///< of their layers, m
  std::vector<MouthSize> mouthSizes;                     ///< of the emitters
  std::vector<DrainRecord> drains;                       ///< in the order of the scene's
  std::vector<uint32_t> meshWords;                       ///< the fields of all meshes (mesh_field.h)
  std::vector<float> keyframes;                          ///< KeyframeRecords, of solids, then of emitters
  std::vector<DrivenSolid> driven;                       ///< at the start; their keyframes follow from each advance
  std::vector<float> gravity;                            ///< the schedule: value and time, four floats each; the scene's own first
  uint32_t kernel = 0;                                   ///< specialization constant KERNEL
  uint32_t substepsPerBlock = 1;                         ///< recorded between two places where the list can be rebuilt
  double artificialViscosity = 0;                        ///< Pa s, of a fluid at rest
  std::string whyNoNoiseDamping;                         ///< where that is 0
  std::string whyNoSleep = "sleep is false";             ///< where the fluid never sleeps
  std::string whyNoRegions = "sleep is false";           ///< where regions of it do not on their own
  std::string whyNoArtificialPressure = "tensile is 0";  ///< where there is no artificial pressure
  StabilityLimits limits;
  double head = 0;                        ///< m^2/s^2, of the start's column
  double longestStep = 0, firstStep = 0;  ///< s, of the start
  std::string stepBoundBy;                ///< what params.maxStep follows from, where not from time_step
  uint32_t fluids = 1;                    ///< number of them
  bool interfaces = false;                ///< some have tension between them
  bool walls = false;                     ///< the domain has a wall
  bool shearViscosity = false;            ///< shear changes the viscosity of a fluid
  bool noSlipWalls = false;               ///< fluid sticks to them
  bool noSlipSolids = false;              ///< and to some solid
  bool noSlipBodies = false;              ///< one of which is a rigid body
  bool held = false;                      ///< walls or solids can hold the fluid up
  bool thin = false;                      ///< walls that face each other can both be near a particle
  bool movingSolids = false;              ///< by keyframes, by the host, or bodies
  bool removes = false;                   ///< particles come and go: emitters, drains or open sides that remove
  bool loads = false;                     ///< loads on solids are measured
  bool mergesPasses = false;              ///< see FluidDesc::mergePasses
  bool warm = false;                      ///< there is a warm start: multipliers and accelerations are kept
  std::vector<std::string> warnings;
};

/// What is known of the particles before they are placed.
struct StartFigures {
  uint32_t capacity = 0;       ///< particles at most
  Double3 origin = {0, 0, 0};  ///< m
  Double3 extent = {0, 0, 0};  ///< m
  double fastest = 0;          ///< m/s
};

/// BadInput where the scene cannot run.
Expected<FluidSetup> makeFluidSetup(const Scene& scene, const StartFigures& start);

/// Whether a side of the domain is closed.
bool hasWalls(const Scene& scene);

/// Whether a scene's substeps start from the multipliers of the ones before.
bool startsWarm(const Scene& scene);

bool probesLoads(const Scene& scene);
/// Whether a probe or a body needs loads on solids.
bool measuresLoads(const Scene& scene);

/// Whether particles come and go while the scene runs.
bool removes(const Scene& scene);

/// Regions that fall asleep on their own.
inline uint64_t regionCount(const FluidParams& p) { return uint64_t{p.regionsX} * p.regionsY * p.regionsZ; }

/// Cells that particles are sorted by: those of the grid, and behind them again where regions sleep, for the particles in these.
inline uint64_t cellKeys(const FluidSetup& setup) { return (setup.params.regionsX != 0 ? 2 : 1) * setup.grid.cells(); }

/// Keys of the sort: the cells, and one behind them for particles that are to be removed.
inline uint64_t keyRange(const FluidSetup& setup) { return cellKeys(setup) + uint64_t{setup.removes}; }

/// Number of probes of pressure.
size_t pressureProbeCount(const Scene& scene);

/// Whether the multipliers of a substep are kept in an array of their own: for further iterations, or for probes of pressure.
inline bool keepsMultipliers(const FluidSetup& setup) { return setup.params.iterations > 1 || !setup.pressureProbes.empty(); }

/// The time in which weight makes a liquid of a fill's lattice, s; 0 without gravity, or without walls and solids that hold the fluid.
double meltingTime(const Scene& scene);

/// Entries that the list holds a particle, a multiple of 4: of the neighbors that a lattice compressed by a fifth puts within the reach,
/// and of what segments take.
uint32_t listCapacity(double reachInSpacings, bool segments);

/// Whether neighbors in a scene's lists are in segments: images behind walls, or far neighbors.
bool listsHaveSegments(const Scene& scene);

/// How far the neighbor list reaches, in spacings.
double listReach(const Scene& scene);

constexpr uint32_t kListEntryBytes = 2;

}  // namespace rill
