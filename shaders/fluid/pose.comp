#version 460
// Where the solids are, and how fast they move, at the end of the substep at hand: keyframes,
// linear between, held outside; driven ones go evenly from where they were at the begin of the
// advance to where they are to be at its end. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) readonly buffer KeyframeBlock { vec4 keyframes[]; };  // translation, time

void place(uint n, vec3 moved, vec3 velocity) {
  solids[n].centerX = solids[n].baseX + moved.x;
  solids[n].centerY = solids[n].baseY + moved.y;
  solids[n].centerZ = solids[n].baseZ + moved.z;
  solids[n].velocityX = velocity.x;
  solids[n].velocityY = velocity.y;
  solids[n].velocityZ = velocity.z;
}

void drive(uint n) {
  vec4 from = keyframes[solids[n].firstKey], to = keyframes[solids[n].firstKey + 1u];
  float share = to.w > 0.0 ? clamp((to.w - control.timeLeft + ahead()) / to.w, 0.0, 1.0) : 1.0;
  place(n, mix(from.xyz, to.xyz, share), to.w > 0.0 ? (to.xyz - from.xyz) / to.w : vec3(0.0));
}

void follow(uint n) {
  float time = control.timeHigh + (control.timeLow + ahead());
  uint first = solids[n].firstKey, last = first + solids[n].keyCount - 1u;
  vec3 moved = keyframes[first].xyz, velocity = vec3(0.0);
  for (uint k = first; k < last && k < first + 65536u && keyframes[k].w <= time; ++k) {
    vec4 a = keyframes[k], b = keyframes[k + 1u];
    bool within = time < b.w;
    velocity = within ? (b.xyz - a.xyz) / (b.w - a.w) : vec3(0.0);
    moved = within ? a.xyz + velocity * (time - a.w) : b.xyz;
  }
  place(n, moved, velocity);
}

void main() {
  for (uint n = gl_LocalInvocationID.x; n < params.solidCount; n += gl_WorkGroupSize.x) {
    if (solids[n].driven != 0u)
      drive(n);
    else if (solids[n].keyCount > 0u)
      follow(n);
  }
}
