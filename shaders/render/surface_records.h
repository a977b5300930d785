// Records and constants that the surface's shaders share with C++. View space: z is the depth, growing away from the eye; lengths in m.
#ifndef RILL_RENDER_SURFACE_RECORDS_H
#define RILL_RENDER_SURFACE_RECORDS_H

#ifdef __cplusplus
#include <cstdint>
namespace rill::surface {
using uint = std::uint32_t;
#define RILL_CONSTANT constexpr uint
#define RILL_NUMBER constexpr float
#else
#define RILL_CONSTANT const uint
#define RILL_NUMBER const float
#endif

RILL_CONSTANT kSurfaceGroup = 64;      // invocations per workgroup of a shader over particles
RILL_CONSTANT kSurfaceTile = 16;       // pixels per side of the tiles that are composed and shaded
RILL_CONSTANT kSampleBlock = 8;        // samples per side of the blocks that are smoothed
RILL_CONSTANT kCellSamples = 4;        // samples per side of a cell of the screen grid
RILL_CONSTANT kOccluderSamples = 2;    // samples per side of an occlusion cell
RILL_CONSTANT kMaxCells = 160;         // maximal occlusion cells per side of one particle
// beyond each side of the picture: the reach of a plane's fit at the default of three samples per spacing
RILL_CONSTANT kMarginSamples = 8;
RILL_CONSTANT kShadowBorder = 2;       // texels around the fluid's shadow
RILL_CONSTANT kMaxRows = 48;          // maximal rows of the screen grid that an iteration around a point visits
RILL_CONSTANT kMaxInRow = 64;         // maximal particles that it visits per row
RILL_CONSTANT kMaxInCell = 1024;      // maximal particles of a cell that are sorted
RILL_CONSTANT kNotSurface = 0xFFFFFFFFu;
RILL_NUMBER kFlowStable = 0.45f;  // largest step of the flow, in squared samples; explicit steps in 2D are stable up to 0.5

// Words of the counter buffer.
RILL_CONSTANT kSurvivorCount = 0;     // particles that are not occluded
RILL_CONSTANT kSurfaceCount = 1;      // surface particles among them
RILL_CONSTANT kSurfaceTileCount = 2;  // tiles with fluid
RILL_CONSTANT kBoundHits = 3;         // invocations in which a bounded loop was cut short: the picture is incomplete
RILL_CONSTANT kSampleBlockCount = 4;  // blocks of samples with fluid
RILL_CONSTANT kEdgeCount = 5;         // pixels that surface_edges.comp evaluates
RILL_CONSTANT kSurfaceCounterWords = 6;

// Words of the argument buffer: three per dispatch, four per draw.
RILL_CONSTANT kSurvivorArguments = 0;
RILL_CONSTANT kSurfaceArguments = 4;
RILL_CONSTANT kSurfaceTileArguments = 8;
RILL_CONSTANT kTileDraw = 12;
RILL_CONSTANT kPixelArguments = 16;  // over all pixels; no groups if no particle is left
RILL_CONSTANT kSampleBlockArguments = 20;
RILL_CONSTANT kEdgeArguments = 24;
RILL_CONSTANT kSurfaceArgumentWords = 28;

// Camera and picture. ndc = pixel / size * 2 - 1; a pixel looks along x, y = (ndc - shift) * scale,
// times z where the view is in perspective.
struct SurfacePush {
  float rows[12];      // stored position to view space: three rows of four
  float scale[2];
  float shift[2];
  float depth_map[2];  // the target's depth is the first plus the second / z (perspective) or * z (orthographic)
  float perspective;   // 1 or 0
  float near_depth;    // m
  float spacing;       // m
  uint count;          // particles at most; particle_count says how many
  uint width, height;  // pixels of the picture
  uint left, top;      // of the picture in the targets
  uint step;           // pixels per side of a sample
  uint margin;         // samples beyond each side of the picture, a multiple of kCellSamples
  float radius;        // m; of a particle's sphere in the depth before smoothing
  float unit;          // m per count of the thickness buffer
  float smoothing;     // planes: reach of the fit, spacings; narrow range: sigma, spacings; curvature flow: total time, m^2
};

struct FluidShadowPush {
  uint width, height;  // texels without the border
  float unit;          // m per count of thickness
};

#undef RILL_CONSTANT
#undef RILL_NUMBER
#ifdef __cplusplus
static_assert(sizeof(SurfacePush) <= 128);
}  // namespace rill::surface
#endif
#endif
