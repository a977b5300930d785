// Macros for headers shared by C++ and GLSL. Records contain only 4-byte scalars (and arrays of them in
// storage buffers), so that std430, std140 and C++ agree on every offset.
#ifndef RILL_INTEROP_H
#define RILL_INTEROP_H
#ifdef __cplusplus
#include <cstdint>
#define RILL_RECORDS_BEGIN namespace rill { using uint = uint32_t;
#define RILL_RECORDS_END }
#define RILL_CONST inline constexpr
#else
#define RILL_RECORDS_BEGIN
#define RILL_RECORDS_END
#define RILL_CONST const
#endif
#endif
