#pragma once
// The one table of a fluid's arrays. Creation, import, memory report, binding, snapshot and checkpoint follow from its rows.
// To add an array: a value of FluidArray, its row in arrays.cpp, and a buffer of that name in the shaders that use it.
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "fluid/settings.hpp"
#include "rill/fluid.hpp"
#include "rill/snapshot.hpp"

namespace rill {

enum class FluidArray : uint8_t {
  // Records and tables of the scene.
  Params,
  Control,
  Sums,
  Shapes,
  Commands,
  DensityCommands,
  GravityChanges,
  Table,
  Solids,
  SolidSums,
  SolidLoads,
  Bodies,
  ContactPoints,
  Slips,
  Touched,
  ContactCandidates,
  ContactBodies,
  ContactCommands,
  PointCommands,
  PressureProbes,
  Pulls,
  Emitters,
  MouthPoints,
  Drains,
  Flow,
  Regions,
  MeshWords,
  Keyframes,
  // Per particle.
  Position,
  Velocity,
  Prediction,
  WarmAcceleration,
  Work,
  Warm,
  Id,
  Rest,
  Multiplier,
  Concentration,
  ListHead,
  Cell,
  NearDisplaced,
  NearTangential,
  NearCorrection,
  NearStiffness,
  NearSolids,
  NearMouths,
  // The neighbor search.
  CellStart,
  List,
  // Of one rebuild, substep or measurement.
  Key,
  SortedPosition,
  SortedPrediction,
  SortedVelocity,
  FreeVelocity,
  NearMultipliers,
  NearSampled,
  InReach,
  Smoothed,
  Coherence,
  Hold,
  PriorVelocity,
  Residual,
  Direction,
  NextDirection,
  NextConcentration,
  Curl,
  SolidPlane,
  SurfaceParticle,
  SurfaceForce,
  OrderedPosition,
  Histogram,
  Partials,
  FluidFigures,
  Figures,
  // Names under which shaders see one of the above, or a result of the sort: see FluidImpl::alias().
  Particle,
  Place,
  SweepFrom,
  SweepTo,
  DirectionFrom,
  DirectionTo,
  ConcentrationFrom,
  ConcentrationTo,
  SortStart,
  SortArrived,
  SortOrder,
  SortRank,
  SortOversized,
  kCount
};
constexpr size_t kArrays = static_cast<size_t>(FluidArray::kCount);

/// What decides which arrays there are, and how long they are.
struct ArrayShape {
  uint64_t particles = 0;    ///< at most
  uint64_t listEntries = 0;  ///< of all particles
  uint64_t cellStarts = 0;   ///< entries
  uint64_t fluids = 1, gravityChanges = 1, tableEntries = 0, solids = 0, bodies = 0, contactPoints = 0, pressureProbes = 0, emitters = 0,
           mouthPoints = 0, drains = 0, regions = 0, meshWords = 0, keyframes = 0;
  bool lists = true, warm = false, multipliers = false, smooths = false, viscous = false, shearViscosity = false, vorticity = false,
       tension = false, loads = false, noSlipSolids = false, noSlipBodies = false, removes = false, diffuses = false;
};
ArrayShape arrayShape(const FluidSetup& setup);
/// An upper bound, from the scene alone.
ArrayShape arrayShape(const Scene& scene, uint64_t particles);

/// How long an array's content lives.
enum class Lifetime : uint8_t {
  Fluid,    ///< a buffer of the fluid
  Section,  ///< a transient of one rebuild, substep or measurement
  Alias     ///< no array of its own
};

/// Where FluidMemory counts it.
enum class Account : uint8_t { None, Particles, List, Grid };

/// A snapshot's array, one element a particle in the order of the device.
using SnapshotMember = std::variant<std::monostate, std::vector<Float3> FluidSnapshot::*, std::vector<Float4> FluidSnapshot::*,
                                    std::vector<float> FluidSnapshot::*, std::vector<uint32_t> FluidSnapshot::*>;

struct ArrayRow {
  FluidArray id;
  std::string_view name;   ///< in shaders
  const char* label = "";  ///< in graphs and reports
  Lifetime lifetime = Lifetime::Alias;
  uint32_t stride = 0;                              ///< bytes an element
  uint64_t (*length)(const ArrayShape&) = nullptr;  ///< elements; 0: the scene has no use for it
  Account account = Account::None;
  SnapshotMember saved = {};   ///< what persists between steps and is not derived from other arrays
  const char* savedName = "";  ///< of its section in a checkpoint, at most 8 characters
  bool optional = false;       ///< a snapshot of a fluid without a warm start lacks it
  float w = 0;                 ///< of an array of Float3: the fourth component on the device
};

/// In the order of FluidArray.
std::span<const ArrayRow, kArrays> arrayTable();
inline const ArrayRow& rowOf(FluidArray array) { return arrayTable()[static_cast<size_t>(array)]; }
/// kCount if no array has this name.
FluidArray arrayNamed(std::string_view name);

/// Bytes of an array. One that the scene has no use for takes 64 as a buffer: a binding must be something.
uint64_t arrayBytes(FluidArray array, const ArrayShape& shape);

FluidMemory memoryOf(const ArrayShape& shape);

/// Calls visit(row, member) for each saved array.
template <class Visit>
void forEachSaved(Visit&& visit) {
  for (const ArrayRow& row : arrayTable())
    std::visit(
        [&](auto member) {
          if constexpr (!std::is_same_v<decltype(member), std::monostate>) visit(row, member);
        },
        row.saved);
}

}  // namespace rill
