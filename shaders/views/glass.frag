#version 460
// Light that a glass tank's faces add to what is seen through them.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "render/look_records.h"
#include "render/fresnel.glsl"

layout(std140, set = 0, binding = 1) uniform Look { LookRecord look; };
#include "render/sky.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in uint edge;
layout(location = 0) out vec4 color;

const float kIndex = 1.52;     // of soda-lime glass
const float kAbsorbed = 0.03;  // of the light through a pane
// Light that leaves an edge has passed through much of the glass, whose iron absorbs red most.
const vec3 kEdgeColor = vec3(0.30, 0.62, 0.52);
#ifdef FRONT
const float kEdgeCover = 0.45;
#else
const float kEdgeCover = 0.2;  // refracted by the fluid, edges would be bright bands in it
#endif
#ifdef ENVIRONMENT
const float kAround = 1.0;
#else
const float kAround = 0.3;  // the studio is darker around the tank than the sky that the fluid reflects
#endif
const float kGlint = 400.0;  // exponent of the sun's reflection
const float kGlintRadiance = 18.0;  // relative to a white surface in the sun

void main() {
  const vec3 sight =
      view.perspective > 0.0 ? normalize(position - worldPoint(vec3(0.0))) : worldDirection(vec3(0.0, 0.0, 1.0));
  const float cosine = min(abs(dot(sight, normal)), 1.0);
  const vec3 mirrored = reflect(sight, normal), sun = look.light.xyz;
  const float face = fresnel(cosine, kIndex);
  const vec3 sky = kAround * skyColor(mirrored, sun, 0.0) + sunlight() * pow(max(dot(mirrored, sun), 0.0), kGlint) * kGlintRadiance;
  if (edge == 0u) {
    const float both = 2.0 * face / (1.0 + face);  // what both faces reflect, in any number of reflections between them
    color = vec4(sky * both, 1.0 - (1.0 - both) * (1.0 - kAbsorbed));
    return;
  }
  const vec3 inside = kEdgeColor * kEdgeCover * (0.5 * skyLight(vec3(0.0, 1.0, 0.0)) + 0.25 * sunlight());
  color = vec4(mix(inside, sky, face), kEdgeCover + (1.0 - kEdgeCover) * face);
}
