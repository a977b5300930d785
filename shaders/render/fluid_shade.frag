#version 460
// The fluid over the host's scene: reflection of the sky, refraction of the scene, absorption by thickness (Beer-Lambert law).
// OPAQUE: reflection of the sky and the fluid's own color alone.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "render/look_records.h"
#include "render/fresnel.glsl"
#include "shared/arrays.glsl"

layout(std140, set = 0, binding = 0) uniform Look { LookRecord look; };
#include "render/sky.glsl"
READ_UINT2(2, surface)
READ_UINT2(3, scene_color)
#define SCENE_DEPTH 4
#include "render/scene_depth.glsl"
#ifndef OPAQUE
#include "render/fluid_bodies.glsl"
READ_UINT(5, thickness)  // of each fluid
READ_UINT(6, mean_normals)  // packed mean normal of each sample with fluid
READ_UINT2(7, samples)  // depth, normal
READ_UINT2(8, back)
#include "render/surface_mean_normal.glsl"
#include "render/fluid_depths.glsl"
#include "render/fluid_back.glsl"
#endif
#ifdef CRESTS
layout(std430, set = 0, binding = CRESTS) readonly buffer Heights { vec2 heights[]; };  // of crest_heights.comp
#include "render/crests.glsl"
#endif
layout(location = 0) out vec4 color;

const float kEdgeOn = -0.02;  // largest cosine between a visible normal and the view ray

vec3 sceneAt(ivec2 pixel) {
  const uvec2 packed = scene_colorAt(uint(pixel.y) * view.width + uint(pixel.x));
  return min(vec3(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y).x), vec3(65504.0));
}

// Angle (rad) between the rays that this pixel and the next ones reflect. The built-in sky has no detail to be filtered.
float reflectedSpread(ivec2 pixel, vec3 normal) {
#ifdef ENVIRONMENT
  float change = 0.0;
  for (int k = 0; k < 2; ++k) {
    const ivec2 next = pixel + ivec2(1 - k, k);
    if (next.x >= int(view.width) || next.y >= int(view.height)) continue;
    const uvec2 other = surfaceAt(uint(next.y) * view.width + uint(next.x));
    if (pixelDepth(other) < noDepth()) change = max(change, length(unpackNormal(other.y) - normal));
  }
  return 2.0 * change + (view.perspective > 0.0 ? abs(view.scale[1]) * 2.0 / float(view.height) : 0.0);
#else
  return 0.0;
#endif
}

#ifndef OPAQUE
// Coherence, the length of the mean normal: 0.1 on a single drop, 0.5 at a straight silhouette, 1 on an even surface.
// Each effect fades between two values of it.
const vec2 kRefractionFade = vec2(0.2, 0.7);
const vec2 kReflectionFade = vec2(0.2, 0.5);
const vec2 kHighlightFade = vec2(0.6, 0.9);   // of the sun
const vec2 kWhitewaterFade = vec2(0.1, 0.5);  // from white to clear
// Cosines of the angle between a normal and the mean of those around it: from the mean to its own.
const vec2 kNormalFade = vec2(0.25, 0.5);
// Spacings between where two fluids begin on a ray: from a mixture to one before the other.
const vec2 kApart = vec2(0.5, 1.5);
// Cosines between view ray and reflected ray: from a reflection of the sky to one of the scene behind.
const vec2 kGrazing = vec2(0.5, 0.9);

// The scene's color, or that of pixel `own` where the scene is in front of depth z.
vec3 sceneUnlessInFront(ivec2 pixel, ivec2 own, float z) {
  return sceneAt(sceneDepth(uvec2(pixel)) < z ? own : pixel);
}
vec3 sceneBilinear(vec2 pixel, float z) {
  const vec2 at = clamp(pixel - 0.5, vec2(0.0), pictureSize() - 1.001);
  const ivec2 base = ivec2(at), own = ivec2(pixel);
  const ivec2 next = min(base + 1, ivec2(view.width, view.height) - 1);
  const vec2 part = at - vec2(base);
  return mix(mix(sceneUnlessInFront(base, own, z), sceneUnlessInFront(ivec2(next.x, base.y), own, z), part.x),
             mix(sceneUnlessInFront(ivec2(base.x, next.y), own, z), sceneUnlessInFront(next, own, z), part.x), part.y);
}

#include "render/fluid_thickness.glsl"
#include "render/refracted_ray.glsl"

// What fluid scatters of the light that falls on it where its surface has this normal of the scene.
vec3 scatteredLight(vec3 world_normal) {
  return skyLight(world_normal) + 0.5 * sunlight() * (0.3 + 0.7 * max(dot(world_normal, look.light.xyz), 0.0));
}

// Normal where the fluids behind the front one begin, at depth z, as if they were as thick on both sides of their middle: of a ball its
// own, and smooth, which the depth where a particle begins is not. `behind`: how thick they are on the pixel's ray, m.
vec3 normalBehind(vec2 pixel, uint front, float z, float behind) {
  const float half_step = 0.5 * float(look.finish.y), reach = max(2.0 * half_step, view.spacing / metersAPixel(z));  // pixels
  vec3 sides[4];
  for (int k = 0; k < 4; ++k) {
    const vec2 to = ((k & 1) == 0 ? -reach : reach) * (k < 2 ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
    const vec2 at = clamp(pixel + to, vec2(half_step), pictureSize() - half_step), axis = axisOf(at);
    const Around near = around(at);
    float side_thickness = 0.0;
    for (uint fluid = 0u; fluid < FLUIDS; ++fluid) side_thickness += fluid == front ? 0.0 : thicknessOf(fluid, near);
    sides[k] = rayFrom(axis) + max(z + 0.5 * (behind - side_thickness), nearestDrawn()) * rayAlong(axis);
  }
  const vec3 normal = cross(sides[1] - sides[0], sides[3] - sides[2]), along = rayAlong(axisOf(pixel));
  const float size = length(normal);
  return size > 0.0 ? normal * (dot(normal, along) > 0.0 ? -1.0 : 1.0) / size : -normalize(along);
}

// Of a ray in the fluid: what it lets through, what it adds to that, and the mean of what it meets.
struct Passage {
  vec3 through, added;
  Interior interior;
};
vec3 addedBy(Interior interior, vec3 through, vec3 scattered) {
  return (interior.scatter * scattered + interior.emission) * (1.0 - through);
}

// Over `meters` of the ray of a pixel. Of several fluids that of the nearest comes first, where it begins before the others; those behind
// it are taken to be mixed, and have a surface of their own.
Passage passage(vec2 pixel, float meters, vec3 scattered) {
  if (FLUIDS == 1u) {
    const vec3 through = exp(-look.absorption.rgb * meters);
    return Passage(through, addedBy(lookInterior(), through, scattered), lookInterior());
  }
  const Around near = around(pixel);
  float lengths[FLUIDS];
  float begins = noDepth(), next = noDepth(), sum = 0.0;
  uint front = 0u;
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) {
    const float begin = beginOf(fluid, near);
    lengths[fluid] = thicknessOf(fluid, near);
    sum += lengths[fluid];
    next = min(next, max(begin, begins));
    if (begin < begins) front = fluid;
    begins = min(begins, begin);
  }
  Interior behind = noInterior();
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) addFluid(behind, fluid, fluid == front ? 0.0 : lengths[fluid]);
  const float before_length = lengths[front], shorter = meters / max(sum, 1e-20);
  Interior mixed = behind;
  addFluid(mixed, front, before_length);
  mixed = meanOf(mixed, sum);
  const Interior before = interiorOf(front);
  const vec3 before_through = exp(-before.absorption * (shorter * before_length)), behind_through = exp(-behind.absorption * shorter);
  const vec3 through = before_through * behind_through;
  const float apart = smoothstep(kApart.x, kApart.y, (next - begins) / view.spacing);
  const bool seen = apart > 0.0 && next < noDepth();
  const vec3 scattered_behind = seen ? scatteredLight(worldDirection(normalBehind(pixel, front, next, sum - before_length))) : scattered;
  const vec3 layers = addedBy(before, before_through, scattered) +
                      before_through * addedBy(meanOf(behind, sum - before_length), behind_through, scattered_behind);
  return Passage(through, mix(addedBy(mixed, through, scattered), layers, apart), mixed);
}

struct MeanNormal {
  vec3 direction;   // unit vector, of this surface
  float coherence;  // over all surfaces around, 0 to 1
};

// Light is refracted by the mean normal: by its own, each drop of whitewater would be a lens.
MeanNormal meanNormalAt(vec2 middle, float z, vec3 normal, vec3 sight) {
  const ivec2 grid = ivec2(sampleGrid());
  const vec2 at = sampleOf(middle);
  const ivec2 base = sampleBefore(at);
  const vec2 part = max(at - vec2(base), vec2(0.0));
  const float change = allowedDepthChange(spacingAt(z), metersAPixel(z) * float(view.step), normal, sight);
  vec3 sum = vec3(0.0);
  float lengths = 0.0, weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1), s = clamp(base + corner, ivec2(0), grid - 1);
    const uint index = uint(s.y * grid.x + s.x);
    const float depth = uintBitsToFloat(samplesAt(index).x);
    if (depth >= noDepth()) continue;
    const vec3 mean = unpackMean(mean_normalsAt(index));
    const vec2 share = mix(1.0 - part, part, vec2(corner));
    sum += share.x * share.y * sameSurface(depth - z, change) * mean;
    lengths += share.x * share.y * length(mean);
    weights += share.x * share.y;
  }
  const float size = length(sum);
  return MeanNormal(size > 1e-4 ? sum / size : normal, weights > 1e-4 ? lengths / weights : kRefractionFade.x);
}

#ifdef CRESTS
// Fluid between a point and the sun, m. Of fluid with air between, what there is of it.
float depthBehindSun(vec3 p) {
  const vec3 sun = look.light.xyz;
  const vec2 at = crestPlace(p, sun, view.spacing) - 0.5;
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - vec2(base);
  const float own = dot(p, sun);
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1);
    const vec2 height = heights[crestIndex(base + corner, uint(look.crests.x))], share = mix(1.0 - part, part, vec2(corner));
    sum += share.x * share.y * clamp(height.x - own, 0.0, height.y);
  }
  return sum;
}

const float kLeastGlow = 0.001;  // of a white surface in the sky's light; less is not seen

// Sunlight that is scattered once into a ray through the fluid. Between its ends the length of the light's path is taken to
// change evenly.
vec3 scatteredSun(vec3 point, vec3 along, float size, Interior interior) {
  const float g = look.scattering.w, least = 1.0 - abs(g);
  const float narrow = max(1.0 + g * g - 2.0 * g * dot(worldDirection(along), look.light.xyz), least * least);
  const float phase = (1.0 - g * g) / (12.566371 * narrow * sqrt(narrow));
  const vec3 most = look.scattering.rgb * interior.scattering * sunlight() * (3.1415927 * phase * size);
  if (max(most.r, max(most.g, most.b)) < kLeastGlow) return vec3(0.0);
  const float first = depthBehindSun(worldPoint(point)), last = depthBehindSun(worldPoint(point + size * along));
  // The mean of exp(-loss) between both ends; each end by itself, since their difference can be a large number of either sign.
  const vec3 near = interior.absorption * first, far = interior.absorption * (size + last), rise = far - near;
  const bvec3 even = lessThan(abs(rise), vec3(1e-3));
  const vec3 mean = mix((exp(-near) - exp(-far)) / mix(rise, vec3(1.0), even), exp(-near) * (1.0 - 0.5 * rise), even);
  return most * (1.0 - fresnel(1.0, look.absorption.w)) * mean;
}
#endif

// Refracted and scattered light, without the reflection. `scattered`: incident light.
vec3 refractedLight(ivec2 pixel, vec3 point, vec3 sight, MeanNormal mean_normal, vec3 scattered, float spread) {
  const vec2 middle = vec2(pixel) + 0.5;
  const float z = point.z;
  vec3 face = mean_normal.direction;
  const float facing = dot(face, sight);
  if (facing > kEdgeOn) face = normalize(face - (facing - kEdgeOn) * sight);
  // A drop does not refract, because its refraction would apply to all fluid behind it; nor does the near plane with the eye in the fluid.
  const float bends = z <= nearestDrawn() ? 0.0 : smoothstep(kRefractionFade.x, kRefractionFade.y, mean_normal.coherence);
  const vec3 bent = normalize(mix(sight, refract(sight, face, 1.0 / look.absorption.w), bends));
  const float straight = thicknessToScene(pixel, z);
  // Whitewater is full of air and scatters white light.
  const float white = look.finish.w * (1.0 - smoothstep(kWhitewaterFade.x, kWhitewaterFade.y, mean_normal.coherence)) *
                      (1.0 - exp(-straight / view.spacing));
  const Leaving leaving = leavingRay(point, bent, sight, straight, bends);
  const RayEnd end = refractedRay(middle, point, bent, leaving);
  // At grazing angles the search may end too soon: a layer as thick as the fluid is here and there leaves at least this of the ray.
  const float layer = min(straight, leaving.thickness) * clamp(dot(face, sight) / min(dot(face, bent), kEdgeOn), 0.0, 1.0);
  const float path = max(end.inside, layer);
  const Passage fluids = passage(middle, path, scattered);
  vec3 behind = sceneBilinear(end.pixel, end.front);
#ifdef ENVIRONMENT
  behind = mix(behind, skyColor(worldDirection(leaving.direction), look.light.xyz, spread), end.outside);
#endif
  vec3 body = behind * fluids.through + fluids.added;
#ifdef CRESTS
  body += bends * scatteredSun(point, bent, path, fluids.interior);
#endif
  // Multiple scattering leaves no side dark.
  const float facing_sun = 0.5 + 0.5 * dot(worldDirection(mean_normal.direction), look.light.xyz);
  return mix(body, skyLight(vec3(0.0, 1.0, 0.0)) + sunlight() * facing_sun * facing_sun, white);
}

// At grazing angles a reflected ray below the horizon shows what is seen through the fluid, `body`.
vec3 reflectedLight(vec3 body, vec3 sight, vec3 mirrored, float spread) {
  const float past = smoothstep(kGrazing.x, kGrazing.y, dot(mirrored, sight)) * (1.0 - skyShare(mirrored));
  return mix(skyColor(mirrored, look.light.xyz, spread), body, past);
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(view.left, view.top);
  const uint index = uint(pixel.y) * view.width + uint(pixel.x);
  const uvec2 own = surfaceAt(index);
  const float z = pixelDepth(own);
  if (!(z < sceneDepth(index)) || z >= noDepth()) discard;
  const vec2 axis = axisOf(vec2(pixel) + 0.5);
  const vec3 along = rayAlong(axis), sight = normalize(along);
  vec3 normal = unpackNormal(own.y);
#ifndef OPAQUE
  const MeanNormal mean_normal = meanNormalAt(vec2(pixel) + 0.5, z, normal, sight);
  // In a gap planes can meet at an angle that no surface around has.
  normal = normalize(mix(mean_normal.direction, normal, smoothstep(kNormalFade.x, kNormalFade.y, dot(normal, mean_normal.direction))));
#endif
  // A normal that faces away at a silhouette is rotated until it is seen edge on.
  const float facing = dot(normal, sight);
  if (facing > kEdgeOn) normal = normalize(normal - (facing - kEdgeOn) * sight);
  const float cosine = clamp(-dot(normal, sight), 0.0, 1.0);
  const vec3 world_normal = worldDirection(normal), world_sight = worldDirection(sight), mirrored = reflect(world_sight, world_normal);
  const vec3 sun = look.light.xyz;
  float reflected = fresnel(cosine, look.absorption.w);
  const float spread = reflectedSpread(pixel, normal);
  // A highlight that the surface's curvature widens keeps its energy.
  const float widened = 1.0 / (1.0 + 0.25 * look.finish.x * spread * spread);
  float highlight = pow(max(dot(mirrored, sun), 0.0), look.finish.x * widened) * look.light.w * widened;
#ifdef OPAQUE
  const vec3 body = look.scatter.rgb * (skyLight(world_normal) + sunlight() * max(dot(world_normal, sun), 0.0)) + look.emission.rgb;
  const vec3 mirror = skyColor(mirrored, sun, spread);
#else
  // Reflections in spray would flicker from pixel to pixel. A straight silhouette reflects in full.
  reflected *= z <= nearestDrawn() ? 0.0 : smoothstep(kReflectionFade.x, kReflectionFade.y, mean_normal.coherence);
  highlight *= smoothstep(kHighlightFade.x, kHighlightFade.y, mean_normal.coherence);
  const vec3 body = refractedLight(pixel, rayFrom(axis) + z * along, sight, mean_normal, scatteredLight(world_normal), spread);
  const vec3 mirror = reflectedLight(body, world_sight, mirrored, spread);
#endif
  const vec3 fluid = mix(body, mirror, reflected) + sunlight() * (reflected * highlight);
  color = vec4(mix(sceneAt(pixel), fluid, pixelCoverage(own)), 1.0);
  gl_FragDepth = targetDepth(z);
}
