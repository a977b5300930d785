// What the pass that smooths a finished picture is told.
#ifndef RILL_VIEWS_ANTIALIAS_RECORD_H
#define RILL_VIEWS_ANTIALIAS_RECORD_H

#ifdef __cplusplus
#include <cstdint>
namespace rill::antialias {
using uint = std::uint32_t;
constexpr uint kAntialiasGroup = 8;  // pixels a side of a workgroup
#else
const uint kAntialiasGroup = 8;
#endif

struct AntialiasPush {
  uint width, height;  // pixels
};

#ifdef __cplusplus
}  // namespace rill::antialias
#endif
#endif
