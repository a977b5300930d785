#version 460
// The fluid over what was drawn before it: reflection of the sky, refraction of the scene, absorption by thickness (Beer and Lambert).
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "render/look_records.h"

layout(std140, set = 0, binding = 0) uniform Look { LookRecord look; };
#include "render/sky.glsl"
layout(std430, set = 0, binding = 2) readonly buffer Surface { uvec2 surface[]; };
layout(std430, set = 0, binding = 3) readonly buffer Thickness { uint thickness[]; };
layout(std430, set = 0, binding = 4) readonly buffer SceneColor { uvec2 scene_color[]; };
layout(std430, set = 0, binding = 5) readonly buffer SceneDepth { float scene_depth[]; };
layout(std430, set = 0, binding = 6) readonly buffer Faces { uint faces[]; };  // mean normal, a sample that holds fluid
layout(std430, set = 0, binding = 7) readonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(location = 0) out vec4 color;
#include "render/surface_mean.glsl"

const float kFarthest = 1e4;    // spacings that a ray is followed
const int kFollow = 3;          // looks at the scene's depth for where it ends
const float kEdgeOn = -0.02;    // cosine to the line of sight beyond which a face would not be seen
// Lengths of the mean of the faces around: a lone ball has 0.1, a straight silhouette a half, an even surface 1.
const vec2 kDrop = vec2(0.2, 0.7);  // from a drop to a surface
const vec2 kMirror = vec2(0.2, 0.5);  // to one that mirrors
const vec2 kEven = vec2(0.6, 0.9);  // to one that mirrors the sun
const vec2 kTorn = vec2(0.1, 0.5);  // from white to clear
const vec2 kPast = vec2(0.5, 0.9);  // cosines between the line of sight and what is mirrored, from before the face to past it
const vec3 kSunlight = vec3(1.0, 0.95, 0.88);

vec3 sceneAt(ivec2 pixel) {
  const uvec2 packed = scene_color[uint(pixel.y) * view.width + uint(pixel.x)];
  return vec3(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y).x);
}

// What stands in front of depth z is not seen: there the pixel that the place lies in counts in its stead.
vec3 sceneBehind(ivec2 pixel, ivec2 own, float z) {
  return sceneAt(scene_depth[uint(pixel.y) * view.width + uint(pixel.x)] < z ? own : pixel);
}
vec3 sceneBetween(vec2 pixel, float z) {
  const vec2 at = clamp(pixel - 0.5, vec2(0.0), pictureSize() - 1.001);
  const ivec2 base = ivec2(at), own = ivec2(pixel);
  const ivec2 next = min(base + 1, ivec2(view.width, view.height) - 1);
  const vec2 part = at - vec2(base);
  return mix(mix(sceneBehind(base, own, z), sceneBehind(ivec2(next.x, base.y), own, z), part.x),
             mix(sceneBehind(ivec2(base.x, next.y), own, z), sceneBehind(next, own, z), part.x), part.y);
}

float thicknessAt(vec2 pixel) {
  const uint step = uint(look.finish.y);
  const ivec2 grid = ivec2((uvec2(view.width, view.height) + step - 1u) / step);
  const vec2 at = clamp(pixel / float(step) - 0.5, vec2(0.0), vec2(grid) - 1.0);
  const ivec2 base = ivec2(at), next = min(base + 1, grid - 1);
  const vec2 part = at - vec2(base);
  const float a = float(thickness[base.y * grid.x + base.x]), b = float(thickness[base.y * grid.x + next.x]);
  const float c = float(thickness[next.y * grid.x + base.x]), d = float(thickness[next.y * grid.x + next.x]);
  return mix(mix(a, b, part.x), mix(c, d, part.x), part.y) * look.finish.z;
}

struct Around {
  vec3 mean;    // unit vector: of those of this water
  float alike;  // how much those around have in common, of whatever water: a tenth in spray, 1 where all is even
};

// Torn water shows many faces, and light goes through several of them: it is bent by their mean, where one alone would make a lens of each
// drop. What is smooth has the same normal all around.
Around facesAround(vec2 middle, float z, vec3 normal, vec3 sight) {
  const ivec2 grid = ivec2(sampleGrid());
  const vec2 at = sampleOf(middle);
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - vec2(base);
  const float change = changeOf(spacingAt(z), metersAPixel(z) * float(view.step), normal, sight);
  vec3 sum = vec3(0.0);
  float lengths = 0.0, weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1), s = clamp(base + corner, ivec2(0), grid - 1);
    const uint there = uint(s.y * grid.x + s.x);
    const float depth = uintBitsToFloat(samples[there].x);
    if (depth == infinity()) continue;
    const vec3 mean = unpackMean(faces[there]);
    const vec2 share = mix(1.0 - part, part, vec2(corner));
    sum += share.x * share.y * sameWater(depth - z, change) * mean;
    lengths += share.x * share.y * length(mean);
    weights += share.x * share.y;
  }
  const float size = length(sum);
  return Around(size > 1e-4 ? sum / size : normal, weights > 1e-4 ? lengths / weights : kDrop.x);
}

// Of unpolarized light that meets the surface at this cosine (Fresnel).
float fresnel(float cosine, float index) {
  const float sine = sqrt(max(1.0 - cosine * cosine, 0.0)) / index;
  const float inner = sqrt(max(1.0 - sine * sine, 0.0));
  const float s = (cosine - index * inner) / (cosine + index * inner);
  const float p = (inner - index * cosine) / (inner + index * cosine);
  return 0.5 * (s * s + p * p);
}

// What a fluid that light goes through sends to the eye before its own reflection. `scattered`: light that falls on it.
vec3 seenThrough(ivec2 pixel, vec3 point, vec3 sight, Around around, vec3 scattered) {
  const uint index = uint(pixel.y) * view.width + uint(pixel.x);
  const vec2 middle = vec2(pixel) + 0.5;
  const float z = point.z;
  vec3 face = around.mean;
  const float facing = dot(face, sight);
  if (facing > kEdgeOn) face = normalize(face - (facing - kEdgeOn) * sight);
  // A drop does not bend light: all the fluid behind it would bend as it does. Nor does the near plane, where the eye is in the fluid.
  const float bends = z <= nearestDrawn() ? 0.0 : smoothstep(kDrop.x, kDrop.y, around.alike);
  const vec3 bent = normalize(mix(sight, refract(sight, face, 1.0 / look.absorption.w), bends));
  float inside = thicknessAt(middle);
  // Torn fluid is full of air and sends back white light from all sides.
  const float white = look.finish.w * (1.0 - smoothstep(kTorn.x, kTorn.y, around.alike)) * (1.0 - exp(-inside / view.spacing));
  // Bent inside the fluid, parallel to what it was after it: followed to where the scene's depth says that it ends.
  const float farthest = kFarthest * view.spacing;
  float walked = (min(scene_depth[index], farthest) - z) / sight.z;
  vec2 there = middle;
  float beyond = scene_depth[index];
  for (int turn = 0; turn < kFollow; ++turn) {
    const vec3 at = point + bent * min(walked, inside) + sight * max(walked - inside, 0.0);
    if (at.z > view.near_depth) {
      there = clamp(pixelOf(at), vec2(0.0), pictureSize() - 1.0);
      beyond = scene_depth[uint(there.y) * view.width + uint(there.x)];
      walked = max(walked + (min(beyond, farthest) - at.z) / max(walked < inside ? bent.z : sight.z, 0.1), 0.0);
      inside = max(inside, thicknessAt(there));
    }
  }
  // What stands in front of the fluid is not seen through it.
  if (beyond < z) {
    there = middle;
    walked = (min(scene_depth[index], farthest) - z) / sight.z;
  }
  const vec3 through = exp(-look.absorption.rgb * min(inside, walked));
  const vec3 body = sceneBetween(there, z) * through + look.scatter.rgb * scattered * (1.0 - through);
  const float turned = 0.5 + 0.5 * dot(worldDirection(around.mean), look.light.xyz);  // light goes around in it: none of it is dark
  return mix(body, skyLight(vec3(0.0, 1.0, 0.0)) + kSunlight * turned * turned, white);
}

// A face seen nearly edge on that mirrors no sky mirrors what stands behind it.
vec3 mirrorOf(ivec2 pixel, vec3 sight, vec3 mirrored) {
  const vec3 sky = skyColor(mirrored, look.light.xyz);
  const float past = smoothstep(kPast.x, kPast.y, dot(mirrored, sight)) * (1.0 - skyShare(mirrored));
  if (past <= 0.0) return sky;
  return mix(sky, sceneAt(pixel) * exp(-look.absorption.rgb * thicknessAt(vec2(pixel) + 0.5)), past);
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(view.left, view.top);
  const uint index = uint(pixel.y) * view.width + uint(pixel.x);
  const uvec2 own = surface[index];
  const float z = pixelDepth(own);
  if (!(z < scene_depth[index]) || isinf(z)) discard;
  const vec2 axis = axisOf(vec2(pixel) + 0.5);
  const vec3 along = rayAlong(axis), sight = normalize(along);
  vec3 normal = unpackNormal(own.y);
  // A normal that looks away at a silhouette is turned until it is seen edge on.
  const float facing = dot(normal, sight);
  if (facing > kEdgeOn) normal = normalize(normal - (facing - kEdgeOn) * sight);
  const float cosine = clamp(-dot(normal, sight), 0.0, 1.0);
  const vec3 world_normal = worldDirection(normal), world_sight = worldDirection(sight), mirrored = reflect(world_sight, world_normal);
  const vec3 sun = look.light.xyz;
  const float lit = max(dot(world_normal, sun), 0.0);
  const vec3 ambient = skyLight(world_normal);
  float reflected = fresnel(cosine, look.absorption.w);
  float highlight = pow(max(dot(mirrored, sun), 0.0), look.finish.x) * look.light.w;
  vec3 body, mirror;
  if (look.scatter.w > 0.0) {
    body = look.scatter.rgb * (ambient + kSunlight * lit);
    mirror = skyColor(mirrored, sun);
  } else {
    const Around around = facesAround(vec2(pixel) + 0.5, z, normal, sight);
    // Spray would glitter pixel by pixel. A straight silhouette mirrors in full.
    reflected *= z <= nearestDrawn() ? 0.0 : smoothstep(kMirror.x, kMirror.y, around.alike);
    highlight *= smoothstep(kEven.x, kEven.y, around.alike);
    body = seenThrough(pixel, rayFrom(axis) + z * along, sight, around, ambient + vec3(0.5) * (0.3 + 0.7 * lit));
    mirror = mirrorOf(pixel, world_sight, mirrored);
  }
  const vec3 fluid = mix(body, mirror, reflected) + vec3(1.0, 0.95, 0.86) * (reflected * highlight);
  color = vec4(mix(sceneAt(pixel), fluid, pixelCoverage(own)), 1.0);
  gl_FragDepth = targetDepth(z);
}
