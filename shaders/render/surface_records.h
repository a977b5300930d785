// What the surface's shaders and their C++ side share. View space: x and y across, z the depth, growing away from the eye; lengths in m.
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

RILL_CONSTANT kSurfaceGroup = 64;      // invocations of a particle kernel's workgroup
RILL_CONSTANT kSurfaceTile = 16;       // pixels a side of the tiles that are composed and shaded
RILL_CONSTANT kSampleBlock = 8;        // samples a side of the blocks that are smoothed
RILL_CONSTANT kCellSamples = 4;        // samples a side of a cell of the screen grid
RILL_CONSTANT kOccluderSamples = 2;    // samples a side of an occlusion cell
RILL_CONSTANT kMaxCells = 160;         // cells a side that one particle hides, or is hidden by, at most
// beyond each side of the picture: as far as a plane is fitted at three samples a spacing, the
// default
RILL_CONSTANT kMarginSamples = 8;
RILL_CONSTANT kMaxRows = 48;          // rows of the screen grid that one walk visits at most
RILL_CONSTANT kMaxInRow = 64;         // particles of one row that a walk visits at most
RILL_CONSTANT kMaxInCell = 1024;      // particles of a cell that are put in order
RILL_CONSTANT kInfiniteBits = 0x7F800000u;  // bits of the float: there is no fluid
RILL_CONSTANT kNotSurface = 0xFFFFFFFFu;
RILL_NUMBER kFlowStable = 0.45f;  // of a sample's square: a step of the flow at most; explicit ones in two dimensions are stable up to 0.5

// Words of the counter buffer.
RILL_CONSTANT kSurvivorCount = 0;     // particles that occlusion left
RILL_CONSTANT kSurfaceCount = 1;      // of them, those that own a part of the picture
RILL_CONSTANT kSurfaceTileCount = 2;  // tiles that hold fluid
RILL_CONSTANT kBoundHits = 3;         // invocations in which a bounded loop ran into its bound: something was left out of the picture
RILL_CONSTANT kSampleBlockCount = 4;  // blocks of samples that hold fluid
RILL_CONSTANT kEdgeCount = 5;         // pixels that have a look of their own
RILL_CONSTANT kSurfaceCounterWords = 6;

// Words of the argument buffer: three a dispatch, four a draw.
RILL_CONSTANT kSurvivorArguments = 0;
RILL_CONSTANT kSurfaceArguments = 4;
RILL_CONSTANT kSurfaceTileArguments = 8;
RILL_CONSTANT kTileDraw = 12;
RILL_CONSTANT kPixelArguments = 16;  // over all pixels; no groups where no particle is left
RILL_CONSTANT kSampleBlockArguments = 20;
RILL_CONSTANT kEdgeArguments = 24;
RILL_CONSTANT kSurfaceArgumentWords = 28;

// Camera and picture. ndc = pixel / size * 2 - 1; a pixel looks along x, y = (ndc - shift) * scale,
// times z where the view is in perspective.
struct SurfacePush {
  float rows[12];      // to view space from positions as they are stored: three rows of four
  float scale[2];
  float shift[2];
  float depth_map[2];  // the target's depth is the first plus the second / z (perspective) or * z (orthographic)
  float perspective;   // 1 or 0
  float near_depth;    // m; nothing nearer is drawn
  float spacing;       // m
  uint count;          // particles
  uint width, height;  // pixels of the picture
  uint left, top;      // of it in the targets
  uint step;           // pixels a side of a sample
  uint margin;         // samples beyond each side of the picture, so that the surface does not end there; whole cells
  float radius;        // m; of a particle's sphere in the hard depth
  float unit;          // m; of a count of the thickness buffer
  float smoothing;     // planes: spacings that they are fitted over; narrow range: spacings, sigma; curvature flow: m^2, all of its time
};

#undef RILL_CONSTANT
#undef RILL_NUMBER
#ifdef __cplusplus
static_assert(sizeof(SurfacePush) <= 128);
}  // namespace rill::surface
#endif
#endif
