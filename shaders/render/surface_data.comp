#version 460
// The surface as data: exact values without tone curve; alpha 0 without fluid. THICKNESS: that of the fluid; else normal or depth.
#extension GL_GOOGLE_include_directive : require
#define RILL_PUSH_MORE float white;
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Surface { uvec2 surface[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Picture { uint picture[]; };
#ifdef THICKNESS
layout(std430, set = 0, binding = 2) readonly buffer Thickness { uint thickness[]; };
#else
layout(constant_id = 0) const bool DEPTH = false;  // gray from 0 to `white` (m), as thickness
#endif

uint bytes(vec3 c) {
  const uvec3 b = uvec3(clamp(c, 0.0, 1.0) * 255.0 + 0.5);
  return b.r | b.g << 8 | b.b << 16 | 0xFF000000u;
}

void main() {
  const uint index = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (index >= view.width * view.height) return;
  const uvec2 own = surface[index];
  uint result = 0u;
  if (own.x < kNoDepthBits) {
#ifdef THICKNESS
    const uvec2 at = uvec2(index % view.width, index / view.width) / view.step;
    result = bytes(vec3(float(thickness[at.y * sampleGrid().x + at.x]) * view.unit / white));
#else
    result = bytes(DEPTH ? vec3(uintBitsToFloat(own.x) / white) : worldDirection(unpackNormal(own.y)) * 0.5 + 0.5);
#endif
  }
  picture[index] = result;
}
