// Sunlight through the fluid, as shaders read it. Light space: m along u, v and away from the sun, from the light map's first texel and the
// plane where light depth is 0.
#ifndef RILL_RENDER_CAUSTICS_RECORDS_H
#define RILL_RENDER_CAUSTICS_RECORDS_H

#ifdef __cplusplus
#include <cstdint>

#include "rill/vectors.hpp"
namespace rill::caustics {
using uint = std::uint32_t;
using vec4 = Float4;
#define RILL_CONSTANT constexpr uint
#else
#define RILL_CONSTANT const uint
#endif

RILL_CONSTANT kCausticGroup = 64;  // invocations per workgroup
RILL_CONSTANT kCausticFine = 2;    // photons, and texels of the map, per side of a texel of the sun's view
RILL_CONSTANT kCausticCoarse = 4;  // texels of the map per side of one that sums wide beams
RILL_CONSTANT kCausticLevels = 5;  // of the map, each half as large as the one before

struct CausticsRecord {
  vec4 light[3];    // stored position to light space
  vec4 world[3];    // light space to m from the stage's low corner, along x, y and z
  vec4 stage;       // size of the stage, m; w: 1 if its floor is a receiver
  vec4 absorption;  // 1/m; w: index of refraction
  float texel;      // m, of the sun's view
  float depths;     // m, range of the solids' depths from the sun
  float spacing;    // m
  float thickness;  // m per count of the thickness
  float flux;       // counts of a photon that loses nothing
  float slope;      // depth of a horizontal surface per m along v, at most kSteepest
  float range;      // m, change of depth between texels of one surface at most
  uint width, height;  // texels of the sun's view
  uint particles;      // at most
  uint closed;         // sides of the stage that are walls: bits -x +x -y +y -z +z
};

#undef RILL_CONSTANT
#ifdef __cplusplus
}  // namespace rill::caustics
#endif
#endif
