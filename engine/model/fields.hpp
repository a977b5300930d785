#pragma once
// The table of scene keys: parser, JSON Schema, --set, the documented key table and the viewer's sliders are derived from it by
// forEachField<FluidSettings>(...). Rows of `fluid`, `fluids` and `solver` are in fluid_fields.hpp, those of `emitters` and `drains` in
// flow_fields.hpp, those of `look` in look_fields.hpp. Defaults are the member initializers in rill/scene.hpp.
#include <array>
#include <filesystem>

#include "model/field.hpp"
#include "model/flow_fields.hpp"
#include "model/fluid_fields.hpp"
#include "model/look_fields.hpp"
#include "rill/scene.hpp"

namespace rill::model {

inline constexpr std::array<std::string_view, 6> kSideWords{"-x", "+x", "-y", "+y", "-z", "+z"};  // bits of SideMask

/// The newest version of scene files that can be read.
inline constexpr std::string_view kSceneVersion = "0.2";

template <>
struct Table<Domain> {
  static constexpr std::string_view about = "An axis-aligned box of walls that bounds the fluid";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "min", .unit = "m", .help = "lowest corner [x, y, z]"}, &Domain::min},
      Field{Info{.key = "max", .unit = "m", .help = "highest corner [x, y, z]; above min on every axis"}, &Domain::max},
      Field{Info{.key = "open",
                 .help = "sides without a wall; particles that leave through one stay in the simulation and are counted as outside, "
                         "unless open_removes",
                 .words = kSideWords},
            &Domain::open},
      Field{Info{.key = "open_removes",
                 .help = "true: particles that leave through an open side are removed and counted as left",
                 .since = "0.2"},
            &Domain::open_removes},
      Field{Info{.key = "slip", .help = "false: fluid with a viscosity above 0 sticks to the walls (no-slip)", .since = "0.2"},
            &Domain::slip},
      Field{Info{.key = "inflow", .help = "a closed side through which fluid flows in", .since = "0.2"}, &Domain::inflow},
      Field{Info{.key = "outflow", .help = "a closed side that is a wall up to a level; what flows over it is removed", .since = "0.2"},
            &Domain::outflow}};
};

template <>
struct Table<BoxShape> {
  static constexpr std::string_view about = "An axis-aligned box";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "min", .unit = "m", .help = "lowest corner [x, y, z]"}, &BoxShape::min},
      Field{Info{.key = "max", .unit = "m", .help = "highest corner [x, y, z]; above min on every axis"}, &BoxShape::max}};
};

template <>
struct Table<SphereShape> {
  static constexpr std::string_view about = "A sphere";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{Field{Info{.key = "center", .unit = "m", .help = "center [x, y, z]"}, &SphereShape::center},
                                     Field{Info{.key = "radius", .unit = "m", .range = above(0), .help = "radius"}, &SphereShape::radius}};
};

template <>
struct Table<MeshShape> {
  static constexpr std::string_view about = "A triangle mesh";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "file", .help = "OBJ, STL, PLY, glTF or GLB file; the path is relative to the scene file", .required = true},
            &MeshShape::file},
      Field{Info{.key = "scale", .unit = "m", .range = above(0), .help = "length of a unit of the file"}, &MeshShape::scale},
      Field{Info{.key = "up", .help = "axis of the file that points up", .words = kUpWords}, &MeshShape::up},
      Field{
          Info{.key = "two_sided",
               .help = "a sheet, which may have open edges: a shell of half a spacing to each side. Otherwise the mesh must be closed, and "
                       "the solid is where its winding number is not 0"},
          &MeshShape::two_sided}};
};

template <>
struct Table<ParticleFile> {
  static constexpr std::string_view about = "A file of particles";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "file", .help = "PLY file (binary or ASCII); the path is relative to the scene file", .required = true},
            &ParticleFile::file}};
};

template <>
struct Table<Fill> {
  static constexpr std::string_view about = "Initial fluid, on a lattice of the spacing or from a file";
  static constexpr std::array<std::string_view, 4> one_of{"box", "sphere", "mesh", "particles"};
  static constexpr std::tuple fields{
      alternative<BoxShape>(
          Info{.key = "box",
               .help = "box with round((max - min) / spacing) particles along each axis, the first half a spacing inside min"},
          &Fill::shape),
      alternative<SphereShape>(Info{.key = "sphere", .help = "sphere that contains the points of a lattice centered on its center"},
                               &Fill::shape),
      alternative<MeshShape>(
          Info{.key = "mesh", .help = "closed mesh that contains the points of a lattice centered on the mesh's bounds", .since = "0.2"},
          &Fill::shape),
      alternative<ParticleFile>(Info{.key = "particles", .help = "positions from a file, and velocities if it has them"}, &Fill::shape),
      Field{Info{.key = "translation", .unit = "m", .help = "of a mesh: position of its origin [x, y, z]", .since = "0.2"},
            &Fill::translation},
      Field{Info{.key = "rotation",
                 .help = "of a mesh: rotation about its origin, a quaternion [x, y, z, w], normalized when read",
                 .since = "0.2"},
            &Fill::rotation},
      Field{Info{.key = "velocity", .unit = "m/s", .help = "initial velocity [x, y, z]; added to a file's velocities"}, &Fill::velocity},
      Field{Info{.key = "jitter",
                 .range = between(0, 0.5),
                 .help = "largest random offset along each axis, as a fraction of the spacing; drawn from the scene's seed. Breaks the "
                         "symmetry of the lattice"},
            &Fill::jitter},
      Field{Info{.key = "fluid",
                 .help = "name of one of fluids; without it, the first, or that of each particle of a file (property uchar fluid)",
                 .since = "0.2",
                 .namesFluid = true},
            &Fill::fluid}};
};

template <>
struct Table<Keyframe> {
  static constexpr std::string_view about = "Displacement of a solid or a mouth at a time";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "at", .unit = "s", .range = atLeast(0), .help = "time; later than the previous entry's"}, &Keyframe::at},
      Field{Info{.key = "translate", .unit = "m", .help = "translation relative to the initial pose [x, y, z]"}, &Keyframe::translate},
      Field{
          Info{.key = "rotate",
               .help = "rotation relative to the initial pose, about the center: a quaternion [x, y, z, w], normalized when read; between "
                       "keyframes the shorter way at constant speed",
               .since = "0.2"},
          &Keyframe::rotate}};
};

inline constexpr std::array<std::string_view, 6> kFreedomWords{"x", "y", "z", "rx", "ry", "rz"};  // bits of FreedomMask

template <>
struct Table<Body> {
  static constexpr std::string_view about = "A rigid body, which fluid, contacts and gravity move";
  static constexpr std::array<std::string_view, 2> one_of{"density", "mass"};
  static constexpr std::tuple fields{
      Field{Info{.key = "density", .unit = "kg/m^3", .range = above(0), .help = "mass over volume"}, &Body::density},
      Field{Info{.key = "mass", .unit = "kg", .range = above(0), .help = "mass, evenly distributed"}, &Body::mass},
      Field{Info{.key = "velocity", .unit = "m/s", .help = "initial velocity of the center of mass [x, y, z]"}, &Body::velocity},
      Field{Info{.key = "angular_velocity", .unit = "rad/s", .help = "initial angular velocity in the axes of the scene [x, y, z]"},
            &Body::angular_velocity},
      Field{Info{.key = "locked",
                 .help = "degrees of freedom that are held: translations along the axes of the scene, and rotations about them",
                 .words = kFreedomWords},
            &Body::locked},
      Field{Info{.key = "from", .unit = "s", .range = atLeast(0), .help = "time until which the body is held, and its load measured"},
            &Body::from}};
};

template <>
struct Table<Solid> {
  static constexpr std::string_view about = "A solid that the fluid flows around";
  static constexpr std::array<std::string_view, 3> one_of{"box", "sphere", "mesh"};
  static constexpr std::tuple fields{
      Field{Info{.key = "name", .help = "name of the solid; unique, or empty", .since = "0.2"}, &Solid::name},
      alternative<BoxShape>(Info{.key = "box", .help = "corners before the rotation"}, &Solid::shape),
      alternative<SphereShape>(Info{.key = "sphere", .help = "center and radius"}, &Solid::shape),
      alternative<MeshShape>(Info{.key = "mesh", .help = "triangle mesh from a file", .since = "0.2"}, &Solid::shape),
      Field{Info{.key = "translation", .unit = "m", .help = "translation after the rotation [x, y, z]", .since = "0.2"},
            &Solid::translation},
      Field{Info{.key = "rotation",
                 .help = "rotation about the solid's center, or the mesh's origin: a quaternion [x, y, z, w], as in glTF; normalized when "
                         "read"},
            &Solid::rotation},
      Field{Info{.key = "friction", .range = atLeast(0), .help = "coefficient of friction (Coulomb)"}, &Solid::friction},
      Field{Info{.key = "restitution",
                 .range = between(0, 1),
                 .help = "coefficient of restitution: normal speed after an impact over normal speed before it"},
            &Solid::restitution},
      Field{Info{.key = "slip", .help = "false: fluid with a viscosity above 0 sticks to the solid (no-slip)", .since = "0.2"},
            &Solid::slip},
      Field{Info{.key = "body", .help = "makes it a rigid body; not with motion, and not of a two-sided mesh", .since = "0.2"},
            &Solid::body},
      Field{Info{.key = "motion", .help = "keyframes in order of time; linear between them, constant before the first and after the last"},
            &Solid::motion}};
};

template <>
struct Table<GravityChange> {
  static constexpr std::string_view about = "Gravity from a given time on";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "at", .unit = "s", .range = atLeast(0), .help = "time; later than the previous entry's"}, &GravityChange::at},
      Field{Info{.key = "value", .unit = "m/s^2", .help = "gravity [x, y, z] from that time on"}, &GravityChange::value}};
};

template <>
struct Table<Probe> {
  static constexpr std::string_view about = "A measurement in the statistics";
  static constexpr std::array<std::string_view, 6> one_of{"level", "front", "load", "pose", "pressure", "flow"};
  static constexpr std::tuple fields{
      Field{Info{.key = "name", .help = "name in the statistics; unique, not empty", .required = true}, &Probe::name},
      Field{Info{.key = "level", .unit = "m", .help = "height of the fluid column above the floor at [x, z]"}, &Probe::level},
      Field{Info{.key = "front",
                 .help = "farthest position of the fluid along this axis, relative to the domain's minimum",
                 .words = kAxisWords},
            &Probe::front},
      Field{Info{.key = "load",
                 .help = "name of a solid: force (N) and torque (N m, about its center) of the fluid on it, mean over the time since "
                         "the frame before",
                 .since = "0.2"},
            &Probe::load},
      Field{Info{.key = "pose",
                 .help = "name of a solid: position of its center (of a mesh: its origin, of a body: its center of mass) (m), rotation [x, "
                         "y, z, w], velocity (m/s) and "
                         "angular velocity (rad/s)",
                 .since = "0.2"},
            &Probe::pose},
      Field{Info{.key = "pressure",
                 .unit = "m",
                 .help = "pressure (Pa, over that of the air) of the fluid at this point [x, y, z], mean over the time since the frame "
                         "before; 0 in air, null inside a solid",
                 .since = "0.2"},
            &Probe::pressure},
      Field{Info{.key = "flow",
                 .help = "name of an emitter or a drain: fluid that went through it, per time (m^3/s, mean over the time since the frame "
                         "before) and since the start (m^3)",
                 .since = "0.2"},
            &Probe::flow}};
};

template <>
struct Table<Camera> {
  static constexpr std::string_view about = "Camera of rendered pictures";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "eye", .unit = "m", .help = "position of the camera [x, y, z]"}, &Camera::eye},
      Field{Info{.key = "target", .unit = "m", .help = "point at the center of the picture [x, y, z]; must differ from eye"},
            &Camera::target},
      Field{Info{.key = "fov_y_deg", .unit = "degrees", .range = inside(0, 180), .help = "vertical field of view"}, &Camera::fov_y_deg}};
};

template <>
struct Table<Scene> {
  static constexpr std::string_view about = "A Rill scene: SI units, y up, right-handed";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field<Scene, Version>{Info{.key = "rill", .help = "minimum Rill version", .required = true}, nullptr},
      Field<Scene, Ignored>{Info{.key = "$schema", .help = "path of the JSON Schema for editors; ignored"}, nullptr},
      Field{Info{.key = "title", .help = "title in one line"}, &Scene::title},
      Field{Info{.key = "about", .help = "what the scene shows, and its source if it reproduces an experiment"}, &Scene::about},
      Field<Scene, Ignored>{Info{.key = "extras", .help = "data of other programs; ignored"}, nullptr},
      Field{Info{.key = "duration", .unit = "s", .range = atLeast(0), .help = "simulated time that a capture runs by default"},
            &Scene::duration},
      Field{Info{.key = "seed", .range = between(0, 18446744073709551615.0), .help = "seed of all random numbers"}, &Scene::seed},
      Field{Info{.key = "gravity", .unit = "m/s^2", .help = "gravitational acceleration [x, y, z]"}, &Scene::gravity},
      Field{Info{.key = "gravity_changes",
                 .help = "changes of gravity in order of time; each holds until the next, for example in a shaken tank"},
            &Scene::gravity_changes},
      Field{Info{.key = "domain", .help = "walls of the simulated space; without it space is unbounded"}, &Scene::domain},
      Field{Info{.key = "fluid", .help = "material and resolution of the fluid", .required = true}, &Scene::fluid},
      Field{Info{.key = "fluids",
                 .help = "several fluids, which share the keys of fluid but for those given here; without it, one",
                 .most = kMaxFluids,
                 .since = "0.2"},
            &Scene::fluids},
      Field{Info{.key = "interfaces", .help = "tension between fluids; pairs that are not named have none", .since = "0.2"},
            &Scene::interfaces},
      Field{Info{.key = "solver", .help = "accuracy and cost of the solver"}, &Scene::solver},
      Field{Info{.key = "fill", .help = "initial fluid; without it the scene is empty"}, &Scene::fill},
      Field{Info{.key = "solids", .help = "solids that the fluid flows around", .most = 4096}, &Scene::solids},
      Field{Info{.key = "emitters", .help = "sources of fluid", .most = kMaxEmitters, .since = "0.2"}, &Scene::emitters},
      Field{Info{.key = "drains",
                 .help = "volumes that remove fluid; where they overlap, the first takes it",
                 .most = kMaxDrains,
                 .since = "0.2"},
            &Scene::drains},
      Field{Info{.key = "probes", .help = "measurements that are recorded with the statistics"}, &Scene::probes},
      Field{Info{.key = "camera", .help = "camera of rendered pictures; without it the domain or the fluid is framed"}, &Scene::camera},
      Field{Info{.key = "look", .help = "appearance of rendered pictures"}, &Scene::look}};
};

}  // namespace rill::model
