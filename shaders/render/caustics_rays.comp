#version 460
// Where the sunlight of each photon lands: refracted where it enters the fluid and where it leaves it, absorbed in between.
// With SOLIDS it may land on them. SEVERAL, a binding number: of fluids with absorptions of their own.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/caustics.glsl"
#include "render/fresnel.glsl"
#include "shared/arrays.glsl"
#ifdef SEVERAL
#include "render/look_records.h"
layout(std140, set = 0, binding = SEVERAL) uniform Look { LookRecord look; };
READ_UINT(SEVERAL + 1, thickness)  // of each fluid
#include "render/fluid_bodies.glsl"
#endif

layout(local_size_x = kCausticGroup) in;
READ_FLOAT4(1, smoothed)
READ_FLOAT4(2, front)
READ_FLOAT4(3, back)
layout(std430, set = 0, binding = 4) writeonly buffer Landings { uvec4 landings[]; };
#ifdef SOLIDS
layout(set = 0, binding = 5) uniform texture2D light_depth;
#endif

const float kAbove = 0.3;                  // spacings: smoothed spheres are this far outside of the fluid
const vec2 kDryGap = vec2(0.5, 1.5);       // spacings between fluid and floor: from wet to dry
const float kEdgeOn = 0.05;                // least cosine between the sun and a surface
const int kExitSteps = 1, kHitSteps = 16;  // along a ray

// Depth of a surface at a place of the sun's view in texels, and its change per m: between the texels of one surface, the outermost there.
// noDepth() where no texel has a surface. `outwards`: 1 of the first surface, -1 of the last.
vec3 between(vec2 at, vec4 a, vec4 b, vec4 c, vec4 d, float outwards) {
  const vec2 part = fract(at);
  vec4 shares = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
  const float rise = sun.texel * sun.slope;
  const vec4 none = vec4(a.w, b.w, c.w, d.w), level = vec4(a.x, b.x, c.x - rise, d.x - rise);
  const vec4 front = mix(outwards * level, vec4(noDepth()), lessThan(none, vec4(0.5)));
  const float outermost = min(min(front.x, front.y), min(front.z, front.w));
  if (outermost >= noDepth()) return vec3(noDepth(), 0.0, 0.0);
  shares *= vec4(lessThan(front - outermost, vec4(sun.range + sun.texel)));
  const vec3 sum = shares.x * a.xyz + shares.y * b.xyz + shares.z * c.xyz + shares.w * d.xyz;
  const float whole = shares.x + shares.y + shares.z + shares.w;
  return whole > 0.0 ? sum / whole : vec3(noDepth(), 0.0, 0.0);
}

uint cornerOf(vec2 at, ivec2 corner) {
  return texelIndex(clamp(ivec2(floor(at)) + corner, ivec2(0), ivec2(sun.width, sun.height) - 1));
}
vec3 firstAt(vec2 at) {
  return between(at, frontAt(cornerOf(at, ivec2(0, 0))), frontAt(cornerOf(at, ivec2(1, 0))), frontAt(cornerOf(at, ivec2(0, 1))),
                 frontAt(cornerOf(at, ivec2(1, 1))), 1.0);
}
vec3 lastAt(vec2 at) {
  return between(at, backAt(cornerOf(at, ivec2(0, 0))), backAt(cornerOf(at, ivec2(1, 0))), backAt(cornerOf(at, ivec2(0, 1))),
                 backAt(cornerOf(at, ivec2(1, 1))), -1.0);
}

// What is covered, and thickness in m.
vec2 bodyAt(vec2 at) {
  const vec2 part = fract(at);
  return mix(mix(smoothedAt(cornerOf(at, ivec2(0, 0))).zw, smoothedAt(cornerOf(at, ivec2(1, 0))).zw, part.x),
             mix(smoothedAt(cornerOf(at, ivec2(0, 1))).zw, smoothedAt(cornerOf(at, ivec2(1, 1))).zw, part.x), part.y);
}

// 1/m, mean along the sun's ray.
vec3 absorptionAt(vec2 at) {
#ifdef SEVERAL
  const vec2 part = fract(at);
  Interior sums = noInterior();
  float meters = 0.0;
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) {
    float counts = 0.0;
    for (int k = 0; k < 4; ++k) {
      const ivec2 corner = ivec2(k & 1, k >> 1);
      const vec2 share = mix(1.0 - part, part, vec2(corner));
      counts += share.x * share.y * float(thicknessAt(fluid * sun.width * sun.height + cornerOf(at, corner)));
    }
    addFluid(sums, fluid, counts * sun.thickness);
    meters += counts * sun.thickness;
  }
  return meanOf(sums, meters).absorption;
#else
  return sun.absorption.rgb;
#endif
}

float alongWorld(int axis, vec3 p) { return dot(sun.world[axis].xyz, p) + sun.world[axis].w; }

#ifdef SOLIDS
// Whether a solid is before this point.
bool hidden(vec3 p, float bias) {
  const ivec2 texel = ivec2(floor(p.xy / sun.texel + 0.5));
  if (!inView(texel)) return false;
  const float stored = texelFetch(light_depth, texel, 0).r;
  return stored < 1.0 && stored * sun.depths < p.z - bias;
}
#endif

// A ray that is refracted once more, or mirrored, at its end.
struct Path {
  vec3 from, along;
  float inside;  // m, in the fluid
  vec3 onwards;
};
vec3 pointOf(Path path, float s) {
  return path.from + path.along * min(s, path.inside) + path.onwards * max(s - path.inside, 0.0);
}
float toFloor(vec3 p, vec3 along) {
  const float falls = -dot(sun.world[1].xyz, along);
  return sun.stage.w > 0.0 && falls > 1e-3 ? max(alongWorld(1, p), 0.0) / falls : noDepth();
}

void main() {
  const uint index = invocation(), columns = kCausticFine * sun.width;
  if (index >= columns * kCausticFine * sun.height) return;
  landings[index] = uvec4(0u);
  const vec2 fine = vec2(index % columns, index / columns);
  const vec2 at = (fine + 0.5) / float(kCausticFine) - 0.5;
  const vec2 body = bodyAt(at);
  const float coverage = coverageOf(body.x);
  if (coverage <= 0.0) return;
  const vec3 first = firstAt(at);
  if (first.x >= noDepth()) return;
  const float refraction = sun.absorption.w;
  const vec3 normal = normalize(vec3(first.yz, -1.0));
  const float cosine = max(-normal.z, kEdgeOn);
  Path path;
  path.from = vec3(at * sun.texel, first.x + kAbove * sun.spacing / max(cosine, 0.3));
  path.along = normalize(refract(vec3(0.0, 0.0, 1.0), normal, 1.0 / refraction));
  float share = coverage * (1.0 - fresnel(cosine, refraction));
#ifdef SOLIDS
  if (hidden(path.from, 0.5 * sun.spacing)) return;
#endif
  // The end of the ray in the fluid
  const float floor_at = toFloor(path.from, path.along);
  vec3 end = lastAt(at);
  const float straight = end.x - first.x - kAbove * sun.spacing * (1.0 / max(cosine, 0.3) + min(length(vec3(end.yz, 1.0)), 3.0));
  // Newton's method
  float inside = max(end.x - path.from.z, 0.0) / max(path.along.z - dot(end.yz, path.along.xy), 0.2);
  RILL_LOOP for (int k = 0; k < kExitSteps; ++k) {
    const vec3 p = path.from + inside * path.along;
    end = lastAt(p.xy / sun.texel);
    if (end.x < noDepth())
      inside = clamp(inside + (end.x - p.z) / max(path.along.z - dot(end.yz, path.along.xy), 0.2), 0.0, 1e4 * sun.spacing);
  }
  const vec3 exit_normal = normalize(vec3(-end.yz, 1.0));
  inside = max(inside - kAbove * sun.spacing / max(dot(exit_normal, path.along), 0.3), 0.0);
  const float dry = smoothstep(kDryGap.x, kDryGap.y, (floor_at - inside) / sun.spacing);
  path.inside = dry > 0.0 ? inside : floor_at;
  path.onwards = path.along;
  float leaving = 1.0;
  if (dry > 0.0 && end.x < noDepth()) {
    const vec3 bent = refract(path.along, -exit_normal, refraction);
    const float outer = dot(bent, exit_normal);
    // Where it is reflected in total it goes on, if that is down.
    vec3 onwards = dot(bent, bent) > 0.5 ? bent : reflect(path.along, exit_normal);
    if (dot(sun.world[1].xyz, onwards) > -1e-2 && dot(bent, bent) < 0.5) onwards = path.along;
    path.onwards = normalize(mix(path.along, onwards, dry));
    if (outer > 0.0) leaving = mix(1.0, 1.0 - fresnel(outer, refraction), dry);
  }
  const float dry_floor = toFloor(pointOf(path, path.inside), path.onwards);
  float whole = dry > 0.0 ? path.inside + dry_floor : floor_at;
  float wet = min(path.inside, whole);
  bool solid = false;
#ifdef SOLIDS
  // In even steps to the floor, then by halves
  const float farthest = min(whole, path.inside + 2.0 * sun.depths), bias = sun.texel;
  float reached = 0.0, step = farthest / float(kHitSteps);
  RILL_LOOP for (int k = 0; k < kHitSteps; ++k) {
    solid = solid || hidden(pointOf(path, reached + step), bias);
    if (!solid) reached += step;
  }
  if (solid) {
    RILL_LOOP for (int k = 0; k < 5; ++k) {
      step *= 0.5;
      if (!hidden(pointOf(path, reached + step), bias)) reached += step;
    }
    whole = reached;
    wet = min(wet, whole);
    leaving = mix(1.0, leaving, smoothstep(kDryGap.x, kDryGap.y, (whole - path.inside) / sun.spacing));
  }
#endif
  if (whole >= 0.5 * noDepth()) return;
  vec3 landing = pointOf(path, whole);
  // Walls mirror: light that goes down in water meets glass and air at more than the critical angle.
  if (!solid && dry < 0.5)
    for (int axis = 0; axis < 3; axis += 2) {
      const float x = alongWorld(axis, landing), far = sun.stage[axis];
      const float back = x < 0.0 && (sun.closed >> (2 * axis) & 1u) != 0u       ? -x
                         : x > far && (sun.closed >> (2 * axis + 1) & 1u) != 0u ? max(2.0 * far - x, 0.0)
                                                                               : x;
      landing += (back - x) * sun.world[axis].xyz;
    }
  // Of the path between the surfaces, what is fluid; its sums over particles vary about 1
  const float fluid = clamp(body.y / max(straight, 0.1 * sun.spacing), 0.0, 1.25) * wet;
  const vec3 light = share * leaving * exp(-absorptionAt(at) * fluid);
  const vec2 place = (landing.xy / sun.texel + 0.5) * float(kCausticFine) - 0.5;
  const float texels = min(whole * float(kCausticFine) / sun.texel, 6e4) + 1.0;  // never 0
  landings[index] = uvec4(floatBitsToUint(place), packHalf2x16(light.rg), packHalf2x16(vec2(light.b, solid ? -texels : texels)));
}
