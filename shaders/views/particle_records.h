// Records and constants that the particle view's shaders share with C++. Lengths in m, relative to the view's origin; y up.
#ifndef RILL_RENDER_PARTICLE_RECORDS_H
#define RILL_RENDER_PARTICLE_RECORDS_H
#include "shared/solid_records.h"

#ifdef __cplusplus
#include <cstdint>

#include "rill/vectors.hpp"
namespace rill::particle_view {
using uint = std::uint32_t;
using vec4 = Float4;
struct uvec4 { uint x = 0, y = 0, z = 0, w = 0; };
#define RILL_CONSTANT constexpr uint
#else
#define RILL_CONSTANT const uint
#endif

RILL_CONSTANT kPixelTile = 16;         // pixels per side of the tiles that share solids and large spheres
RILL_CONSTANT kParticleGroup = 64;     // invocations per workgroup of a shader over particles
RILL_CONSTANT kShadeTile = 8;          // pixels per side of a shading workgroup
RILL_CONSTANT kSmallRect = 64;         // pixels: a sphere up to this size is splatted by one invocation
RILL_CONSTANT kLargeChunk = 4096;      // large spheres per workgroup
RILL_CONSTANT kHiddenCells = 16384;    // maximal occlusion cells tested per sphere
RILL_CONSTANT kOccluderCells = 128;    // maximal occlusion cells per side that a sphere marks
RILL_CONSTANT kColors = 64;           // entries of a color map
RILL_CONSTANT kEdges = 12;             // of a box
RILL_CONSTANT kViewFluids = 8;         // at most

// What the color of a particle shows.
RILL_CONSTANT kBySpeed = 0;
RILL_CONSTANT kByCompression = 1;
RILL_CONSTANT kByFluid = 2;

// The owner of a pixel: a particle's index, or one of these.
RILL_CONSTANT kSolidBase = 0x80000000u;  // + number of the solid
RILL_CONSTANT kFloorId = 0xFFFFFFFEu;
RILL_CONSTANT kNobody = 0xFFFFFFFFu;

// Lists of shading tiles by content.
RILL_CONSTANT kTilesFluid = 0;    // a pixel of a particle
RILL_CONSTANT kTilesSolid = 1;    // a pixel of a solid
RILL_CONSTANT kTilesFloor = 2;    // a pixel of the floor
RILL_CONSTANT kTilesSky = 3;      // a pixel without owner
RILL_CONSTANT kTilesOutline = 4;  // a pixel of a particle or solid in or next to the tile
RILL_CONSTANT kTilesEdge = 5;     // an edge of the domain may cross the tile
RILL_CONSTANT kTileLists = 6;

// Words of the counter buffer: counts, then dispatch arguments of three words each.
RILL_CONSTANT kSmallCount = 0;
RILL_CONSTANT kLargeCount = 1;
RILL_CONSTANT kTileCount = 2;       // + list
RILL_CONSTANT kSmallArguments = 8;
RILL_CONSTANT kLargeArguments = 12;
RILL_CONSTANT kTintArguments = 16;
RILL_CONSTANT kTileArguments = 20;  // + 4 * list
RILL_CONSTANT kCounterWords = 44;

// Camera and frame. Depth is the distance from the eye along `forward`; a pixel's ray has a forward component of 1.
struct ViewPush {
  float eye[3];
  float focal;       // pixels
  float right[3];
  float near_depth;  // near plane
  float up[3];
  float radius;      // of a particle
  float forward[3];
  float time;        // s
  float offset[3];   // particle positions are relative to the view's origin plus this
  uint count;        // particles
  uint width;        // pixels
  uint height;
  uint cell;         // pixels per side of an occlusion cell
  uint coloring;     // kBySpeed, kByCompression or kByFluid
  float scale;       // 1 / the value at the color map's end
  uint winners;      // 0: splat depths, 1: splat indices
  uint unlit;        // 1: particles have the color map's exact color, and the surroundings are darker than any color map
};

// Constant over a view's lifetime.
struct SceneRecord {
  vec4 domain_min;   // w: 1 if there is a domain
  vec4 domain_max;   // w: spacing of the floor's grid lines; 0: it is the floor of a tank
  uvec4 counts;      // solids, light map width, light map height, closed sides (bits -x +x -y +y -z +z)
  vec4 light_u;      // axis; w: coordinate of the light map's first texel center
  vec4 light_v;
  vec4 light_to;     // direction to the light; w: coordinate of the plane where light depth is 0
  vec4 light_texel;  // x: size of a texel, y: range of light depths
  vec4 table;        // x: how far a table reaches beyond a tank, 0: no table; y: its thickness
  vec4 asleep;       // linear RGB of particles asleep, by speed; w: 1 if the fluid may sleep
  vec4 colors[2 * kColors];  // linear RGB: by speed, by compression
  vec4 fluids[kViewFluids];  // linear RGB of each fluid
};

// A solid as the scene describes it.
struct SceneSolid {
  PoseRecord base;          // before any motion
  ShapeRecord shape;
  float radius;             // of the bounding sphere
  uint firstKey, keyCount;  // entries of the keyframe buffer
  uint driven;              // 1: the host moves it
};

// A line in a frame that keyframes may move.
struct LineRecord {
  float fromX, fromY, fromZ;  // m, relative to the frame's center
  uint firstKey;              // entry of the keyframe buffer
  float toX, toY, toZ;
  uint keyCount;
  float centerX, centerY, centerZ;  // before any motion
};

// A solid at the frame's time.
struct PlacedSolid {
  PoseRecord pose;
  ShapeRecord shape;
  float viewX, viewY, viewZ;  // center in view space
  float radius;               // of the bounding sphere
};

// An edge of the domain on the screen: |line.x x + line.y y + line.z| is the distance in pixels.
struct EdgeRecord {
  vec4 line;   // w: 1 where any of it is in front of the eye
  vec4 along;  // direction xy, coordinates of the start and of the end along it
  vec4 depth;  // inverse depth at the start, its change a pixel
};

#undef RILL_CONSTANT
#ifdef __cplusplus
static_assert(sizeof(ViewPush) <= 128);
}  // namespace rill::particle_view
#endif
#endif
