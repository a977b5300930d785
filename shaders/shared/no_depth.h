// The depth where nothing is seen, as the bits of a float: 1e30 m, beyond all that is drawn. It is finite because a device may assume
// that no operand is infinite (Vulkan 1.3, "Precision and Operation of SPIR-V Instructions").
#ifndef RILL_NO_DEPTH_H
#define RILL_NO_DEPTH_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN
RILL_CONST uint kNoDepthBits = 0x7149F2CAu;
RILL_RECORDS_END
#ifndef __cplusplus
float noDepth() { return uintBitsToFloat(kNoDepthBits); }
#endif
#endif
