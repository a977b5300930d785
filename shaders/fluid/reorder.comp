#version 460
// Moves the particles into the order of their cells. w of positions and velocities carry
// the id (shared/number.glsl) and the warm-start multiplier. build.comp copies them back. Where regions sleep, w of a
// prediction below 0 is a particle's zone: it stays where it is.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "fluid/regions.glsl"
#include "fluid/sorted_places.glsl"
#include "shared/number.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(6, position)
READ_FLOAT4(7, prediction)
READ_FLOAT4(8, velocity)
READ_FLOAT(9, warm)
READ_UINT(10, id)
layout(std430, binding = 11) writeonly buffer SortedPositionBlock { vec4 sortedPosition[]; };
layout(std430, binding = 12) writeonly buffer SortedPredictionBlock { vec4 sortedPrediction[]; };
layout(std430, binding = 13) writeonly buffer SortedVelocityBlock { vec4 sortedVelocity[]; };
layout(std430, binding = 14) writeonly buffer TangentialBlock { vec4 nearTangential[]; };  // 0 until solids are found to be near
layout(std430, binding = 16) writeonly buffer RestBlock { uint rest[]; };  // zones
layout(std430, binding = 15) readonly buffer RegionBlock { RegionRecord regions[]; };
#include "fluid/zones.glsl"

// The multiplier of the warm start, for the present step: in regions asleep substeps left it as it was.
float presentWarm(uint from) {
  float ratio = REGIONS && from >= control.solved && control.sleepStep > 0.0 ? control.warmStep / control.sleepStep : 1.0;
  return warmAt(from) * ratio * ratio;
}

void main() {
  uint slot = flatInvocation();
  if (slot >= control.count) return;
  if (SOLIDS) nearTangential[slot] = vec4(0.0);
  uint place, from = arrival(slot, place);
  vec4 present = positionAt(from);
  vec3 x = present.xyz, v = velocityAt(from).xyz;
  vec4 next = predictionAt(from);
  uint zone = REGIONS ? zoneOf(x) : kZoneMoves;
  if (REGIONS) rest[place] = zone;
  if (zone != kZoneMoves) {
    v = vec3(0.0);
    next = vec4(x, -float(zone));
  }
  sortedPosition[place] = vec4(x, numberToFloat(idAt(from)));
  sortedPrediction[place] = vec4(next.xyz, withFluid(next.w, fluidOfPosition(present)));
  sortedVelocity[place] = vec4(v, WARM ? presentWarm(from) : 0.0);
}
