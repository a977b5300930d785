#version 460
// The fluid over what was drawn before it: reflection of the sky, refraction of the scene, absorption by thickness (Beer and Lambert).
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "render/look_records.h"

layout(std140, set = 0, binding = 0) uniform Look { LookRecord look; };
#include "render/sky.glsl"
layout(std430, set = 0, binding = 2) readonly buffer Surface { uvec2 surface[]; };
layout(std430, set = 0, binding = 3) readonly buffer Thickness { uint thickness[]; };
layout(std430, set = 0, binding = 4) readonly buffer SceneColour { uvec2 scene_colour[]; };
layout(std430, set = 0, binding = 5) readonly buffer SceneDepth { float scene_depth[]; };
layout(location = 0) out vec4 colour;

const float kFarthest = 1e4;    // spacings that a ray is followed
const int kFollow = 3;          // looks at the scene's depth for where it ends
const float kFaces = 2.0;       // spacings around a pixel whose faces bend its light together
const float kMostFaces = 48.0;  // the same in pixels, at most
const float kSameWater = 4.0;   // spacings of depth between faces of one piece of water
const uint kFaceLooks = 12u;    // along a spiral

vec3 sceneAt(ivec2 pixel) {
  const uvec2 packed = scene_colour[uint(pixel.y) * view.width + uint(pixel.x)];
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

// Torn water shows many faces, and light goes through several of them: it is bent by their mean, where one alone would make a lens of each
// drop. What is smooth has the same normal all around.
vec3 meanNormal(vec2 middle, float z, vec3 normal) {
  const float reach = min(kFaces * view.spacing / metresAPixel(z), kMostFaces);
  vec3 sum = normal;
  RILL_LOOP for (uint k = 0u; k < kFaceLooks; ++k) {
    const float angle = 2.3999632 * float(k), far = reach * sqrt((float(k) + 0.5) / float(kFaceLooks));
    const ivec2 at = clamp(ivec2(middle + far * vec2(cos(angle), sin(angle))), ivec2(0), ivec2(view.width, view.height) - 1);
    const uvec2 other = surface[uint(at.y) * view.width + uint(at.x)];
    if (abs(pixelDepth(other) - z) >= kSameWater * view.spacing) continue;
    const vec3 face = unpackNormal(other.y);
    sum += clamp(2.0 * dot(face, normal), 0.0, 1.0) * face;
  }
  const float length_ = length(sum);
  return length_ > 1.0e-3 ? sum / length_ : normal;
}

// Of unpolarised light that meets the surface at this cosine (Fresnel).
float fresnel(float cosine, float index) {
  const float sine = sqrt(max(1.0 - cosine * cosine, 0.0)) / index;
  const float inner = sqrt(max(1.0 - sine * sine, 0.0));
  const float s = (cosine - index * inner) / (cosine + index * inner);
  const float p = (inner - index * cosine) / (inner + index * cosine);
  return 0.5 * (s * s + p * p);
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(view.left, view.top);
  const uint index = uint(pixel.y) * view.width + uint(pixel.x);
  const uvec2 own = surface[index];
  const float z = pixelDepth(own);
  if (!(z < scene_depth[index]) || isinf(z)) discard;
  const vec2 middle = vec2(pixel) + 0.5, axis = axisOf(middle);
  const vec3 along = rayAlong(axis);
  const vec3 point = rayFrom(axis) + z * along;
  const vec3 sight = normalize(along);
  vec3 normal = unpackNormal(own.y);
  // A normal that looks away at a silhouette is turned until it is seen edge on.
  const float facing = dot(normal, sight);
  if (facing > -0.02) normal = normalize(normal - (facing + 0.02) * sight);
  const float cosine = clamp(-dot(normal, sight), 0.0, 1.0);
  const vec3 world_normal = worldDirection(normal), world_sight = worldDirection(sight);
  const vec3 sun = look.light.xyz;
  const float lit = max(dot(world_normal, sun), 0.0);
  const vec3 ambient = skyLight(world_normal);
  const float reflected = fresnel(cosine, look.absorption.w);
  const vec3 mirrored = reflect(world_sight, world_normal);
  const vec3 sky = skyColour(mirrored, sun);
  const float highlight = pow(max(dot(mirrored, sun), 0.0), look.finish.x) * look.light.w;

  vec3 body;
  if (look.scatter.w > 0.0) {
    body = look.scatter.rgb * (ambient + vec3(1.0, 0.95, 0.88) * lit);
  } else {
    vec3 faces = meanNormal(middle, z, normal);
    const float seen = dot(faces, sight);
    if (seen > -0.02) faces = normalize(faces - (seen + 0.02) * sight);
    const vec3 bent = refract(sight, faces, 1.0 / look.absorption.w);
    float inside = thicknessAt(middle);
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
    const float metres = min(inside, walked);
    const vec3 through = exp(-look.absorption.rgb * metres);
    body = sceneBetween(there, z) * through + look.scatter.rgb * (ambient + vec3(0.5) * (0.3 + 0.7 * lit)) * (1.0 - through);
  }
  const vec3 fluid = mix(body, sky, reflected) + vec3(1.0, 0.95, 0.86) * (reflected * highlight);
  colour = vec4(mix(sceneAt(pixel), fluid, pixelCoverage(own)), 1.0);
  gl_FragDepth = targetDepth(z);
}
