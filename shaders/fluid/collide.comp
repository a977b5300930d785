#version 460
// Contacts with solids at the end of a substep: a centre is kept half a spacing off the surface; restitution and Coulomb friction relative to the solid.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/solids.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 3) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 4) buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 5) readonly buffer PushBlock { vec4 pushAway[]; };
layout(std430, binding = 6) readonly buffer NearListBlock { uint nearList[]; };
layout(std430, binding = 7) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 8) readonly buffer SolidBlock { SolidRecord solids[]; };

// Moves a centre out of every solid.
vec3 outside(vec3 x) {
  for (uint k = 0u; k < params.solidCount; ++k) {
    vec3 normal;
    float distance = surfaceDistance(solids[k], toLocal(solids[k], x), normal);
    if (distance < params.margin) x += toWorld(solids[k], normal) * (params.margin - distance);
  }
  return insideWalls(x);
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.cornerCount) return;
  uint i = nearList[params.count - 1u - n];
  vec3 x = position[i].xyz;
  vec4 keep = velocity[i];
  vec3 v = keep.xyz;
  for (uint k = 0u; k < params.solidCount; ++k) {
    vec3 normal;
    float distance = surfaceDistance(solids[k], toLocal(solids[k], x), normal);
    if (distance >= params.margin) continue;
    normal = toWorld(solids[k], normal);
    x += normal * (params.margin - distance);
    vec3 moving = vec3(solids[k].velocityX, solids[k].velocityY, solids[k].velocityZ);
    vec3 relative = v - moving;
    float into = dot(relative, normal);
    if (into >= 0.0) continue;
    vec3 along = relative - into * normal;
    float slide = length(along);
    float back = -solids[k].restitution * into;
    float lost = solids[k].friction * (back - into);
    along *= slide > 0.0 ? max(0.0, 1.0 - lost / slide) : 0.0;
    v = moving + along + back * normal;
  }
  x = insideWalls(x);
  position[i] = vec4(x, 0.0);
  velocity[i] = vec4(v, keep.w);
  vec3 next = x + control.nextStep * (v + control.nextStep * (gravity() + pushAway[i].xyz));
  prediction[i] = vec4(outside(insideWalls(next)), 0.0);
}
