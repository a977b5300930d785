#version 460
// Adds the density of the layers that have not left their mouths yet to what solids displace near a particle: fluid that has left is
// under pressure, and would expand into the mouth until the next layer is born. See docs/notes/flows.md.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/images.glsl"
#include "shared/arrays.glsl"
#include "shared/flow_records.h"
#include "shared/neighbor_list.h"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { MouthDensityPush push; };
READ_FLOAT4(2, place)
layout(std430, binding = 3) readonly buffer SumsBlock { FluidSums sums; };
READ_UINT(4, nearMouths)
READ_FLOAT4(5, table)
READ_UINT(6, listHead)
layout(std430, binding = 7) buffer DisplacedBlock { vec4 nearDisplaced[]; };
layout(std430, binding = 8) readonly buffer EmitterBlock { EmitterRecord emitters[]; };
layout(std430, binding = 9) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
layout(std430, binding = 10) readonly buffer MouthPointBlock { vec2 mouthPoints[]; };
#include "fluid/half_space.glsl"
#include "fluid/mouth_frame.glsl"
#include "fluid/mouth_points.glsl"
#include "fluid/open_mouths.glsl"

// Of a slab between two planes at x: value and slope.
vec2 slab(float x, float low, float high) {
  vec2 near = face(x - high), far = face(x - low);
  return near - far;
}

// Of a rectangle in the mouth's plane: slopes along both axes, and the value.
vec3 crossSection(vec2 place, vec2 middle, vec2 half_) {
  vec2 across = slab(place.x, middle.x - half_.x, middle.x + half_.x), up = slab(place.y, middle.y - half_.y, middle.y + half_.y);
  return vec3(across.y * up.x, across.x * up.y, across.x * up.x);
}

// Of a mouth of any outline: the sum over its points, each the middle of a square of the lattice.
vec3 cellsAt(uint e, vec2 place, float half_) {
  vec2 low = place - (params.support + half_), high = place + (params.support + half_);
  uint end = emitters[e].firstPoint + emitters[e].points, k = firstMouthPoint(e, low.y, -kNever);
  vec3 sum = vec3(0.0);
  while (k < end) {  // each turn goes on by a point at least
    if (!isBetween(e, low, high, end, k)) continue;
    sum += crossSection(place, mouthPoints[k++], vec2(half_));
  }
  return sum;
}

// What the slab displaces that lies in front of the mouth, behind the last layer. Gradient, and the value in w.
vec4 mouthSample(uint e, MouthFrame frame, OpenMouth mouth, vec3 x) {
  float thickness = emitters[e].speed / emitters[e].rate, d = params.spacing;
  if (thickness > kThickestLayer * d) return vec4(0.0);  // single particles, which do not touch
  float back = -0.5 * min(thickness, d), front = (mouth.phase - 0.5) * thickness;
  if (front <= back) return vec4(0.0);
  vec3 from = x - centerOf(frame.pose);
  vec2 along = slab(dot(from, frame.normal), back, front), side = vec2(dot(from, frame.across), dot(from, frame.up));
  vec3 beside = emitters[e].shape == kRectMouth ? crossSection(side, vec2(0.0), vec2(emitters[e].halfAcross, emitters[e].halfUp)) :
                                                  cellsAt(e, side, 0.5 * d * sqrt(d / thickness));
  vec3 gradient = along.y * beside.z * frame.normal + along.x * (beside.x * frame.across + beside.y * frame.up);
  return mouth.strength * vec4(gradient, along.x * beside.z);
}

// How much of the mouth's image counts, which has x at `image`: of a mouth that reaches through a wall the part behind it counts itself,
// so that its image fades within a spacing.
float shareOfImage(uint e, MouthFrame frame, OpenMouth mouth, vec3 image) {
  float thickness = emitters[e].speed / emitters[e].rate;
  vec3 back = -0.5 * min(thickness, params.spacing) * frame.normal, front = (mouth.phase - 0.5) * thickness * frame.normal;
  vec3 beside = emitters[e].halfAcross * abs(frame.across) + emitters[e].halfUp * abs(frame.up), center = centerOf(frame.pose);
  vec3 low = wallsLow() - (center + min(back, front) - beside), high = center + max(back, front) + beside - wallsHigh();
  float share = 1.0;
  for (int a = 0; a < 3; ++a) {
    float through = image[a] < wallsLow()[a] ? low[a] : (image[a] > wallsHigh()[a] ? high[a] : 0.0);
    share *= 1.0 - clamp(through / params.spacing, 0.0, 1.0);
  }
  return share;
}

// Of the mouth and its images behind walls.
vec4 reflectedSample(uint e, MouthFrame frame, OpenMouth mouth, vec3 x) {
  vec4 sum = vec4(0.0);
  Images images = imagesNear(x, params.support);
  bool more = true;
  while (more) {  // tested at its top, as the loop in it is: docs/notes/lavapipe.md
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    vec4 one = shareOfImage(e, frame, mouth, image) * mouthSample(e, frame, mouth, image);
    sum += vec4(signs * one.xyz, one.w);
    more = advance(images);
  }
  return sum;
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearMouths) return;
  uint i = nearMouthsAt(n);
  vec3 x = placeAt(i).xyz;
  float later = push.predicted != 0u ? ahead() : 0.0;
  vec4 displaced = SOLIDS && (listHeadAt(i) & kNearSolidsBit) != 0u ? nearDisplaced[i] : vec4(0.0);
  for (uint e = 0u; e < params.emitterCount && isActive(x); ++e) {
    OpenMouth mouth;
    if (!isOpen(e, later, mouth)) continue;
    vec4 own = reflectedSample(e, mouthFrame(e, control.timeHigh + control.timeLow + later), mouth, x);
    float room = max(1.0 - displaced.w, 0.0);  // solids that overlap may displace more than there is
    displaced = vec4(displaced.xyz * max(1.0 - own.w, 0.0) + own.xyz * room, displaced.w + own.w * room);  // of their union
  }
  nearDisplaced[i] = displaced;
}
