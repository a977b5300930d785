#version 460
// Which regions rest, from the sums over their particles: docs/notes/sleep.md.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/regions.glsl"
#include "shared/flow_records.h"
#include "shared/pressure_probe.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer RegionBlock { RegionRecord regions[]; };
layout(std430, binding = 3) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 4) readonly buffer EmitterBlock { EmitterRecord emitters[]; };
layout(std430, binding = 5) readonly buffer DrainBlock { DrainRecord drains[]; };
layout(std430, binding = 6) readonly buffer PressureProbeBlock { PressureProbeRecord pressureProbes[]; };
layout(std430, binding = 7) readonly buffer KeyframeBlock { KeyframeRecord keyframes[]; };
#include "fluid/mouth_frame.glsl"
#include "fluid/rest_limits.glsl"

const float kRestNoise = 0.01;   // root mean square of a region's speeds, of the speed of a fall through a spacing
const float kRestForce = 0.01;   // of gravity: by how much the mean force on a region that sleeps may change
const float kWakeTimes = 3.0;    // times what is at rest: from there on a region wakes its neighbors

// Whether a ball around x may reach the region or one beside it.
bool reaches(vec3 x, float radius, uvec3 at) {
  vec3 edge = vec3(kRegionCellsX, kRegionCellsY, kRegionCellsZ) / inverseCell;
  return all(lessThanEqual(vec3(regionsApart(regionOf(x), at)), 1.0 + ceil(radius / edge)));
}

// Whether something acts here that moves fluid or looks at it.
bool isAtFlowOrProbe(uvec3 at) {
  float now = control.timeHigh + control.timeLow;
  bool near = false;
  for (uint n = 0u; n < params.pressureProbes; ++n)
    near = near || reaches(vec3(pressureProbes[n].x, pressureProbes[n].y, pressureProbes[n].z), 0.0, at);
  for (uint e = 0u; e < params.emitterCount; ++e) {
    bool open = emitters[e].rate > 0.0 && now >= emitters[e].from && now <= emitters[e].until;
    vec3 center = centerOf(mouthFrame(e, now).pose);
    near = near || (open && reaches(center, length(vec2(emitters[e].halfAcross, emitters[e].halfUp)), at));
  }
  for (uint k = 0u; k < params.drainCount; ++k) {
    bool open = now >= drains[k].from && now <= drains[k].until, ball = drains[k].sphere != 0u;
    vec3 low = vec3(drains[k].lowX, drains[k].lowY, drains[k].lowZ), high = vec3(drains[k].highX, drains[k].highY, drains[k].highZ);
    near = near || (open && reaches(ball ? low : 0.5 * (low + high), ball ? high.x : 0.5 * length(high - low), at));
  }
  return near;
}

void main() {
  uint r = flatInvocation();
  if (r >= regionCount()) return;
  if (regions[r].state == kRegionEmpty && regions[r].particles == 0u) return;
  RegionRecord region = regions[r];
  if (region.woken != 0u) region.state = kRegionAwake;
  region.woken = 0u;
  bool heldAwake = region.nearSolid != 0u || control.wakesAll != 0u || melts() || isAtFlowOrProbe(regionAt(r));
  float each = 1.0 / float(max(region.particles, 1u)), fall = sqrt(params.layerHead);
  float noise = sqrt(float(region.motion) * kRegionMotionUnit * each), fastest = uintBitsToFloat(region.fastest) / fall;
  float drift = length(vec3(region.driftX, region.driftY, region.driftZ)) * kRegionUnit * each * fall;
  vec3 force = vec3(region.forceX, region.forceY, region.forceZ) * kRegionUnit * each;
  RestLimits limits = restLimits();
  bool atRest = region.particles <= kMaxRegionParticles && noise <= kRestNoise && fastest <= kRestMaxSpeed && drift <= limits.speed;

  if (region.state == kRegionAsleep) {
    bool hasNoSums = region.zone == kZoneAsleep && region.particles == 0u;
    bool forced = length(force - vec3(region.restForceX, region.restForceY, region.restForceZ)) > kRestForce;
    bool changed = !atRest || region.particles != region.restParticles || (region.zone == kZoneWatched && forced);
    if (heldAwake || (!hasNoSums && changed)) region.state = kRegionAwake, region.restShare = 0.0;
  } else {
    region.state = region.particles == 0u ? kRegionEmpty : kRegionAwake;
    if (control.regionsDue == kRegionsDueAfterRest) region.restShare = 1.0;
    region.restShare = heldAwake || !atRest ? 0.0 : region.restShare + control.regionTime / limits.time;
    if (region.state == kRegionAwake && region.restShare >= 1.0) {
      region.state = kRegionAsleep;
      region.restParticles = region.particles;
      region.restForceX = force.x, region.restForceY = force.y, region.restForceZ = force.z;
    }
  }
  bool moves = noise > kWakeTimes * kRestNoise || fastest > kRestMaxSpeed || drift > kWakeTimes * limits.speed;
  region.moves = uint(region.state == kRegionAwake && moves);
  regions[r] = region;
}
