#pragma once
// The rows of the keys `emitters` and `drains`, for the table of fields.hpp.
#include <array>

#include "model/field.hpp"
#include "rill/scene.hpp"

namespace rill::model {

inline constexpr std::array<std::string_view, 6> kAxisWords{"+x", "-x", "+y", "-y", "+z", "-z"};  // Axis

inline constexpr std::array<std::string_view, 2> kUpWords{"y", "z"};  // UpAxis

inline constexpr size_t kMaxEmitters = 256, kMaxDrains = 256;

template <>
struct Table<DiscMouth> {
  static constexpr std::string_view about = "A round mouth";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "center", .unit = "m", .help = "center [x, y, z]"}, &DiscMouth::center},
      Field{Info{.key = "radius", .unit = "m", .range = above(0), .help = "radius"}, &DiscMouth::radius},
      Field{Info{.key = "normal", .help = "direction of the flow [x, y, z], of any length above 0"}, &DiscMouth::normal}};
};

template <>
struct Table<RectMouth> {
  static constexpr std::string_view about = "A rectangular mouth";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "center", .unit = "m", .help = "center [x, y, z]"}, &RectMouth::center},
      Field{Info{.key = "size", .unit = "m", .range = above(0), .help = "width, across up, and height, along up"}, &RectMouth::size},
      Field{Info{.key = "normal", .help = "direction of the flow [x, y, z], of any length above 0"}, &RectMouth::normal},
      Field{Info{.key = "up", .help = "direction of the height [x, y, z]; its part across the normal counts, so it is not parallel to it"},
            &RectMouth::up}};
};

template <>
struct Table<MeshMouth> {
  static constexpr std::string_view about = "A mouth of any outline: a flat mesh, whose triangles do not overlap";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "file", .help = "OBJ, STL, PLY, glTF or GLB file; the path is relative to the scene file", .required = true},
            &MeshMouth::file},
      Field{Info{.key = "scale", .unit = "m", .range = above(0), .help = "length of a unit of the file"}, &MeshMouth::scale},
      Field{Info{.key = "up", .help = "axis of the file that points up", .words = kUpWords}, &MeshMouth::up},
      Field{Info{.key = "translation", .unit = "m", .help = "translation after the rotation [x, y, z]"}, &MeshMouth::translation},
      Field{Info{.key = "rotation", .help = "rotation about the mesh's origin: a quaternion [x, y, z, w]; normalized when read"},
            &MeshMouth::rotation}};
};

template <>
struct Table<Emitter> {
  static constexpr std::string_view about = "A source of fluid";
  static constexpr std::array<std::string_view, 3> one_of{"disc", "rect", "mesh"};
  static constexpr std::array<std::string_view, 2> one_of_too{"flow", "speed"};
  static constexpr std::tuple fields{
      Field{Info{.key = "name", .help = "name of the emitter; unique among emitters and drains, or empty"}, &Emitter::name},
      alternative<DiscMouth>(Info{.key = "disc", .help = "round mouth"}, &Emitter::mouth),
      alternative<RectMouth>(Info{.key = "rect", .help = "rectangular mouth"}, &Emitter::mouth),
      alternative<MeshMouth>(Info{.key = "mesh", .help = "mouth of the outline of a flat mesh; its triangles face where the fluid goes"},
                             &Emitter::mouth),
      Field{Info{.key = "flow", .unit = "m^3/s", .range = above(0), .help = "volume per time"}, &Emitter::flow},
      Field{Info{.key = "speed", .unit = "m/s", .range = above(0), .help = "speed in the mouth: flow over its area"}, &Emitter::speed},
      Field{Info{.key = "fluid", .help = "name of one of fluids; without it, the first", .namesFluid = true}, &Emitter::fluid},
      Field{Info{.key = "from", .unit = "s", .range = atLeast(0), .help = "time of its start"}, &Emitter::from},
      Field{Info{.key = "until",
                 .unit = "s",
                 .range = above(0),
                 .help = "time of its end, later than from; without it, it has none",
                 .unset = ""},
            &Emitter::until},
      Field{Info{.key = "motion",
                 .help = "keyframes of the mouth, of a mesh about its origin, in order of time; linear between them, constant before the "
                         "first and after the last. Fluid "
                         "leaves with the mouth's velocity in addition to its own"},
            &Emitter::motion}};
};

template <>
struct Table<Drain> {
  static constexpr std::string_view about = "A volume that removes the particles in it";
  static constexpr std::array<std::string_view, 2> one_of{"box", "sphere"};
  static constexpr std::tuple fields{
      Field{Info{.key = "name", .help = "name of the drain; unique among emitters and drains, or empty"}, &Drain::name},
      alternative<BoxShape>(Info{.key = "box", .help = "corners"}, &Drain::shape),
      alternative<SphereShape>(Info{.key = "sphere", .help = "center and radius"}, &Drain::shape),
      Field{Info{.key = "from", .unit = "s", .range = atLeast(0), .help = "time of its start"}, &Drain::from},
      Field{Info{.key = "until",
                 .unit = "s",
                 .range = above(0),
                 .help = "time of its end, later than from; without it, it has none",
                 .unset = ""},
            &Drain::until}};
};

template <>
struct Table<Inflow> {
  static constexpr std::string_view about = "Fluid that flows in through a side of the domain, over its width";
  static constexpr std::array<std::string_view, 2> one_of{"flow", "speed"};
  static constexpr std::tuple fields{
      Field{Info{.key = "side", .help = "side of the domain, across x or z", .words = kAxisWords}, &Inflow::side},
      Field{Info{.key = "level",
                 .unit = "m",
                 .range = above(0),
                 .help = "depth of the flow: height along y above the floor, whatever gravity is",
                 .required = true},
            &Inflow::level},
      Field{Info{.key = "flow", .unit = "m^3/s", .range = above(0), .help = "volume per time"}, &Inflow::flow},
      Field{Info{.key = "speed", .unit = "m/s", .range = above(0), .help = "mean speed: flow over width and level"}, &Inflow::speed},
      Field{Info{.key = "fluid", .help = "name of one of fluids; without it, the first", .namesFluid = true}, &Inflow::fluid}};
};

template <>
struct Table<Outflow> {
  static constexpr std::string_view about = "A side of the domain that is a weir: fluid above its level leaves";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "side", .help = "side of the domain, across x or z", .words = kAxisWords}, &Outflow::side},
      Field{Info{.key = "level",
                 .unit = "m",
                 .range = above(0),
                 .help = "height of the weir along y above the floor, whatever gravity is",
                 .required = true},
            &Outflow::level}};
};

}  // namespace rill::model
