#version 460
// Smooths both depths with a Gaussian over each one's own surface, first along rows, then (VERTICAL) along columns.
#extension GL_GOOGLE_include_directive : require
#include "render/caustics.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kCausticGroup) in;
#ifdef VERTICAL
READ_FLOAT4(1, rows)
layout(std430, set = 0, binding = 2) writeonly buffer Smooth { vec4 smoothed[]; };
const ivec2 kAlong = ivec2(0, 1);
#else
READ_UINT(1, first)
READ_UINT(2, last)
layout(constant_id = 0) const uint FLUIDS = 1u;
READ_UINT(3, thickness)  // of each fluid
layout(std430, set = 0, binding = 4) writeonly buffer Rows { vec4 rows[]; };
const ivec2 kAlong = ivec2(1, 0);
#endif

const float kSigma = 1.25;  // spacings
const int kTaps = 6;        // on each side at most

// First and last depth, what spheres cover around it, thickness in m.
vec4 texelAt(ivec2 at) {
  if (!inView(at)) return vec4(noDepth(), noDepth(), 0.0, 0.0);
  const uint index = texelIndex(at);
#ifdef VERTICAL
  return rowsAt(index);
#else
  uint counts = thicknessAt(index);
  for (uint fluid = 1u; fluid < FLUIDS; ++fluid) counts += thicknessAt(fluid * sun.width * sun.height + index);
  const float meters = float(counts) * sun.thickness;
  const uint begins = firstAt(index);
  if (begins == kNoFirst) return vec4(noDepth(), noDepth(), 0.0, meters);
  return vec4(fromOrdered(uvec3(begins, lastAt(index), 0u)).xy, 1.0, meters);
#endif
}

void main() {
  const uint index = invocation();
  if (index >= sun.width * sun.height) return;
  const ivec2 p = ivec2(index % sun.width, index / sun.width);
  const vec4 own = texelAt(p);
  const float sigma = kSigma * sun.spacing / sun.texel;
  const int taps = clamp(int(2.2 * sigma + 0.5), 1, kTaps);
  vec2 sum = own.xy, weights = vec2(1.0);
  float covered = own.z, all_weights = 1.0;
  for (int k = 1; k <= taps; ++k) {
    const float gauss = exp(-0.5 * float(k * k) / (sigma * sigma)), rise = float(k * kAlong.y) * sun.texel * sun.slope;
    const vec4 before = texelAt(p - k * kAlong), after = texelAt(p + k * kAlong);
    covered += gauss * (before.z + after.z);
    all_weights += 2.0 * gauss;
    // Both sides or none: one side alone would tilt the surface.
    const vec2 change = max(abs(before.xy + rise - own.xy), abs(after.xy - rise - own.xy)) / (sun.range + float(k) * sun.texel);
    const vec2 same = max(1.0 - change * change, vec2(0.0));
    const vec2 weight = gauss * same * same;
    if (weight.x > 0.0) sum.x += weight.x * (before.x + after.x);
    if (weight.y > 0.0) sum.y += weight.y * (before.y + after.y);
    weights += 2.0 * weight;
  }
  const vec4 result = vec4(own.x < noDepth() ? sum / weights : own.xy, covered / all_weights, own.w);
#ifdef VERTICAL
  smoothed[index] = result;
#else
  rows[index] = result;
#endif
}
