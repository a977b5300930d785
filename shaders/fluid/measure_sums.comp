#version 460
// Figures of the present instant except percentiles: compression, energies, momentum, particles
// outside. One partial sum a workgroup, in a fixed order.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "fluid/partials.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
READ_FLOAT4(3, velocity)  // w: density over rest density
layout(std430, binding = 4) writeonly buffer PartialBlock { MeasurePartial partials[]; };

shared MeasurePartial rows[kFluidGroup];

void main() {
  if (flatGroup() >= partialCount()) return;
  uint lane = gl_LocalInvocationID.x;
  vec3 low = vec3(params.boundLowX, params.boundLowY, params.boundLowZ);
  vec3 high = vec3(params.boundHighX, params.boundHighY, params.boundHighZ);
  float compression = 0.0, compressionMax = 0.0, squares = 0.0, squaresMax = 0.0, masses = 0.0;
  vec3 velocities = vec3(0.0), positions = vec3(0.0);
  uint outside = 0u, inactive = 0u;
  for (uint i = flatInvocation(); i < control.count; i += partialCount() * kFluidGroup) {
    vec4 particle = positionAt(i);
    vec3 x = particle.xyz;
    if (!isActive(x)) {
      outside += 1u;
      inactive += 1u;
      continue;
    }
    vec4 v = velocityAt(i);
    float error = max(v.w - 1.0, 0.0), square = dot(v.xyz, v.xyz);
    compression += error;
    compressionMax = max(compressionMax, error);
    float mass = 1.0 / inverseMassOf(fluidOfPosition(particle));
    squares += mass * square;
    squaresMax = max(squaresMax, square);
    velocities += mass * v.xyz;
    positions += mass * x;
    masses += mass;
    outside += uint(any(lessThan(x, low)) || any(greaterThan(x, high)));
  }
  rows[lane] = MeasurePartial(compression, compressionMax, sqrt(squaresMax), masses, squares,
                              velocities.x, velocities.y, velocities.z, positions.x, positions.y,
                              positions.z, outside, inactive);
  barrier();
  for (uint half_ = kFluidGroup / 2u; half_ > 0u; half_ /= 2u) {
    if (lane < half_) rows[lane] = addPartials(rows[lane], rows[lane + half_]);
    barrier();
  }
  if (lane == 0u) partials[flatGroup()] = rows[0];
}
