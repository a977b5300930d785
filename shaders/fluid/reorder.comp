#version 460
// Moves the particles into the order of their cells. The unused w of positions and velocities carry
// the id (shared/number.glsl) and the warm-start multiplier. build.comp copies them back.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
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

void main() {
  uint slot = flatInvocation();
  if (slot >= control.count) return;
  if (SOLIDS) nearTangential[slot] = vec4(0.0);
  uint place, from = arrival(slot, place);
  sortedPosition[place] = vec4(positionAt(from).xyz, numberToFloat(idAt(from)));
  sortedPrediction[place] = predictionAt(from);
  sortedVelocity[place] = vec4(velocityAt(from).xyz, WARM ? warmAt(from) : 0.0);
}
