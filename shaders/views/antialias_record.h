// Push constants of the antialiasing pass.
#ifndef RILL_VIEWS_ANTIALIAS_RECORD_H
#define RILL_VIEWS_ANTIALIAS_RECORD_H

#ifdef __cplusplus
#include <cstdint>
namespace rill::antialias {
using uint = std::uint32_t;
constexpr uint kAntialiasGroup = 8;  // pixels per side of a workgroup
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
