#version 460
// Diffuse particles as soft dots: sums of optical depth, in whole numbers, so that their order does not matter.
#extension GL_GOOGLE_include_directive : require
#define RILL_PUSH_MORE float size;  // m, radius of a particle's parcel
#include "render/look_records.h"
#include "render/surface.glsl"
#include "views/whitewater_view_records.h"
#include "whitewater/whitewater_records.h"

layout(local_size_x = kWhiteSplatGroup) in;
layout(std140, set = 0, binding = 0) uniform Look { LookRecord look; };
layout(std430, set = 0, binding = 1) readonly buffer Place { vec4 place[]; };
layout(std430, set = 0, binding = 2) readonly buffer Motion { uvec4 motion[]; };
layout(std430, set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 4) readonly buffer Surface { uvec2 surface[]; };
layout(std430, set = 0, binding = 5) readonly buffer SceneDepth { float scene_depth[]; };
layout(std430, set = 0, binding = 6) buffer Dots { uint dots[]; };

const float kSizes[3] = float[3](0.6, 1.6, 1.2);       // of spray, foam and bubbles, over the parcel's
const float kOpacities[3] = float[3](0.9, 0.3, 0.2);   // optical depth in the middle

void add(uint at, float depth) {
  const uint count = uint(depth * kWhiteOpacity + 0.5);
  if (count > 0u) atomicAdd(dots[at], count);
}

void main() {
  const uint k = groupIndex() * kWhiteSplatGroup + gl_LocalInvocationIndex;
  if (k >= counts[kWhiteCount]) return;
  const uint kind = min(motion[k].w & 3u, kWhiteBubble);
  const vec3 center = viewPoint(place[k].xyz);
  const float z = center.z;
  if (!(z > nearestDrawn())) return;
  // Dots smaller than a pixel keep their light
  const float wide = kSizes[kind] * size / metersAPixel(z), radius = clamp(wide, 1.0, kWhiteMaxPixels);
  const float opacity = kOpacities[kind] * min(wide * wide, 1.0);
  const vec2 at = pixelOf(center);
  if (!all(lessThan(abs(at), vec2(1e6)))) return;
  const ivec2 low = max(ivec2(floor(at - radius)), ivec2(0));
  const ivec2 high = min(ivec2(floor(at + radius)), ivec2(view.width, view.height) - 1);
  // Foam floats on the surface that the spheres' smoothing has moved
  const float lift = kind == kWhiteBubble ? 0.0 : kind == kWhiteFoam ? 1.5 * view.spacing : 0.5 * view.spacing;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const vec2 off = (vec2(x, y) + 0.5 - at) / radius;
      const float rest = 1.0 - dot(off, off);
      if (rest <= 0.0) continue;
      const uint pixel = uint(y) * view.width + uint(x);
      if (z >= scene_depth[pixel]) continue;
      const float depth = opacity * rest * rest, below = z - lift - pixelDepth(surface[pixel]);
      if (surface[pixel].x >= kNoDepthBits || below <= 0.0) {
        add(kWhiteLayers * pixel, depth);
      } else if (look.scatter.w == 0.0) {
        const vec3 through = depth * exp(-2.0 * look.absorption.rgb * below);  // light comes through as much water
        for (uint c = 0u; c < 3u; ++c) add(kWhiteLayers * pixel + 1u + c, through[c]);
      }
    }
}
