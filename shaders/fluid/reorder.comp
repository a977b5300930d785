#version 460
// Gathers the particles into the order of their cells, without the w of their positions and velocities, which nobody needs: in their place go the id (as a number:
// there are fewer particles than a float counts exactly) and the warm start. build.comp copies them back.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
READ_UINT(2, order)
READ_FLOAT4(3, position)
READ_FLOAT4(4, prediction)
READ_FLOAT4(5, velocity)
READ_FLOAT(6, warm)
READ_UINT(7, id)
layout(std430, binding = 8) writeonly buffer SortedPositionBlock { vec4 sortedPosition[]; };
layout(std430, binding = 9) writeonly buffer SortedPredictionBlock { vec4 sortedPrediction[]; };
layout(std430, binding = 10) writeonly buffer SortedVelocityBlock { vec4 sortedVelocity[]; };

void main() {
  uint i = flatInvocation();
  if (i >= params.count) return;
  uint from = orderAt(i);
  sortedPosition[i] = vec4(positionAt(from).xyz, float(idAt(from)));
  sortedPrediction[i] = predictionAt(from);
  sortedVelocity[i] = vec4(velocityAt(from).xyz, warmAt(from));
}
