#version 460
// Pressure at the probes of the scene, of the substep that ends, and its mean over an advance; a workgroup a probe. A linear function is
// fitted to the particles' pressures by weighted least squares: see docs/notes/pressure.md.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT4(2, work)  // the prediction that the multipliers are of
READ_FLOAT(3, multiplier)
READ_UINT(4, cellStart)
READ_UINT(7, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
#include "shared/pressure_probe.h"
#include "fluid/kernel.glsl"
#include "fluid/cell_rows.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 5) readonly buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 6) buffer PressureProbeBlock { PressureProbeRecord pressureProbes[]; };

// Weighted sums over the neighbors of a probe, at `r` supports from it.
struct Moments {
  float weight;
  vec3 place, square, product;  // of r: x y z, xx yy zz, yz zx xy
  float pressure;
  vec3 slope;                   // of r times pressure
  float nearest;                // no sum: the least distance
};
shared Moments parts[gl_WorkGroupSize.x];
shared uint covered;

float pressureUnit = params.pressureDensity / (control.step * control.step);  // Pa / m^2

void add(inout Moments m, uint j, vec3 x) {
  vec3 place = uintBitsToFloat(workAt(j).xyz), r = (place - x) * params.inverseSupport;
  float distance = length(r);
  if (!isActive(place) || distance >= 1.0) return;
  float weight = kernelShape(distance * params.support), pressure = weight * (-multiplierAt(j) * pressureUnit);
  m.weight += weight;
  m.place += weight * r;
  m.square += weight * r * r;
  m.product += weight * r.yzx * r.zxy;
  m.pressure += pressure;
  m.slope += pressure * r;
  m.nearest = min(m.nearest, distance);
}

Moments sumOf(Moments a, Moments b) {
  return Moments(a.weight + b.weight, a.place + b.place, a.square + b.square, a.product + b.product, a.pressure + b.pressure,
                 a.slope + b.slope, min(a.nearest, b.nearest));
}

// Of this invocation's share of the particles near x.
Moments around(vec3 x) {
  Moments m = Moments(0.0, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, vec3(0.0), 2.0);
  vec3 scaled = scaledPosition(x);
  vec2 row = floor(scaled.yz);
  vec4 gaps = vec4(scaled.yz - row, row + 1.0 - scaled.yz) / inverseCell.yzyz;
  for (uint part = 0u; part < 18u; ++part) {
    uint begin, end;
    rowRange(scaled.x, scaled.x, row, gaps, params.reach, part / 2u, part % 2u, begin, end);
    for (uint j = begin + gl_LocalInvocationID.x; j < min(end, control.solved); j += gl_WorkGroupSize.x) add(m, j, x);
  }
  return m;
}

// Of the fit at the probe, Pa; at least 0, as the solver's pressure is.
float fittedPressure(Moments m) {
  if (m.nearest * params.support > kWetDistance * params.spacing) return 0.0;
  float scale = 1.0 / m.weight, mean = m.pressure * scale;
  vec3 center = m.place * scale, slope = m.slope * scale - mean * center;
  vec3 variance = m.square * scale - center * center + kPressureRidge, mixed = m.product * scale - center.yzx * center.zxy;
  mat3 covariance = mat3(variance.x, mixed.z, mixed.y, mixed.z, variance.y, mixed.x, mixed.y, mixed.x, variance.z);
  return max(mean - dot(inverse(covariance) * slope, center), 0.0);
}

void endAdvance(inout PressureProbeRecord p) {
  if (p.advanceTime <= 0.0) return;
  p.mean = p.advance / p.advanceTime;
  p.advance = p.advanceTime = 0.0;
}

void accumulate(inout PressureProbeRecord p, float impulse) {
  if (control.substeps == 1u) endAdvance(p);  // one that was cut short, if any
  precise float high = p.integralHigh, low = p.integralLow + impulse;
  precise float sum = high + low, rest = (high - sum) + low;
  p.integralHigh = sum;
  p.integralLow = rest;
  p.advance += impulse;
  p.advanceTime += control.step;
  if (control.timeLeft <= 0.0) endAdvance(p);
}

void main() {
  uint n = flatGroup(), lane = gl_LocalInvocationID.x;
  if (n >= params.pressureProbes || control.phase != kPhaseAdvancing) return;
  vec3 x = vec3(pressureProbes[n].x, pressureProbes[n].y, pressureProbes[n].z);
  if (lane == 0u) covered = 0u;
  parts[lane] = around(x);
  barrier();
  for (uint k = lane; k < params.solidCount; k += gl_WorkGroupSize.x) {
    vec3 normal;
    if (surfaceDistance(solids[k].shape, localPoint(solids[k].pose, x), normal) < 0.0) atomicOr(covered, 1u);
  }
  for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
    if (lane < width) parts[lane] = sumOf(parts[lane], parts[lane + width]);
    barrier();
  }
  if (lane != 0u) return;
  PressureProbeRecord p = pressureProbes[n];
  p.covered = covered;
  accumulate(p, covered != 0u ? 0.0 : control.step * fittedPressure(parts[0]));
  pressureProbes[n] = p;
}
