#pragma once
// The one table of what a scene's keys mean. The parser, the JSON Schema, --set and docs/scene-format.md are made from it, and a
// panel of sliders can be: forEachField<FluidSettings>(...). Defaults are the initializers in rill/scene.hpp.
#include <array>
#include <filesystem>

#include "model/field.hpp"
#include "rill/scene.hpp"

namespace rill::model {

inline constexpr std::array<std::string_view, 6> kSideWords{"-x", "+x", "-y", "+y", "-z", "+z"};  // bits of SideMask
inline constexpr std::array<std::string_view, 6> kAxisWords{"+x", "-x", "+y", "-y", "+z", "-z"};  // Axis
inline constexpr std::array<std::string_view, 2> kKernelWords{"wendland", "poly6_spiky"};         // KernelChoice
inline constexpr std::array<std::string_view, 2> kNeighborWords{"list", "grid"};                  // NeighborChoice
inline constexpr std::array<std::string_view, 4> kPresetWords{"water", "milk", "ink", "clay"};
inline constexpr std::array<std::string_view, 4> kSurfaceWords{"auto", "planes", "curvature_flow", "narrow_range"};
inline constexpr std::array<std::string_view, 0> kNoWords{};

/// The object around a file's name: {"file": "settled.ply"}.
struct FileName {
  std::filesystem::path file;
};

template <>
struct Table<Domain> {
  static constexpr std::string_view about = "A box of walls";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "min", .unit = "m", .help = "lowest corner [x, y, z]"}, &Domain::min},
      Field{Info{.key = "max", .unit = "m", .help = "highest corner, above min on every axis"}, &Domain::max},
      Field{Info{.key = "open", .help = "sides without a wall: what leaves goes on and is counted as outside", .words = kSideWords},
            &Domain::open}};
};

template <>
struct Table<FluidSettings> {
  static constexpr std::string_view about = "The fluid; give either its spacing or a number of particles";
  static constexpr std::array<std::string_view, 2> one_of{"spacing", "particles"};
  static constexpr std::tuple fields{
      Field{Info{.key = "spacing",
                 .unit = "m",
                 .range = above(0),
                 .help = "distance of particles at rest; a particle's mass is density x spacing^3"},
            &FluidSettings::spacing},
      Field{Info{.key = "particles",
                 .range = between(1, 4294967295.0),
                 .help = "about how many particles the fills make; the spacing follows"},
            &FluidSettings::particles},
      Field{Info{.key = "density", .unit = "kg/m^3", .range = above(0), .help = "rest density"}, &FluidSettings::density},
      Field{Info{.key = "smoothing_ratio", .range = between(1.2, 4), .help = "smoothing length (the kernel's support) over spacing"},
            &FluidSettings::smoothing_ratio},
      Field{Info{.key = "viscosity", .unit = "Pa s", .range = atLeast(0), .help = "dynamic viscosity; water has 0.001, honey about 5"},
            &FluidSettings::viscosity},
      Field{Info{.key = "vorticity", .range = between(0, 1), .help = "vorticity confinement: gives back spin that the solver loses"},
            &FluidSettings::vorticity},
      Field{Info{.key = "tensile",
                 .range = between(0, 1),
                 .help = "artificial pressure (s_corr), strength: keeps particles from clumping where the fluid is sparse; 0: none"},
            &FluidSettings::tensile},
      Field{
          Info{.key = "tensile_radius", .range = inside(0, 1), .help = "artificial pressure, reference distance over the smoothing length"},
          &FluidSettings::tensile_radius},
      Field{Info{.key = "tensile_power", .range = between(1, 16), .help = "artificial pressure, exponent n"},
            &FluidSettings::tensile_power}};
};

template <>
struct Table<SolverSettings> {
  static constexpr std::string_view about = "How the fluid is solved";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "time_step",
                 .unit = "s",
                 .range = above(0),
                 .help = "the longest time step; auto: as long as cfl and tolerance allow"},
            &SolverSettings::time_step},
      Field{Info{.key = "cfl", .range = aboveTo(0, 10), .help = "spacings that the fastest particle may move in a substep"},
            &SolverSettings::cfl},
      Field{Info{.key = "max_substeps",
                 .range = between(1, 256),
                 .help = "substeps a frame of up to 1/60 s, at most; time beyond them is dropped and reported"},
            &SolverSettings::max_substeps},
      Field{Info{.key = "iterations", .range = between(1, 1000), .help = "Jacobi iterations a substep, at most"},
            &SolverSettings::iterations},
      Field{
          Info{.key = "tolerance",
               .range = atLeast(0),
               .help = "mean compression to keep under: no more iterations and no shorter steps than that needs; 0: always the full count"},
          &SolverSettings::tolerance},
      Field{Info{.key = "relaxation",
                 .range = aboveTo(0, 2),
                 .help = "Jacobi under-relaxation; auto: 0.7 in a flow, 0.46 in a fluid at rest (at the default kernel)"},
            &SolverSettings::relaxation},
      Field{Info{.key = "regularization",
                 .range = atLeast(0),
                 .help = "epsilon of the paper, as a fraction of the rest lattice's sum of |grad C|^2"},
            &SolverSettings::regularization},
      Field{Info{.key = "warm_start",
                 .range = between(0, 0.5),
                 .help = "gain of the pressure kept from substep to substep; 0: none; auto: 0.02 in a flow, at most 0.005 in a fluid at "
                         "rest, 0 with several iterations"},
            &SolverSettings::warm_start},
      Field{Info{.key = "artificial_viscosity",
                 .range = between(0, 0.3),
                 .help = "damps particle noise while the fluid is slow, over density x spacing x sqrt(g x spacing), less fluid.viscosity; "
                         "auto: 0.03"},
            &SolverSettings::artificial_viscosity},
      Field{Info{.key = "kernel",
                 .help = "wendland: one consistent kernel; poly6_spiky: the pair of Macklin and Mueller 2013",
                 .words = kKernelWords},
            &SolverSettings::kernel},
      Field{Info{.key = "neighbors",
                 .help = "list: a neighbor list kept for several substeps; grid: walk the grid in every pass",
                 .words = kNeighborWords},
            &SolverSettings::neighbors}};
};

template <>
struct Table<BoxShape> {
  static constexpr std::string_view about = "An axis-aligned box";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "min", .unit = "m", .help = "lowest corner [x, y, z]"}, &BoxShape::min},
      Field{Info{.key = "max", .unit = "m", .help = "highest corner, above min on every axis"}, &BoxShape::max}};
};

template <>
struct Table<SphereShape> {
  static constexpr std::string_view about = "A sphere";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{Field{Info{.key = "center", .unit = "m", .help = "[x, y, z]"}, &SphereShape::center},
                                     Field{Info{.key = "radius", .unit = "m", .range = above(0), .help = "radius"}, &SphereShape::radius}};
};

template <>
struct Table<FileName> {
  static constexpr std::string_view about = "A file of particles";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "file", .help = "a PLY file (binary or ascii), relative to the scene file", .required = true}, &FileName::file}};
};

template <>
struct Table<Fill> {
  static constexpr std::string_view about = "Fluid at the start, on a lattice of the spacing or from a file";
  static constexpr std::array<std::string_view, 3> one_of{"box", "sphere", "particles"};
  static constexpr std::tuple fields{
      Field{Info{.key = "box", .help = "round((max - min) / spacing) particles an axis, the first half a spacing inside min"}, &Fill::box},
      Field{Info{.key = "sphere", .help = "the lattice points inside it, the lattice centered on its center"}, &Fill::sphere},
      Field{Info{.key = "particles", .help = "positions from a file, and velocities where it has them"}, &Fill::particles},
      Field{Info{.key = "velocity", .unit = "m/s", .help = "at the start; added to a file's velocities"}, &Fill::velocity},
      Field{Info{.key = "jitter",
                 .range = between(0, 0.5),
                 .help = "random displacement an axis, at most this fraction of the spacing, from the scene's seed"},
            &Fill::jitter}};
};

template <>
struct Table<Keyframe> {
  static constexpr std::string_view about = "Where a solid is at one time";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "at", .unit = "s", .range = atLeast(0), .help = "time, after the entry before"}, &Keyframe::at},
      Field{Info{.key = "translate", .unit = "m", .help = "displacement from the solid's own place"}, &Keyframe::translate}};
};

template <>
struct Table<Solid> {
  static constexpr std::string_view about = "A body that the fluid flows around";
  static constexpr std::array<std::string_view, 2> one_of{"box", "sphere"};
  static constexpr std::tuple fields{
      Field{Info{.key = "box", .help = "its corners before it is turned"}, &Solid::box},
      Field{Info{.key = "sphere", .help = "its center and radius"}, &Solid::sphere},
      Field{Info{.key = "rotation", .help = "quaternion [x, y, z, w] about its center, as in glTF; normalized when read"},
            &Solid::rotation},
      Field{Info{.key = "friction", .range = atLeast(0), .help = "Coulomb coefficient"}, &Solid::friction},
      Field{Info{.key = "restitution", .range = between(0, 1), .help = "share of the normal speed that a bounce keeps"},
            &Solid::restitution},
      Field{Info{.key = "motion", .help = "keyframes in order of time, linear between, held before the first and after the last"},
            &Solid::motion}};
};

template <>
struct Table<GravityChange> {
  static constexpr std::string_view about = "Gravity from one time on";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "at", .unit = "s", .range = atLeast(0), .help = "time, after the entry before"}, &GravityChange::at},
      Field{Info{.key = "value", .unit = "m/s^2", .help = "gravity from then on"}, &GravityChange::value}};
};

template <>
struct Table<Probe> {
  static constexpr std::string_view about = "A figure that the statistics carry";
  static constexpr std::array<std::string_view, 2> one_of{"level", "front"};
  static constexpr std::tuple fields{
      Field{Info{.key = "name", .help = "unique, not empty", .required = true}, &Probe::name},
      Field{Info{.key = "level", .unit = "m", .help = "height of the wet column over the floor at [x, z]"}, &Probe::level},
      Field{Info{.key = "front", .help = "farthest fluid along this axis, from the domain's minimum", .words = kAxisWords}, &Probe::front}};
};

template <>
struct Table<Camera> {
  static constexpr std::string_view about = "Where pictures are taken from; without it the domain or the fluid is framed";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "eye", .unit = "m", .help = "where the camera is"}, &Camera::eye},
      Field{Info{.key = "target", .unit = "m", .help = "the point in the middle of the picture, another than eye"}, &Camera::target},
      Field{Info{.key = "fov_y_deg", .unit = "degrees", .range = inside(0, 180), .help = "vertical field of view"}, &Camera::fov_y_deg}};
};

template <>
struct Table<Look> {
  static constexpr std::string_view about = "How the fluid is drawn";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "preset", .help = "material", .words = kPresetWords}, &Look::preset},
      Field{Info{.key = "surface",
                 .help = "surface reconstruction; auto: planes, the most accurate in rill-bench render",
                 .words = kSurfaceWords},
            &Look::surface},
      Field{Info{.key = "environment",
                 .help =
                     "an equirectangular picture (.hdr, or .png or .jpg as sRGB) relative to the scene file, in place of the sky; at most "
                     "8192x4096 pixels"},
            &Look::environment}};
};

template <>
struct Table<Scene> {
  static constexpr std::string_view about = "A Rill scene: SI units, y up, right-handed";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field<Scene, Version>{Info{.key = "rill", .help = "the oldest Rill that reads this scene", .required = true}, nullptr},
      Field<Scene, Anything>{Info{.key = "$schema", .help = "for editors; ignored"}, nullptr},
      Field{Info{.key = "title", .help = "one line"}, &Scene::title},
      Field{Info{.key = "about", .help = "what to look at; the source, where it reproduces an experiment"}, &Scene::about},
      Field<Scene, Anything>{Info{.key = "extras", .help = "anything; ignored"}, nullptr},
      Field{Info{.key = "duration", .unit = "s", .range = atLeast(0), .help = "what a capture runs when it is not told otherwise"},
            &Scene::duration},
      Field{Info{.key = "seed", .range = between(0, 18446744073709551615.0), .help = "of all that is random"}, &Scene::seed},
      Field{Info{.key = "gravity", .unit = "m/s^2", .help = "[x, y, z]"}, &Scene::gravity},
      Field{Info{.key = "gravity_changes", .help = "in order of time; each holds until the next (a shaken tank)"}, &Scene::gravity_changes},
      Field{Info{.key = "domain", .help = "walls; without it space is unbounded"}, &Scene::domain},
      Field{Info{.key = "fluid", .help = "the fluid", .required = true}, &Scene::fluid},
      Field{Info{.key = "solver", .help = "how it is solved"}, &Scene::solver},
      Field{Info{.key = "fill", .help = "where fluid is at the start; without it the scene is empty"}, &Scene::fill},
      Field{Info{.key = "solids", .help = "bodies", .most = 4096}, &Scene::solids},
      Field{Info{.key = "probes", .help = "figures to record"}, &Scene::probes},
      Field{Info{.key = "camera", .help = "where pictures are taken from; without it the domain or the fluid is framed"}, &Scene::camera},
      Field{Info{.key = "look", .help = "how it is drawn"}, &Scene::look}};
};

}  // namespace rill::model
