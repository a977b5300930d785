// Camera and spheres for all shaders of the particle view.
#include "shared/active.glsl"
#include "shared/dont_unroll.glsl"
#include "views/particle_records.h"
#include "shared/no_depth.h"

layout(push_constant) uniform Push { ViewPush view; };

uint groupIndex() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

vec3 eyePoint() { return vec3(view.eye[0], view.eye[1], view.eye[2]); }
vec3 rightAxis() { return vec3(view.right[0], view.right[1], view.right[2]); }
vec3 upAxis() { return vec3(view.up[0], view.up[1], view.up[2]); }
vec3 forwardAxis() { return vec3(view.forward[0], view.forward[1], view.forward[2]); }
vec3 particlePoint(vec3 stored) { return stored + vec3(view.offset[0], view.offset[1], view.offset[2]); }

// From world to view space: right, up, forward.
vec3 viewPoint(vec3 world) {
  const vec3 d = world - eyePoint();
  return vec3(dot(d, rightAxis()), dot(d, upAxis()), dot(d, forwardAxis()));
}

// The direction of a point of the image (pixels from its top left corner): right and up over forward.
vec2 tangentOf(vec2 pixel) {
  return vec2(pixel.x - 0.5 * float(view.width), 0.5 * float(view.height) - pixel.y) / view.focal;
}
vec2 pixelOf(vec2 tangent) {
  return vec2(0.5 * float(view.width) + tangent.x * view.focal, 0.5 * float(view.height) - tangent.y * view.focal);
}
vec3 rayOf(vec2 tangent) { return forwardAxis() + rightAxis() * tangent.x + upAxis() * tangent.y; }

// At least so large that a disc covers a pixel's center at any position.
float drawnRadius(float depth) { return max(view.radius, 0.71 * depth / view.focal); }

// Depth of a sphere's near side (view space) along a ray; negative on a miss or in front of the near plane. Measured from the ray's
// point nearest to the center, which keeps the precision of small distant spheres.
float sphereDepth(vec3 center, float radius, vec2 tangent) {
  precise float inverse = 1.0 / (1.0 + tangent.x * tangent.x + tangent.y * tangent.y);
  precise float middle = (center.z + center.x * tangent.x + center.y * tangent.y) * inverse;
  precise vec3 miss = vec3(center.x - middle * tangent.x, center.y - middle * tangent.y, center.z - middle);
  precise float inside = radius * radius - (miss.x * miss.x + miss.y * miss.y + miss.z * miss.z);
  if (inside <= 0.0) return -1.0;
  precise float depth = middle - sqrt(inside * inverse);
  return depth >= view.near_depth ? depth : -1.0;
}

// True if no part of the sphere is behind the near plane and inside the image.
bool outsideImage(vec3 center, float radius) {
  const vec2 corner = 0.5 * vec2(float(view.width), float(view.height)) / view.focal;
  const vec2 reach = radius * sqrt(1.0 + corner * corner) + corner * center.z;
  return center.z + radius <= view.near_depth || abs(center.x) >= reach.x || abs(center.y) >= reach.y;
}

// First and last pixel (inclusive) that a sphere can cover; empty if last < first.
ivec4 sphereRect(vec3 center, float radius) {
  const ivec4 whole = ivec4(0, 0, int(view.width) - 1, int(view.height) - 1);
  if (center.z - radius <= view.near_depth) return whole;
  const float square = (center.z - radius) * (center.z + radius);
  const vec2 spread = radius * sqrt(center.xy * center.xy + square);
  const vec2 low = (center.xy * center.z - spread) / square;
  const vec2 high = (center.xy * center.z + spread) / square;
  const vec2 first = pixelOf(vec2(low.x, high.y)) - 0.52, last = pixelOf(vec2(high.x, low.y)) - 0.48;
  const vec2 limit = vec2(float(view.width), float(view.height));
  return ivec4(ivec2(ceil(clamp(first, vec2(0.0), limit))), ivec2(floor(clamp(last, vec2(-1.0), limit - 1.0))));
}

float pixelDepth(vec3 center, float radius, ivec2 pixel) { return sphereDepth(center, radius, tangentOf(vec2(pixel) + 0.5)); }
