#version 460
// Of each cell across the sun's rays: where its fluid begins, towards the sun, and how much there is.
#extension GL_GOOGLE_include_directive : require
#include "render/crests.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Crests { uint crests[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Heights { vec2 heights[]; };  // m, along the direction to the sun; m, 0: no fluid
layout(push_constant) uniform Push {
  float sunX, sunY, sunZ;
  float spacing;  // m
  uint capacity;
  uint side;      // cells, a power of two
};

float topOf(uint cell) { return fromOrdered(uvec3(crests[2u * cell])).x; }

// Change to the next cell, the smaller one of both sides: at an edge that is not the jump. 0 beside cells without fluid.
float change(ivec2 cell, ivec2 to, float top) {
  const uint before = crestIndex(cell - to, side), behind = crestIndex(cell + to, side);
  if (min(crests[2u * before + 1u], crests[2u * behind + 1u]) == 0u) return 0.0;
  const float down = top - topOf(before), up = topOf(behind) - top;
  return down * up > 0.0 ? min(abs(down), abs(up)) : 0.0;
}

void main() {
  const uint k = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  if (k >= side * side) return;
  const uint count = crests[2u * k + 1u];
  if (count == 0u) {
    heights[k] = vec2(0.0);
    return;
  }
  // The highest particle is above the surface in the middle by half of what that rises across the cell
  const ivec2 cell = ivec2(k % side, k / side);
  const float top = topOf(k), rise = 0.5 * (change(cell, ivec2(1, 0), top) + change(cell, ivec2(0, 1), top));
  heights[k] = vec2(top + 0.5 * spacing - rise, kCrestRoom * spacing / (kCrestCell * kCrestCell) * float(count));
}
