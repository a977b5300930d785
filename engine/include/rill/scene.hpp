#pragma once
// What a scene is: plain descriptions with units and defaults. No JSON, no Vulkan. assets/scenes/scene.schema.json says the same to
// editors.
//
//   rill::Scene scene;
//   scene.fluid.spacing = 0.04;
//   scene.domain = rill::Domain{{0, 0, 0}, {2, 1, 1}};
//   scene.fill = {rill::Fill{.box = rill::BoxShape{{0, 0, 0}, {0.8, 0.8, 1}}}};
//   scene.solids = {rill::Solid{.sphere = rill::SphereShape{{1.5, 0.2, 0.5}, 0.2}, .friction = 0.2}};
//   if (auto ok = rill::checkScene(scene); !ok) return fail(ok.error().message);
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/float3.hpp"

namespace rill {

/// Which sides of the domain have no wall; bit order -x +x -y +y -z +z.
using SideMask = uint8_t;

/// An axis-aligned box of walls. Positions are held relative to `min`.
struct Domain {
  double min[3] = {0, 0, 0};  ///< m
  double max[3] = {1, 1, 1};  ///< m
  SideMask open = 0;          ///< sides without a wall: what leaves goes on and is counted as outside
};

/// The smoothing kernel.
enum class KernelChoice : uint8_t {
  Wendland,   ///< Wendland C2 for W and its gradient: consistent, does not pump energy
  Poly6Spiky  ///< poly6 density with spiky gradient: Macklin and Mueller 2013, the paper's pair
};

/// How a pass finds the neighbors of a particle.
enum class NeighborChoice : uint8_t {
  List,  ///< a neighbor list with a skin, kept for several substeps
  Grid   ///< walk the grid in every pass
};

/// The fluid and its particles.
struct FluidSettings {
  double spacing = 0;            ///< m, > 0; 0 where `particles` gives it
  uint64_t particles = 0;        ///< aim for this many particles; 0 where `spacing` is given
  double density = 1000;         ///< rest density, kg/m^3, > 0
  double smoothing_ratio = 2.0;  ///< smoothing length (kernel support) over spacing, 1.2 .. 4
  double viscosity = 0;          ///< dynamic, Pa s, >= 0
  double vorticity = 0;          ///< vorticity confinement, 0 .. 1
  double tensile = 0.2;          ///< artificial pressure s_corr: strength, 0 .. 1
  double tensile_radius = 0.25;  ///< delta q over the smoothing length, 0 .. 1 exclusive
  double tensile_power = 16;     ///< n, 1 .. 16
};

/// Accuracy and stability of the solver, at the cost of time.
struct SolverSettings {
  std::optional<double> time_step = {};       ///< s, the longest one, > 0; empty: "auto", as long as cfl and tolerance allow
  double cfl = 0.25;                          ///< spacings that the fastest particle may move in a substep, > 0 .. 10
  uint32_t max_substeps = 64;                 ///< a frame of up to 1/60 s, 1 .. 256; time beyond them is dropped and reported
  uint32_t iterations = 1;                    ///< Jacobi iterations a substep, at most, 1 .. 1000
  double tolerance = 0.001;                   ///< mean compression to keep under, fraction of rest density, >= 0; 0: always the full count
  std::optional<double> relaxation = {};      ///< Jacobi under-relaxation, > 0 .. 2; empty: "auto"
  std::optional<double> regularization = {};  ///< epsilon as a fraction of the rest lattice's sum of |grad C|^2, >= 0; empty: "auto"
  std::optional<double> warm_start = {};      ///< gain of the integral warm start, 0 .. 0.5; 0: none; empty: "auto"
  std::optional<double> artificial_viscosity = {};  ///< of a fluid at rest, over density spacing sqrt(g spacing), 0 .. 0.3; empty: "auto"
  KernelChoice kernel = KernelChoice::Wendland;
  NeighborChoice neighbors = NeighborChoice::List;
};

/// An axis-aligned box.
struct BoxShape {
  double min[3] = {0, 0, 0}, max[3] = {1, 1, 1};  ///< m, corners, max above min
};
/// A sphere.
struct SphereShape {
  double center[3] = {0, 0, 0};  ///< m
  double radius = 1;             ///< m, > 0
};

/// Fluid at the start: one of the three.
struct Fill {
  std::optional<BoxShape> box = {};
  std::optional<SphereShape> sphere = {};
  std::optional<std::filesystem::path> particles = {};  ///< a PLY file, absolute once the scene is read
  double velocity[3] = {0, 0, 0};                       ///< m/s
  double jitter = 0;                                    ///< fraction of the spacing, 0 .. 0.5
};

struct Keyframe {
  double at = 0;
  double translate[3] = {0, 0, 0};
};  ///< s; m

/// A solid: one of the two shapes, turned about its center, moving along keyframes (linear between, held outside).
struct Solid {
  std::optional<BoxShape> box = {};
  std::optional<SphereShape> sphere = {};
  double rotation[4] = {0, 0, 0, 1};  ///< unit quaternion x y z w
  double friction = 0;                ///< Coulomb coefficient, >= 0
  double restitution = 0;             ///< 0 .. 1
  std::vector<Keyframe> motion = {};
  double driven = 0;  ///< m/s, at most so fast: > 0 for a solid that its host moves (FluidStep::targets) and no keyframes do
};

struct GravityChange {
  double at = 0;
  double value[3] = {0, 0, 0};
};  ///< s; m/s^2

/// A direction along an axis, or against it.
enum class Axis : uint8_t { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

/// One of the two.
struct Probe {
  std::string name = {};
  std::optional<std::pair<double, double>> level = {};  ///< x, z (m) of the vertical line
  std::optional<Axis> front = {};
};

/// The camera of the pictures.
struct Camera {
  double eye[3] = {0, 0, 1}, target[3] = {0, 0, 0};  ///< m, different points
  double fov_y_deg = 40;                             ///< degrees, vertical, > 0 .. < 180
};

/// Appearance of the fluid and its surroundings in pictures.
struct Look {
  std::string preset = "water";
  std::string surface = "auto";
  std::filesystem::path environment = {};  ///< a picture of all around, absolute once the scene is read; empty: the sky of Rill's own
};

/// A whole scene in SI units, y up, right handed.
struct Scene {
  std::filesystem::path file = {};  ///< where it was read from; empty for one made in memory
  std::string name = {};            ///< file name without extension
  std::string title = {}, about = {};
  double duration = 3.0;  ///< s
  uint64_t seed = 1;
  double gravity[3] = {0, -9.81, 0};  ///< m/s^2
  std::vector<GravityChange> gravity_changes = {};
  std::optional<Domain> domain = {};  ///< none: unbounded
  FluidSettings fluid = {};
  SolverSettings solver = {};
  std::vector<Fill> fill = {};
  std::vector<Solid> solids = {};
  std::vector<Probe> probes = {};
  std::optional<Camera> camera = {};  ///< none: one that frames the domain or the fluid
  Look look = {};
};

/// Whether all that a scene says is in range and goes together: the rules that files are read by, for scenes that a host makes in code.
/// Opens no file. makeParticles() and Fluid::create() call it. BadInput naming the key as in a file ("solids[2].friction"), what was found
/// and what was expected.
RILL_API Expected<void> checkScene(const Scene& scene);

}  // namespace rill
