#pragma once
// Initial particles, made from the fills of a scene.
//
//   rill::Scene scene;
//   scene.fluid.spacing = 0.04;
//   scene.fill = {rill::Fill{.shape = rill::SphereShape{{0, 1, 0}, 0.3}}};
//   auto particles = rill::makeParticles(scene);
//   if (!particles) return fail(particles.error().message);
#include <cstdint>
#include <string>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/scene.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// Largest number of particles of a Fluid on any device: neighbors are stored as steps that go no further. What a device has room for
/// is fewer; see maxParticles().
inline constexpr uint64_t kMaxParticles = uint64_t{1} << 26;

/// Initial particles of a simulation, in the order of the fills. Positions are relative to `origin` (the domain's minimum, or the
/// center of the fluid or else of the mouths, rounded to whole spacings), so that precision does not depend on the location of the scene.
struct ParticleSet {
  Double3 origin = {0, 0, 0};           ///< m, scene coordinates
  double spacing = 0;                   ///< m, of the particles at rest, as fluid.spacing if the scene has it; 0: that of the scene
  std::vector<Float3> positions = {};   ///< m, relative to origin
  std::vector<Float3> velocities = {};  ///< m/s
  std::vector<uint8_t> fluids = {};     ///< index of each particle's fluid among resolvedFluids(); empty: all 0
  /// Share of each of diffusingFluids() in the first particles, 0 .. 1, as FluidState::concentration; other particles have not mixed.
  /// Shares of fluids that the scene lacks are not used.
  std::vector<Float4> concentrations = {};
  uint64_t leftOutOverlap = 0;  ///< closer than 0.9 spacings to a particle of an earlier fill
  uint64_t leftOutSolid = 0;    ///< number left out inside solids
  uint64_t leftOutDomain = 0;   ///< number left out beyond walls
  std::vector<std::string> warnings = {};
};

/// Makes the particles of the scene's fills and reads their PLY files. If `fluid.particles` is given, computes the spacing, which is in the
/// set: Fluid::create() takes it from there; what else needs the scene's spacing gets it by `scene.fluid.spacing = set.spacing`. Counts are
/// checked against `maxParticles` before anything is allocated. BadInput if the scene is invalid, a file cannot be read, there are too many
/// particles (also for `fluid.capacity`), or fills are given and no particles are left; OutOfMemory. Mouths of emitters that are blocked at
/// the start are warnings.
RILL_API Expected<ParticleSet> makeParticles(const Scene& scene, uint64_t maxParticles = kMaxParticles);

/// The number of particles that a fluid of the scene needs room for: `fluid.capacity` if given, otherwise `filled`, those at the start, and
/// what emitters can add in `duration`: a layer of each mouth, and flow x time of the flow / spacing^3. At most kMaxParticles.
/// `scene.fluid.spacing` must be set.
RILL_API uint64_t capacityOf(const Scene& scene, uint64_t filled);

}  // namespace rill
