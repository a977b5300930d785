#pragma once
// Scene description: plain structs with units, ranges and defaults. Needs neither JSON nor Vulkan. assets/scenes/scene.schema.json
// describes the same keys for editors.
//
//   rill::Scene scene;
//   scene.fluid.spacing = 0.04;
//   scene.domain = rill::Domain{{0, 0, 0}, {2, 1, 1}};
//   scene.fill = {rill::Fill{.shape = rill::BoxShape{{0, 0, 0}, {0.8, 0.8, 1}}}};
//   scene.solids = {rill::Solid{.shape = rill::SphereShape{{1.5, 0.2, 0.5}, 0.2}, .friction = 0.2}};
//   if (auto ok = rill::checkScene(scene); !ok) return fail(ok.error().message);
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/materials.hpp"
#include "rill/shapes.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// Sides of the domain without a wall, as bits in the order -x +x -y +y -z +z.
using SideMask = uint8_t;

/// A direction along an axis, or against it.
enum class Axis : uint8_t { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

/// A side of the domain through which fluid flows in, over the side's width from the floor to a level. Exactly one of `flow` and `speed` is
/// given. It is an emitter, the last one, of the name "inflow".
struct Inflow {
  Axis side = Axis::MinusX;  ///< across x or z
  double level = 1;          ///< m above the floor, > 0, within the domain
  double flow = 0;           ///< m^3/s, > 0; 0 if `speed` is given
  double speed = 0;          ///< m/s, > 0: flow over width and level; 0 if `flow` is given
  std::string fluid = {};    ///< name of one of Scene::fluids; empty: the first
};

/// A side of the domain that is a wall up to a level, as a weir. Particles that flow over it are removed and counted as left.
struct Outflow {
  Axis side = Axis::PlusX;  ///< across x or z
  double level = 1;         ///< m above the floor, > 0, within the domain
};

/// An axis-aligned box of walls. Particle positions are stored relative to `min`.
struct Domain {
  Double3 min = {0, 0, 0};              ///< m
  Double3 max = {1, 1, 1};              ///< m
  SideMask open = 0;                    ///< sides without a wall; particles that leave stay in the simulation and are counted as outside
  bool open_removes = false;            ///< particles that leave through an open side are removed, and counted as left
  bool slip = true;                     ///< false: viscous fluid sticks to the walls
  std::optional<Inflow> inflow = {};    ///< a closed side
  std::optional<Outflow> outflow = {};  ///< another one
};

/// The smoothing kernel.
enum class KernelChoice : uint8_t {
  Wendland,   ///< Wendland C2 (Wendland 1995) for density and gradient: consistent, adds no energy
  Poly6Spiky  ///< poly6 for density, spiky for the gradient (Macklin and Mueller 2013): inconsistent, adds energy
};

/// How a pass finds the neighbors of a particle.
enum class NeighborChoice : uint8_t {
  List,  ///< neighbor list with a skin, rebuilt every few substeps
  Grid   ///< search the grid in every pass
};

/// Accuracy and cost of the solver. Empty optionals mean "auto".
struct SolverSettings {
  std::optional<double> time_step = {};       ///< longest time step, s, > 0; auto: as long as cfl and tolerance allow
  double cfl = 0.25;                          ///< largest displacement in a substep, in spacings, > 0 .. 10
  uint32_t max_substeps = 64;                 ///< in a frame of up to 1/60 s, 1 .. 256; time that does not fit is dropped and reported
  uint32_t iterations = 1;                    ///< largest number of Jacobi iterations in a substep, 1 .. 1000
  double tolerance = 0.001;                   ///< largest mean compression, fraction of rest density, >= 0; 0: always all iterations
  std::optional<double> relaxation = {};      ///< relaxation factor of the Jacobi iteration, > 0 .. 2
  std::optional<double> regularization = {};  ///< epsilon (eq. 11) over the rest lattice's sum of |grad C|^2, >= 0
  std::optional<double> warm_start = {};      ///< gain of the integral warm start, 0 .. 0.5; 0: none
  std::optional<double> artificial_viscosity = {};  ///< noise damping at rest, over density x spacing x sqrt(g x spacing), 0 .. 1
  KernelChoice kernel = KernelChoice::Wendland;
  NeighborChoice neighbors = NeighborChoice::List;
  bool sleep = false;  ///< fluid at rest, or regions of it, take no part in substeps until something moves them
};

/// A file of particles.
struct ParticleFile {
  std::filesystem::path file = {};  ///< PLY; an absolute path once the scene is loaded
};

/// Initial fluid: a lattice inside a shape, or the particles of a file.
struct Fill {
  std::variant<BoxShape, SphereShape, MeshShape, ParticleFile> shape = {};
  Double3 translation = {0, 0, 0};     ///< of a mesh's origin, m, after the rotation
  Quaternion rotation = {0, 0, 0, 1};  ///< of a mesh about its origin: unit quaternion x y z w
  Double3 velocity = {0, 0, 0};        ///< initial velocity, m/s; added to that of a file
  double jitter = 0;                   ///< largest random offset along each axis, fraction of the spacing, 0 .. 0.5
  std::string fluid = {};              ///< name of one of Scene::fluids; empty: the first, or that of a file's particles
};

/// Displacement of a solid or a mouth at a time, relative to its initial pose.
struct Keyframe {
  double at = 0;                     ///< s, later than the previous keyframe
  Double3 translate = {0, 0, 0};     ///< m
  Quaternion rotate = {0, 0, 0, 1};  ///< unit quaternion x y z w, about the center; after Solid::rotation
};

/// Degrees of freedom, as bits in the order x y z rx ry rz: translations along the axes of the scene, rotations about them.
using FreedomMask = uint8_t;

/// A rigid body, which fluid, contacts with walls and other solids, and gravity move; fluid and body move each other. Exactly one
/// of `density` and `mass` is given; the inertia is that of the shape with uniform density.
struct Body {
  double density = 0;                    ///< kg/m^3, > 0; 0 if `mass` is given
  double mass = 0;                       ///< kg, > 0; 0 if `density` is given
  Double3 velocity = {0, 0, 0};          ///< initial, of the center of mass, m/s
  Double3 angular_velocity = {0, 0, 0};  ///< initial, rad/s, in the axes of the scene
  FreedomMask locked = 0;                ///< degrees of freedom that are held
  double from = 0;                       ///< s, >= 0: held until then, its load measured
};

/// A solid. It is rotated about its center (a mesh about its origin), then translated, and moved by keyframes: linear and spherical linear
/// (the shorter way) between them, constant outside.
struct Solid {
  Shape shape = {};
  Quaternion rotation = {0, 0, 0, 1};  ///< unit quaternion x y z w
  Double3 translation = {0, 0, 0};     ///< m
  double friction = 0;                 ///< coefficient of friction (Coulomb), >= 0
  double restitution = 0;              ///< coefficient of restitution, 0 .. 1
  bool slip = true;                    ///< false: viscous fluid sticks to it
  std::vector<Keyframe> motion = {};
  std::optional<Body> body = {};  ///< a rigid body; without motion, not driven, not a two-sided mesh
  double driven = 0;      ///< largest speed of its points, m/s, where the host moves it (FluidStep::targets); 0: not moved by the host
  std::string name = {};  ///< unique among solids, or empty
};

/// A round mouth of an emitter.
struct DiscMouth {
  Double3 center = {0, 0, 0};   ///< m
  double radius = 1;            ///< m, > 0
  Double3 normal = {0, -1, 0};  ///< direction of the flow, of any length above 0
};

/// A rectangular mouth of an emitter.
struct RectMouth {
  Double3 center = {0, 0, 0};               ///< m
  std::pair<double, double> size = {1, 1};  ///< width, along normal x up, and height, along `up`, m, > 0
  Double3 normal = {0, -1, 0};              ///< direction of the flow, of any length above 0
  Double3 up = {0, 0, 1};                   ///< not parallel to the normal; its part across the normal counts
};

/// A mouth of any outline: a flat mesh, with holes and in several pieces if it has them. Its triangles are counterclockwise seen from where
/// the flow goes, along their mean normal. They do not overlap.
struct MeshMouth {
  std::filesystem::path file = {};  ///< as MeshShape::file
  double scale = 1;                 ///< m per unit of the file, > 0
  UpAxis up = UpAxis::Y;
  Double3 translation = {0, 0, 0};        ///< of the mesh's origin, m, after the rotation
  Quaternion rotation = {0, 0, 0, 1};     ///< of the mesh about its origin: unit quaternion x y z w
  std::shared_ptr<const Mesh> mesh = {};  ///< two-sided, in m; read from `file` by loadScene(), or the host's
};

/// The shape of a mouth.
using Mouth = std::variant<DiscMouth, RectMouth, MeshMouth>;

/// A source of fluid, which leaves a mouth at rest density. Exactly one of `flow` and `speed` is given.
struct Emitter {
  std::string name = {};  ///< unique among emitters and drains, or empty
  Mouth mouth = {};
  double flow = 0;                   ///< m^3/s, > 0; 0 if `speed` is given
  double speed = 0;                  ///< m/s, > 0: flow over the area of the mouth; 0 if `flow` is given
  std::string fluid = {};            ///< name of one of Scene::fluids; empty: the first
  double from = 0;                   ///< s, >= 0
  std::optional<double> until = {};  ///< s, later than `from`; empty: for ever
  /// Of the mouth about its center, a mesh about its origin; fluid leaves with the mouth's velocity in addition to its own.
  std::vector<Keyframe> motion = {};
};

/// A volume that removes the particles in it.
struct Drain {
  std::string name = {};  ///< unique among emitters and drains, or empty
  std::variant<BoxShape, SphereShape> shape = {};
  double from = 0;                   ///< s, >= 0
  std::optional<double> until = {};  ///< s, later than `from`; empty: for ever
};

/// Gravity from a given time on.
struct GravityChange {
  double at = 0;              ///< s, later than the previous change
  Double3 value = {0, 0, 0};  ///< m/s^2
};

/// A measurement. Exactly one of `level`, `front`, `load`, `pose`, `pressure` and `flow` is given.
struct Probe {
  std::string name = {};                                ///< unique, not empty
  std::optional<std::pair<double, double>> level = {};  ///< height of the fluid column at x, z (m)
  std::optional<Axis> front = {};                       ///< farthest position of the fluid along this axis
  std::string load = {};                                ///< name of a solid: force and torque of the fluid on it
  std::string pose = {};                                ///< name of a solid: where it is and how fast it moves
  std::optional<Double3> pressure = {};                 ///< of the fluid at this point, m
  std::string flow = {};                                ///< name of an emitter or a drain: the fluid that went through it
};

/// The camera of the pictures.
struct Camera {
  Double3 eye = {0, 0, 1}, target = {0, 0, 0};  ///< m; must differ
  double fov_y_deg = 40;                        ///< vertical field of view, degrees, > 0 .. < 180
};

/// Appearance of rendered pictures.
struct Look {
  std::string preset = "water";            ///< one of fluidLooks()
  std::string surface = "auto";            ///< surface reconstruction: auto, planes, curvature_flow or narrow_range
  std::string sky = "studio";              ///< studio, day or sunset; not used where there is an environment map
  std::string stage = "grid";              ///< around the fluid in final pictures: grid or tank
  std::filesystem::path environment = {};  ///< environment map; an absolute path once the scene is loaded; empty: the sky
  bool whitewater = false;                 ///< foam, spray and bubbles as diffuse particles; see rill/whitewater.hpp
  double spray_exposure = 0.008;           ///< s, 0 to 1: how long the streaks of spray are exposed without a shutter; 0: round dots
  bool caustics = false;                   ///< sunlight is refracted by the fluid's surface onto floor and solids
};

/// A scene: SI units, y up, right-handed.
struct Scene {
  std::filesystem::path file = {};  ///< file that it was loaded from; empty if it was made in code
  std::string name = {};            ///< file name without extension
  std::string title = {}, about = {};
  double duration = 3.0;            ///< s
  uint64_t seed = 1;                ///< of all random numbers
  Double3 gravity = {0, -9.81, 0};  ///< m/s^2
  std::vector<GravityChange> gravity_changes = {};
  std::optional<Domain> domain = {};  ///< empty: unbounded space
  FluidSettings fluid = {};
  std::vector<FluidMaterial> fluids = {};       ///< empty: one fluid, of the material of `fluid`; at most kMaxFluids
  std::vector<FluidInterface> interfaces = {};  ///< each pair of fluids at most once
  SolverSettings solver = {};
  std::vector<Fill> fill = {};
  std::vector<Solid> solids = {};
  std::vector<Emitter> emitters = {};
  std::vector<Drain> drains = {};
  std::vector<Probe> probes = {};
  std::optional<Camera> camera = {};  ///< empty: frames the domain or the fluid
  Look look = {};
};

/// A fluid of a scene, with nothing left to default.
struct ResolvedFluid {
  std::string name = "fluid";
  double density = 1000;              ///< kg/m^3
  double viscosity = 0;               ///< Pa s, or Pa s^n
  double yieldStress = 0;             ///< Pa
  double flowIndex = 1;               ///< n
  double surfaceTension = 0;          ///< N/m, against air; with what interfaces add
  std::optional<Double3> color = {};  ///< as FluidMaterial::color
  double diffusion = 0;               ///< m^2/s
};

/// The fluids of a scene, at least one: its fluids, or one named "fluid" of the material of `fluid`.
RILL_API std::vector<ResolvedFluid> resolvedFluids(const Scene& scene);

/// The index of a fluid by its name; 0 for an empty name. kMaxFluids: none has it.
RILL_API size_t fluidIndex(const Scene& scene, const std::string& name);

/// Indices of the fluids that diffuse, at most kMaxDiffusing: the first is that of the first component of FluidState::concentration, and so
/// on. Empty in a scene with one fluid.
RILL_API std::vector<size_t> diffusingFluids(const Scene& scene);

/// The number of solids that are rigid bodies.
inline size_t bodyCount(const Scene& scene) {
  size_t count = 0;
  for (const Solid& solid : scene.solids) count += solid.body.has_value();
  return count;
}

/// Whether the scene has emitters, or an inflow, which is one.
inline bool hasEmitters(const Scene& scene) { return !scene.emitters.empty() || (scene.domain && scene.domain->inflow); }

/// Whether particles that leave through some side of the domain are removed.
inline bool hasRemovingSides(const Scene& scene) { return scene.domain && (scene.domain->open_removes || scene.domain->outflow); }

/// The bit of a side among those of a SideMask.
constexpr unsigned sideBit(Axis side) { return static_cast<unsigned>(side) ^ 1U; }

/// Validates a scene that was made in code by the rules that apply to scene files. Opens no file. makeParticles() and Fluid::create()
/// call it. BadInput naming the key as in a file ("solids[2].friction"), what was found and what was expected.
RILL_API Expected<void> checkScene(const Scene& scene);

}  // namespace rill
