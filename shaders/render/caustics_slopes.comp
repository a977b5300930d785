#version 460
// The change of both depths per m along u and v, from the neighbors on each side that are of the same surface.
#extension GL_GOOGLE_include_directive : require
#include "render/caustics.glsl"

layout(local_size_x = kCausticGroup) in;
layout(std430, set = 0, binding = 1) readonly buffer Smooth { vec4 smoothed[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Front { vec4 front[]; };  // depth, its change, 1 if there is fluid
layout(std430, set = 0, binding = 3) writeonly buffer Back { vec4 back[]; };

vec2 depthsAt(ivec2 at) { return inView(at) ? smoothed[texelIndex(at)].xy : vec2(noDepth()); }

// Of both surfaces along one axis, on which a horizontal surface changes by `rise` per texel.
vec2 changeAlong(ivec2 p, ivec2 along, vec2 own, float rise) {
  const vec2 after = depthsAt(p + along) - own, before = own - depthsAt(p - along);
  const bvec2 has_after = lessThan(abs(after - rise), vec2(sun.range)), has_before = lessThan(abs(before - rise), vec2(sun.range));
  const vec2 sides = vec2(has_after) + vec2(has_before), sum = mix(vec2(0.0), after, has_after) + mix(vec2(0.0), before, has_before);
  return mix(vec2(rise), sum / max(sides, vec2(1.0)), greaterThan(sides, vec2(0.5))) / sun.texel;
}

void main() {
  const uint index = invocation();
  if (index >= sun.width * sun.height) return;
  const ivec2 p = ivec2(index % sun.width, index / sun.width);
  const vec2 own = smoothed[index].xy;
  const float fluid = own.x < noDepth() ? 1.0 : 0.0;
  vec2 along_u = vec2(0.0), along_v = vec2(0.0);
  if (fluid > 0.0) {
    along_u = changeAlong(p, ivec2(1, 0), own, 0.0);
    along_v = changeAlong(p, ivec2(0, 1), own, sun.texel * sun.slope);
  }
  front[index] = vec4(own.x, along_u.x, along_v.x, fluid);
  back[index] = vec4(own.y, along_u.y, along_v.y, fluid);
}
