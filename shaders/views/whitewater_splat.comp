#version 460
// Diffuse particles as soft dots: sums of optical depth, in whole numbers, so that their order does not matter. Spray is a dot
// averaged over its path on the screen while it is exposed: a streak of the same light.
#extension GL_GOOGLE_include_directive : require
#include "render/look_records.h"
#include "render/surface.glsl"
#include "shared/arrays.glsl"
#include "views/whitewater_view_records.h"
#include "whitewater/whitewater_records.h"

layout(local_size_x = kWhiteSplatGroup) in;
layout(std140, set = 0, binding = 0) uniform Look { LookRecord look; };
layout(std430, set = 0, binding = 1) readonly buffer Exposure { WhiteExposure exposure; };
layout(std430, set = 0, binding = 2) readonly buffer Place { vec4 place[]; };
layout(std430, set = 0, binding = 3) readonly buffer Motion { uvec4 motion[]; };
layout(std430, set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
READ_UINT2(5, surface)
#define SCENE_DEPTH 6
#include "render/scene_depth.glsl"
layout(std430, set = 0, binding = 7) buffer Dots { uint dots[]; };

const float kSizes[3] = float[3](0.6, 1.6, 1.2);       // of spray, foam and bubbles, over the parcel's
const float kOpacities[3] = float[3](0.9, 0.3, 0.2);   // optical depth in the middle
const float kLeastLength = 0.05;                       // radii; shorter streaks are dots

float rounding = 0.5;
void add(uint at, float depth) {
  const uint count = uint(depth * kWhiteOpacity + rounding);
  if (count > 0u) atomicAdd(dots[at], count);
}

struct Streak {
  vec2 middle, along;  // pixels; a unit vector on the screen
  float radius, size;  // pixels; from end to end
  float slope;         // change of depth a pixel, m
};

vec3 pathOf(vec3 x, vec3 v) {
  const vec3 turn = vec3(exposure.turnX, exposure.turnY, exposure.turnZ), drift = vec3(exposure.driftX, exposure.driftY, exposure.driftZ);
  return exposure.seconds * (v - drift - cross(turn, x));
}

Streak streakOf(vec3 x, vec3 path, float radius) {
  const vec3 center = viewPoint(x), from = viewPoint(x - 0.5 * path), to = viewPoint(x + 0.5 * path);
  const Streak dot_ = Streak(pixelOf(center), vec2(1.0, 0.0), radius, 0.0, 0.0);
  if (min(from.z, to.z) <= nearestDrawn()) return dot_;
  const vec2 a = pixelOf(from), b = pixelOf(to);
  const float size = distance(a, b);
  if (!(size > kLeastLength * radius && size < 1e6)) return dot_;
  // Fast drops at a coarse step of time would cross the picture
  const float shown = min(size, min(kWhiteMaxStreak * radius, kWhiteMaxStreakPixels));
  return Streak(0.5 * (a + b), (b - a) / size, radius, shown, (to.z - from.z) / size);
}

// Of the integral of a dot's profile (1 - r^2)^2 along a line that passes the middle at a distance with this remaining square.
float profileSum(float along, float square) {
  const float t = along * along;
  return along * (square * square + t * (-2.0 / 3.0 * square + 0.2 * t));
}
// The dot's profile averaged over the streak. `off`: from its middle, radii.
float profile(Streak s, vec2 off) {
  const float u = dot(off, s.along), square = 1.0 - max(dot(off, off) - u * u, 0.0), most = sqrt(max(square, 0.0));
  const float size = s.size / s.radius, low = clamp(u - 0.5 * size, -most, most), high = clamp(u + 0.5 * size, -most, most);
  return (profileSum(high, square) - profileSum(low, square)) / size;
}

// From the first to the last pixel of a row that the streak may touch.
ivec2 columnsOf(Streak s, float row) {
  const float half_ = 0.5 * s.size;
  vec2 ends = vec2(-half_, half_);
  if (abs(s.along.y) > 1e-4) {
    const vec2 crossing = (row - s.middle.y + vec2(-s.radius, s.radius)) / s.along.y;
    ends = clamp(vec2(min(crossing.x, crossing.y), max(crossing.x, crossing.y)), -half_, half_);
  }
  const vec2 columns = s.middle.x + ends * s.along.x;
  const float first = min(columns.x, columns.y) - s.radius, last = max(columns.x, columns.y) + s.radius;
  return ivec2(max(int(floor(first)), 0), min(int(floor(last)), int(view.width) - 1));
}

// Over the mean of its class: areas are distributed exponentially, as drops and bubbles are of many sizes.
float sizeOf(uint tag) { return sqrt(min(-log((float(tag >> 8u & 0xffffu) + 0.5) / 65536.0), kWhiteMaxArea)); }

void main() {
  const uint k = groupIndex() * kWhiteSplatGroup + gl_LocalInvocationIndex;
  if (k >= counts[kWhiteCount]) return;
  const uint kind = min(motion[k].w & 3u, kWhiteBubble);
  const vec3 x = place[k].xyz;
  const float z = viewPoint(x).z;
  if (!(z > nearestDrawn())) return;
  // Dots smaller than a pixel keep their light
  const float wide = kSizes[kind] * sizeOf(motion[k].w) * exposure.size / metersAPixel(z), radius = clamp(wide, 1.0, kWhiteMaxPixels);
  const float opacity = kOpacities[kind] * min(wide * wide, 1.0);
  const Streak s = streakOf(x, kind == kWhiteSpray ? pathOf(x, uintBitsToFloat(motion[k].xyz)) : vec3(0.0), radius);
  if (!all(lessThan(abs(s.middle), vec2(1e6)))) return;
  // The light of dim streaks is right in the mean of many
  if (s.size > 0.0) rounding = float(motion[k].w >> 8u) * (1.0 / 16777216.0);
  const float reach = 0.5 * s.size * abs(s.along.y) + radius;
  const int low = max(int(floor(s.middle.y - reach)), 0), high = min(int(floor(s.middle.y + reach)), int(view.height) - 1);
  // Foam floats on the surface that the spheres' smoothing has moved
  const float lift = kind == kWhiteBubble ? 0.0 : kind == kWhiteFoam ? 1.5 * view.spacing : 0.5 * view.spacing;
  for (int y = low; y <= high; ++y) {
    const ivec2 columns = columnsOf(s, float(y) + 0.5);
    for (int column = columns.x; column <= columns.y; ++column) {
      const vec2 from = vec2(column, y) + 0.5 - s.middle, off = from / radius;
      float part = 0.0;
      if (s.size > 0.0) {
        part = profile(s, off);
      } else {
        const float rest = max(1.0 - dot(off, off), 0.0);
        part = rest * rest;
      }
      if (part <= 0.0) continue;
      const uint pixel = uint(y) * view.width + uint(column);
      const float here = z + s.slope * clamp(dot(from, s.along), -0.5 * s.size, 0.5 * s.size);
      if (here >= sceneDepth(pixel)) continue;
      const float depth = opacity * part, below = here - lift - pixelDepth(surfaceAt(pixel));
      if (surfaceAt(pixel).x >= kNoDepthBits || below <= 0.0) {
        add(kWhiteLayers * pixel, depth);
      } else if (look.scatter.w == 0.0) {
        const vec3 through = depth * exp(-2.0 * look.absorption.rgb * below);  // light comes through as much water
        for (uint c = 0u; c < 3u; ++c) add(kWhiteLayers * pixel + 1u + c, through[c]);
      }
    }
  }
}
