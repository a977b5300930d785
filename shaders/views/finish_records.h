// Sizes, push constants and counts of the passes that finish a picture: tone curve and antialiasing.
#ifndef RILL_VIEWS_FINISH_RECORDS_H
#define RILL_VIEWS_FINISH_RECORDS_H

#ifdef __cplusplus
#include <cstdint>
namespace rill::finish {
using uint = std::uint32_t;
#define RILL_CONSTANT constexpr uint
#else
#define RILL_CONSTANT const uint
#endif

RILL_CONSTANT kPictureTile = 8;      // pixels per side of a workgroup over all of a picture
RILL_CONSTANT kAntialiasGroup = 64;  // pixels at edges of a workgroup
// Words of the counts: workgroups in x, y and z, and pixels at edges. There are kEdgeRows in y, so that those in x are below 65,536.
RILL_CONSTANT kEdgeRows = 8;
RILL_CONSTANT kEdgesAColumn = kAntialiasGroup * kEdgeRows;  // pixels at edges for each workgroup in x
RILL_CONSTANT kEdgePixels = 3;

struct AntialiasPush {
  uint width, height;  // pixels
};

#undef RILL_CONSTANT
#ifdef __cplusplus
}  // namespace rill::finish
#endif
#endif
