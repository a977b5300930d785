#version 460
// Sky, and the ground: inside the domain a checker or the floor of a tank; outside plain and hazy far away, or an environment's, or a table
// above it. SKY: no ground.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/particle_records.h"
#include "render/look_records.h"

#if defined(ENVIRONMENT) || !defined(SKY)
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std140, set = 0, binding = 1) uniform Look { LookRecord look; };
#ifdef SKY
#include "render/sky.glsl"
#else
#include "views/scenery.glsl"
#endif
#endif
layout(location = 0) out vec4 color;

// A checker, averaged over a pixel `width` wide: the integral of a square wave, exactly.
vec2 waveIntegral(vec2 at) { return 2.0 * abs(fract(at * 0.5) - 0.5); }
float checker(vec2 at, vec2 width) {
  const vec2 w = max(width, vec2(1e-4));
  const vec2 mean = (waveIntegral(at + 0.5 * w) - waveIntegral(at - 0.5 * w)) / w;
  return 0.5 - 0.5 * mean.x * mean.y;
}

#ifdef ENVIRONMENT
float pixelAngle() { return view.perspective > 0.0 ? abs(view.scale[1]) * 2.0 / float(view.height) : 0.0; }

vec3 backdrop(vec3 sight) {
  const vec3 sky = skyColor(sight, look.light.xyz, pixelAngle());
  const float radius = look.sunlight.w, apart = length(sight - look.light.xyz), rim = max(pixelAngle(), 0.05 * radius);
  // The disc's radiance lights a surface that faces it by `sunlight`.
  if (radius <= 0.0 || apart > radius + rim) return sky;
  return sky + min(sunlight() / (radius * radius), 3e4) * clamp((radius - apart) / rim + 0.5, 0.0, 1.0);
}
#else
#ifdef SKY
float backdropShare() { return 1.0; }
#else
float backdropShare() { return scene.domain_max.w > 0.0 ? 1.0 : 0.3; }  // darker behind a tank
#endif
// Darker than the sky that is reflected, so that reflections are seen against it.
vec3 backdrop(vec3 sight) {
  return backdropShare() * mix(vec3(0.06, 0.08, 0.11), vec3(0.010, 0.016, 0.030), sqrt(clamp(sight.y, 0.0, 1.0)));
}
vec3 haze(vec3 sight) { return backdrop(normalize(vec3(sight.x, 0.02, sight.z))); }
vec3 groundAlbedo(bool tank) { return tank ? vec3(0.075, 0.078, 0.085) : vec3(0.115, 0.13, 0.15); }
#endif

const vec3 kTankFloor = vec3(0.66, 0.65, 0.62);  // albedo

#if defined(ENVIRONMENT) && !defined(SKY)
const vec3 kTable = vec3(0.40, 0.38, 0.35);  // albedo of a table of stone

// Where a ray meets the table that a tank stands on, in lengths of the ray; 0: nowhere. `normal` is that of the side it meets.
float tableHit(vec3 from, vec3 ray, out vec3 normal) {
  const float beyond = scene.table.x;
  const vec3 low = scene.domain_min.xyz - vec3(beyond, scene.table.y, beyond);
  const vec3 high = vec3(scene.domain_max.x + beyond, scene.domain_min.y, scene.domain_max.z + beyond);
  const vec3 slope = mix(vec3(1e-12), ray, greaterThan(abs(ray), vec3(1e-12)));
  const vec3 a = (low - from) / slope, b = (high - from) / slope, entry = min(a, b), leave = max(a, b);
  const float first = max(max(entry.x, entry.y), entry.z), last = min(min(leave.x, leave.y), leave.z);
  normal = -sign(slope) * vec3(greaterThanEqual(entry, vec3(first)));
  return first < last ? first : 0.0;
}
#endif

void main() {
  const vec2 middle = gl_FragCoord.xy - vec2(view.left, view.top), axis = axisOf(middle);
  const vec3 ray = worldDirection(rayAlong(axis)), sight = normalize(ray);
  color = vec4(backdrop(sight), 1.0);
  gl_FragDepth = clamp(view.depth_map[0], 0.0, 1.0);  // as far as a perspective goes
#ifndef SKY
  const vec3 from = worldPoint(rayFrom(axis)), sun = scene.light_to.xyz;
  vec3 normal = vec3(0.0, 1.0, 0.0);
  float z = ray.y < 0.0 ? (scene.domain_min.y - from.y) / ray.y : 0.0;
#ifdef ENVIRONMENT
  const bool table = scene.table.x > 0.0;
  if (table) z = tableHit(from, ray, normal);
#endif
  if (!(z > view.near_depth)) return;
  const vec3 p = from + z * ray;
  // How far the hit moves on its side from a pixel to the next.
  const float pixel = metersAPixel(z);
  const vec3 across = worldDirection(vec3(pixel, 0.0, 0.0)), upwards = worldDirection(vec3(0.0, pixel, 0.0));
  const float towards = min(dot(ray, normal), -1e-6);
  const vec3 right = across - ray * (dot(across, normal) / towards), up = upwards - ray * (dot(upwards, normal) / towards);
  const vec3 width = abs(right) + abs(up);
  const vec2 extent = scene.domain_max.xz - scene.domain_min.xz;
  const vec2 inner = p.xz - scene.domain_min.xz;
  const vec2 beyond = max(max(-inner, inner - extent), vec2(0.0));
  const float step = scene.domain_max.w;
  const bool inside = normal.y > 0.0 && all(equal(beyond, vec2(0.0))), tank = step <= 0.0;
  vec3 albedo = kTankFloor;
  if (inside && !tank) albedo = mix(vec3(0.34, 0.37, 0.40), vec3(0.70, 0.70, 0.68), checker(inner / step, width.xz / step));
  const float bias = 2.0 * scene.light_texel.x;
  const float facing = max(dot(sun, normal), 0.0);
  vec3 direct = vec3(0.0);
  if (facing > 0.0) direct = reaching(sunlight() * facing, p, bias, 0.5 * (width.x + width.y + width.z), false);
  const vec3 ambient = kAmbientShare * skyLight(normal);
#ifdef ENVIRONMENT
  // The picture has a ground of its own: shadows and caustics change it by as much as they do the light.
  const vec3 unshadowed = ambient + kSunShare * sunlight() * max(sun.y, 0.0), light = ambient + kSunShare * direct;
  if (table && !inside) albedo = kTable;
  color = vec4(inside || table ? albedo * light : color.rgb * light / max(unshadowed, vec3(1e-6)), 1.0);
#else
  const vec3 lit = (inside ? albedo : groundAlbedo(tank)) * (ambient + kSunShare * direct);
  const float far = length(beyond) / (1.4 * max(max(extent.x, extent.y), 1e-6));
  color = vec4(mix(lit, haze(sight), 1.0 - exp(-far * far)), 1.0);
#endif
  gl_FragDepth = clamp(targetDepth(z), 0.0, 1.0);
#endif
}
