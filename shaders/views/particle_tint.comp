#version 460
// Color, ambient occlusion and shadow, once per particle that may be visible.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 2) readonly buffer Velocity { vec4 velocity[]; };
layout(std430, set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 4) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 5) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 6) readonly buffer LightMap { uint light_map[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Tint { uvec2 tint[]; };
#ifdef MIXED
layout(std430, set = 0, binding = 8) readonly buffer Concentration { vec4 concentration[]; };
#include "shared/mixture.glsl"
#endif
#define LIGHT_MAP_READ
#include "views/particle_light.glsl"

// Of a particle by its fluids.
vec3 fluidColor(uint i) {
  const uint own = min(uint(position[i].w + 0.5), kViewFluids - 1u);
#ifdef MIXED
  vec3 color = vec3(0.0);
  for (uint fluid = 0u; fluid < kViewFluids; ++fluid) color += shareOf(fluid, own, concentration[i]) * scene.fluids[fluid].rgb;
  return color;
#else
  return scene.fluids[own].rgb;
#endif
}

vec3 particleColor(uint i) {
  const vec4 v = velocity[i];
  const bool asleep = scene.asleep.w > 0.0 && view.time > 0.0 && v.xyz == vec3(0.0);  // what is awake always moves a little
  if (view.coloring == kByFluid) {
    const vec3 own = fluidColor(i);
    return asleep ? mix(own, scene.asleep.rgb, 0.5) : own;
  }
  if (view.coloring == kBySpeed && asleep) return scene.asleep.rgb;
  float value = (view.coloring == kByCompression ? v.w - 1.0 : length(v.xyz)) * view.scale;
  if ((floatBitsToUint(value) & 0x7F800000u) == 0x7F800000u) value = 0.0;
  const float at = clamp(value, 0.0, 1.0) * float(kColors - 1u);
  const uint entry = min(uint(at), kColors - 2u) + view.coloring * kColors;
  return mix(scene.colors[entry].rgb, scene.colors[entry + 1u].rgb, at - floor(min(at, float(kColors - 2u))));
}

float depthAround(vec2 pixel, float low, float high) {
  const ivec2 at = clamp(ivec2(floor(pixel)), ivec2(0), ivec2(view.width, view.height) - 1);
  return clamp(uintBitsToFloat(depth[uint(at.y) * view.width + uint(at.x)]), low, high);
}

// Screen-space ambient occlusion: pairs of opposite neighbors that are both nearer than the particle.
float openness(vec3 center, float radius) {
  const vec2 middle = pixelOf(center.xy / center.z);
  const float reach = radius / center.z * view.focal;
  const float low = center.z - 6.0 * radius, high = center.z + 3.0 * radius;
  float sum = 0.0;
  RILL_LOOP for (int ring = 0; ring < 2; ++ring) {
    RILL_LOOP for (int k = 0; k < 4; ++k) {
      const float angle = 0.7853982 * (float(k) + 0.5 * float(ring));
      const vec2 offset = reach * (ring == 0 ? 2.0 : 4.0) * vec2(cos(angle), sin(angle));
      const float pair = 0.5 * (depthAround(middle + offset, low, high) + depthAround(middle - offset, low, high));
      sum += clamp((center.z - 0.6 * radius - pair) / (3.0 * radius), 0.0, 1.0);
    }
  }
  return 1.0 - sum / 8.0;
}

void main() {
  const uint k = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  const uint small = counters[kSmallCount];
  if (k >= small + counters[kLargeCount]) return;
  const uint i = k < small ? survivors[k] : survivors[view.count - 1u - (k - small)];
  const vec3 world = particlePoint(position[i].xyz);
  const vec3 root = sqrt(particleColor(i));
  if (view.unlit != 0u) {
    tint[i] = uvec2(packUnorm2x16(root.rg), uint(root.b * 65535.0 + 0.5));
    return;
  }
  const vec3 center = viewPoint(world);
  const float radius = drawnRadius(center.z);
  const float open = center.z > radius ? openness(center, radius) : 1.0;
  const float light = lightVisibility(world, 5.0 * view.radius);
  tint[i] = uvec2(packUnorm2x16(root.rg), uint(root.b * 65535.0 + 0.5) | uint(open * 255.0 + 0.5) << 16 | uint(light * 255.0 + 0.5) << 24);
}
