// What the passes of caustics share.
#include "render/caustics_records.h"
#include "shared/dont_unroll.glsl"
#include "shared/no_depth.h"
#include "shared/ordered_floats.glsl"

layout(std140, set = 0, binding = 0) uniform Frame { CausticsRecord sun; };

uint invocation() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kCausticGroup + gl_LocalInvocationIndex; }
bool inView(ivec2 texel) { return all(greaterThanEqual(texel, ivec2(0))) && texel.x < int(sun.width) && texel.y < int(sun.height); }
uint texelIndex(ivec2 texel) { return uint(texel.y) * sun.width + uint(texel.x); }

// Depths as ordered() has them.
const uint kNoFirst = 0xFFFFFFFFu;

// The share of a texel's light that meets the fluid, by the mean of what spheres cover around it. The spheres reach beyond the fluid.
float coverageOf(float covered) { return clamp(3.2 * (covered - 0.61) + 0.5, 0.0, 1.0); }

// Sums of a layer lie one after the other: those of the map's texels of all layers, then those of wide beams.
ivec2 fineSize() { return int(kCausticFine) * ivec2(sun.width, sun.height); }
ivec2 coarseSize() { return (fineSize() + int(kCausticCoarse) - 1) / int(kCausticCoarse); }
uint fineSums(uint layer) { return layer * uint(fineSize().x * fineSize().y); }
uint coarseSums(uint layer, uint layers) { return fineSums(layers) + layer * uint(coarseSize().x * coarseSize().y); }
