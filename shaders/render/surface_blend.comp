#version 460
// The blended surface at each sample that a sphere covers.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

#include "render/surface_arrays.glsl"
READ_UINT(3, depth)
layout(std430, set = 0, binding = 4) writeonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 5) buffer Counters { uint counters[]; };
#define BLOCKS 6
#include "render/surface_block.glsl"
#define PLANES 2
#include "render/surface_blend.glsl"
#include "render/surface_interior.glsl"

void main() {
  ivec2 at;
  if (!ownSample(at)) return;
  const uint index = uint(at.y) * sampleGrid().x + uint(at.x);
  const float hard = uintBitsToFloat(depthAt(index));
  if (hard >= noDepth()) return;
  const vec2 axis = axisOf(samplePixel(at));
  if (hard <= nearestDrawn() && isInterior(at)) {  // inside the near plane's section
    samples[index] = cutSample(axis);
    return;
  }
  const Blend blend = blendAt(axis, hard);
  samples[index] = blend.coverage >= 0.5 || isInterior(at)
                       ? uvec2(floatBitsToUint(blend.depth), packNormal(blend.normal))
                       : uvec2(kNoDepthBits, 0u);
  if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
}
