#pragma once
// The rows of the key `look`, for the table of fields.hpp.
#include <array>

#include "core/look_names.hpp"
#include "model/field.hpp"
#include "rill/scene.hpp"

namespace rill::model {

inline constexpr std::array<std::string_view, 4> kSurfaceWords{"auto", "planes", "curvature_flow", "narrow_range"};

template <>
struct Table<Look> {
  static constexpr std::string_view about = "Appearance of rendered pictures";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "preset", .help = "appearance of the fluid: absorption, scattering and roughness", .words = kLookNames},
            &Look::preset},
      Field{Info{.key = "surface",
                 .help = "surface reconstruction; auto: planes, the most accurate method in rill-bench render",
                 .words = kSurfaceWords},
            &Look::surface},
      Field{Info{.key = "sky",
                 .help = "built-in sky: studio, soft lights before a dark backdrop, or day or sunset, clear skies with their sun",
                 .words = kSkyNames,
                 .since = "0.2"},
            &Look::sky},
      Field{Info{.key = "stage",
                 .help =
                     "around the fluid in the view final: grid, the edges of the domain on a checkered floor, or tank, its closed "
                     "sides as panes of glass around a pale floor, on a table: dark in the studio, of stone above a sea under clear skies",
                 .words = kStageNames,
                 .since = "0.2"},
            &Look::stage},
      Field{Info{.key = "environment",
                 .help = "equirectangular environment map (.hdr, or .png or .jpg as sRGB) in place of the sky; the path is "
                         "relative to the scene file, at most 8192x4096 pixels"},
            &Look::environment},
      Field{Info{.key = "whitewater",
                 .help = "true: foam, spray and bubbles are simulated as diffuse particles; false: drops and thin sheets are drawn white",
                 .since = "0.2"},
            &Look::whitewater},
      Field{
          Info{.key = "spray_exposure",
               .unit = "s",
               .range = between(0, 1),
               .help = "spray of simulated whitewater is drawn as streaks as long as its path in this time; with --shutter, in a sample's "
                       "part of the time that the shutter is open; 0: round dots",
               .since = "0.2"},
          &Look::spray_exposure},
      Field{Info{.key = "caustics",
                 .help = "true: the fluid's surface refracts sunlight onto the floor and solids; false: fluid casts a plain shadow",
                 .since = "0.2"},
            &Look::caustics}};
};

}  // namespace rill::model
