#pragma once
// Foam, spray and bubbles of a fluid as diffuse particles, as passes of a render graph (Ihmsen et al. 2012).
//
//   auto white = rill::Whitewater::create(device, {.capacity = state.capacity, .parcel_m3 = 1e-6, .gravity = scene.gravity});
//   if (!white) return fail(white.error().message);
//   const rill::WhitewaterState foam = white->addTo(graph, state, 1.0 / 60);  // once a frame, after the fluid's step
//
// Fluid in motion emits them where it traps air and where crests break. How many a second depends on the flow, and not on time steps,
// frames or, for one flow, the spacing: docs/notes/whitewater.md. The fluid does not depend on them.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/scene.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// What a diffuse particle is. It follows from the fluid's share of the space around it and changes as that does.
enum class WhitewaterClass : uint8_t {
  Spray = 0,  ///< a drop in the air: flies
  Foam = 1,   ///< on the surface: moves with the fluid
  Bubble = 2  ///< under water: rises
};

/// Figures of whitewater at one time.
struct WhitewaterStats {
  uint64_t spray = 0, foam = 0, bubbles = 0;  ///< diffuse particles of each class
  uint64_t emitted = 0;                       ///< since the start
  uint64_t dissolved = 0;                     ///< since the start: of age, by walls, too far away
  uint64_t overflow = 0;                      ///< since the start: not emitted, because there was no room
  uint64_t boundHits = 0;                     ///< since the start: sums over fluid particles that were cut off
  friend bool operator==(const WhitewaterStats&, const WhitewaterStats&) = default;
};

/// The state between two steps, on the host: everything that later steps depend on.
struct WhitewaterSnapshot {
  std::vector<uint32_t> counts = {};                 ///< WhitewaterState::counts, word by word; empty: the start
  std::vector<Float4> place = {};                    ///< m, relative to FluidState::origin; age, s
  std::vector<std::array<uint32_t, 4>> motion = {};  ///< bits of the velocity, m/s; random bits << 2 | WhitewaterClass
  friend bool operator==(const WhitewaterSnapshot&, const WhitewaterSnapshot&) = default;
};

/// Parameters of Whitewater::create(). Pointers are not kept.
struct WhitewaterDesc {
  uint32_t capacity = 0;                         ///< fluid particles at most, 1 to 2^22
  uint32_t room = 200'000;                       ///< diffuse particles at most, 1 to 2^22
  double parcel_m3 = 0;                          ///< volume of air, or of drops, that a diffuse particle stands for, 1e-30 to 1e30
  double trapping = 0.02;                        ///< volume of air that shear traps, of the fluid's volume times its strain rate; 0 to 1e6
  double breaking = 0.05;                        ///< volume of drops from breaking crests, of their area times their speed; 0 to 1e6
  double life_s = 2.5;                           ///< mean life of foam, 1e-6 to 1e9; that of fresh water (Monahan and Zietlow 1969)
  Double3 gravity = {0, -9.81, 0};               ///< m/s^2, until addTo() is given another
  std::optional<Domain> domain = {};             ///< its closed sides hold diffuse particles back
  Double3 origin = {0, 0, 0};                    ///< FluidState::origin, for the domain
  uint32_t solids = 0;                           ///< of FluidState::boundaries, which hold them back, too
  bool meshes = false;                           ///< some of those are meshes: FluidState::meshWords has their fields
  uint64_t seed = 1;                             ///< of random numbers
  const WhitewaterSnapshot* snapshot = nullptr;  ///< optional: the state to continue from; BadInput if it does not fit
};

/// The diffuse particles of a frame, as buffers of its graph. Those from counts[0] on are unused.
struct WhitewaterState {
  BufferRef place = {};   ///< vec4: xyz in m relative to FluidState::origin; w: age, s
  BufferRef motion = {};  ///< uvec4: xyz are the bits of the velocity, floats in m/s; w: random bits << 2 | WhitewaterClass
  BufferRef counts = {};  ///< uint[kWhiteCountWords] (shaders/whitewater/whitewater_records.h); the first is the number of particles
  uint32_t room = 0;      ///< entries of the arrays
};

class WhitewaterImpl;

/// Diffuse particles on a borrowed device. Bitwise deterministic per driver: their order follows from that of the fluid's particles and
/// prefix sums, and random numbers from counters. Lifetime and moves as of a Fluid.
class RILL_API Whitewater {
 public:
  /// BadInput for values out of range; TooLarge, naming the bytes needed, before anything is allocated; Shader, OutOfMemory.
  static Expected<Whitewater> create(Device& device, const WhitewaterDesc& desc);
  ~Whitewater();
  Whitewater(Whitewater&&) noexcept;
  Whitewater& operator=(Whitewater&&) noexcept;

  /// Adds the passes of one step: moves the particles by `seconds` and emits what the fluid emits in this time. `gravity`: m/s^2, from
  /// now on. The first graph must be executed. The graph's compile() fails for a negative or non-finite time, and for a state of more
  /// than `capacity` particles or one that is invalid. 0 s: adds no pass but for the first.
  WhitewaterState addTo(Graph& graph, const FluidState& fluid, double seconds, std::optional<Double3> gravity = {});

  const WhitewaterDesc& desc() const;
  uint64_t bytes() const;  ///< of device memory that it keeps

 private:
  friend struct ImplAccess;  // engine/core/impl_of.hpp
  explicit Whitewater(std::unique_ptr<WhitewaterImpl>);
  std::unique_ptr<WhitewaterImpl> impl_;
};

/// The figures in the words of WhitewaterState::counts.
RILL_API WhitewaterStats whitewaterStats(std::span<const uint32_t> counts);

}  // namespace rill
