#version 460
// The solids that each body may touch in the substep at hand: those whose surface its bounding sphere reaches.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT(6, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
layout(local_size_x = kFluidGroup) in;
READ_UINT4(2, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 3) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 4) writeonly buffer TouchedBlock { TouchedRecord touched[]; };
layout(std430, binding = 5) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 7) writeonly buffer ContactCandidateBlock { uvec2 contactCandidates[]; };
layout(std430, binding = 8) writeonly buffer ContactCommandBlock { uint contactCommands[]; };
#include "fluid/bodies.glsl"

const uint kMaxNear = 4u * kMaxTouched;

void main() {
  uint n = flatInvocation();
  if (n == 0u) {
    contactCandidates[0] = uvec2(0u);
    for (uint k = 0u; k < 6u; ++k) contactCommands[k] = k % 3u == 0u ? 0u : 1u;
  }
  if (n >= params.bodyCount) return;
  uint own = bodies[n].solid, count = 0u, skipped = 0u;
  bodies[n].contacts = 0u;
  vec3 middle = centerOf(bodies[n].predicted);
  float reach = bodies[n].radius + contactMargin();
  // First by bounding spheres: CPU drivers execute all of a loop's body for every solid.
  uint near[kMaxNear], nearCount = 0u;
  for (uint k = 0u; k < params.solidCount; ++k) {
    SolidRecord s = solidAt(k);
    bool beyond = isBeyond(centerOf(s.pose), s.radius, middle, reach + params.spacing);  // as in outside.glsl
    if (k == own || beyond) continue;
    if (nearCount < kMaxNear)
      near[nearCount++] = k;
    else
      ++skipped;
  }
  for (uint m = 0u; m < nearCount; ++m) {
    uint k = near[m];
    SolidRecord s = solidAt(k);
    vec3 normal;
    if (surfaceDistance(s.shape, localPoint(s.pose, middle), normal) > reach) continue;
    if (count < kMaxTouched)
      touched[n].solids[count++] = k;
    else
      ++skipped;
  }
  touched[n].count = count;
  touched[n].walls = uint(any(lessThan(middle - reach, wallsLow())) || any(greaterThan(middle + reach, wallsHigh())));
  if (skipped > 0u) atomicAdd(sums.boundHits, skipped);
}
