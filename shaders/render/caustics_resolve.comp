#version 460
// The map's finest level from the sums. A texel: light through the fluid over the sun's, and of the floor the share of light that meets
// no fluid; of SOLIDS, in a second layer, the depth where fluid begins.
#extension GL_GOOGLE_include_directive : require
#include "render/caustics.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kCausticGroup) in;
READ_UINT(1, sums)
READ_FLOAT4(2, smoothed)
layout(std430, set = 0, binding = 3) writeonly buffer Caustics { uvec2 caustics[]; };

#ifdef SOLIDS
const uint kLayers = 2u;
#else
const uint kLayers = 1u;
#endif

vec3 sumAt(ivec2 texel, ivec2 size, uint start) {
  texel = clamp(texel, ivec2(0), size - 1);
  const uint first = 3u * (start + uint(texel.y * size.x + texel.x));
  return vec3(sumsAt(first), sumsAt(first + 1u), sumsAt(first + 2u));
}

// The mean of four texels, which leaves no pattern of photons two texels apart. The map's texels are half a texel before those of the sums.
vec3 lightAt(ivec2 at, uint layer) {
  const uint start = fineSums(layer), coarse_start = coarseSums(layer, kLayers);
  const ivec2 size = fineSize(), coarse_size = coarseSize();
  const vec3 fine = sumAt(at, size, start) + sumAt(at - ivec2(1, 0), size, start) + sumAt(at - ivec2(0, 1), size, start) +
                    sumAt(at - ivec2(1, 1), size, start);
  const vec2 place = vec2(at) / float(kCausticCoarse) - 0.5, part = fract(place);
  const ivec2 base = ivec2(floor(place));
  const vec3 coarse = mix(mix(sumAt(base, coarse_size, coarse_start), sumAt(base + ivec2(1, 0), coarse_size, coarse_start), part.x),
                          mix(sumAt(base + ivec2(0, 1), coarse_size, coarse_start), sumAt(base + 1, coarse_size, coarse_start), part.x),
                          part.y);
  return min((0.25 * fine + coarse / float(kCausticCoarse * kCausticCoarse)) / sun.flux, vec3(6e4));
}

void main() {
  const uint index = invocation();
  const ivec2 size = fineSize();
  if (index >= uint(size.x * size.y)) return;
  const ivec2 texel = ivec2(index % uint(size.x), index / uint(size.x));
  const vec2 at = vec2(texel) / float(kCausticFine) - 0.5, part = at - floor(at);
  float covered = 0.0, begins = noDepth();
  RILL_LOOP for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1), near = ivec2(floor(at)) + corner;
    if (!inView(near)) continue;
    const vec2 weight = mix(1.0 - part, part, vec2(corner));
    const vec4 texel_near = smoothedAt(texelIndex(near));
    covered += weight.x * weight.y * texel_near.z;
    begins = min(begins, texel_near.x);
  }
  const vec3 light = lightAt(texel, 0u);
  caustics[index] = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 1.0 - coverageOf(covered))));
#ifdef SOLIDS
  const vec3 on_solids = lightAt(texel, 1u);
  caustics[uint(size.x * size.y) + index] = uvec2(packHalf2x16(on_solids.rg), packHalf2x16(vec2(on_solids.b, clamp(begins, -6e4, 6e4))));
#endif
}
