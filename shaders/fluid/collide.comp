#version 460
// Solids at the end of a substep: centers are kept half a spacing off their surfaces, then contact
// with restitution and Coulomb friction relative to the solid. A solid's impulse is what its own
// displaced density and the projection gave, so that friction feels the weight of the column above.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "fluid/motion.glsl"
#include "fluid/solid_samples.glsl"
#include "fluid/speed_gain.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 3) buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 4) buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 5) readonly buffer WarmAccelerationBlock { vec4 warmAcceleration[]; };
layout(std430, binding = 7) buffer SumsBlock { FluidSums sums; };
#include "shared/arrays.glsl"
READ_UINT4(6, nearSolids)
READ_UINT2(16, inReach)
READ_UINT4(8, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
READ_UINT(13, meshWord)
layout(std430, binding = 14) buffer SolidSumsBlock { uint solidSums[]; };
#include "fluid/near_solids.glsl"
#include "shared/pose.glsl"
#include "fluid/solid_reaction.glsl"
READ_UINT4(15, bodies)  // BodyRecord
#include "fluid/body_array.glsl"
#include "fluid/bodies.glsl"

// The part of a change of a particle's velocity along `direction` that a solid takes the reaction of in one substep: bodies are split
// between all particles around them (docs/notes/bodies.md). 1 for others.
float shareOf(uint body, vec3 x, vec3 direction) {
  if (!BODIES || body == kNoBody) return 1.0;
  BodyRecord b = bodyAt(body);
  if (b.held != 0u) return 1.0;
  return 1.0 / (1.0 + 2.0 * params.spacing * sqrt(mobility(b, x, direction)) * b.stiffness);  // beside it |grad B| is about 1 / (2 d)
}

float ownInverseMass;
bool gaveWay = false;       // whether a body that did pushed it
vec3 rejected = vec3(0.0);  // the part of that, m, which changes no velocity
void pushedBy(uint k, SolidRecord s, vec3 x, vec3 normal, vec3 by) {
  if (control.phase != kPhaseAdvancing) return;
  if (BODIES) {
    float share = shareOf(s.body, x, normal);
    gaveWay = gaveWay || share < kFirmShare;
    rejected += (1.0 - share) * by;
    by *= share;
  }
  if (LOADS) addToSolid(k, centerOf(s.pose), by / ownInverseMass, x);
}
#define PUSHED(k, solid, x, normal, by) pushedBy(k, solid, x, normal, by)

#include "fluid/outside.glsl"
#include "fluid/solid_reach.glsl"
layout(std430, binding = 9) readonly buffer FreeBlock { vec4 freeVelocity[]; };
layout(std430, binding = 10) readonly buffer WorkBlock { uvec4 work[]; };
layout(std430, binding = 11) readonly buffer WarmBlock { float warm[]; };
layout(std430, binding = 12) readonly buffer DisplacedBlock { vec4 nearDisplaced[]; };

// The listed solid nearest to x, which pushed its prediction, and the direction. Bodies push no prediction.
uint nearestSolid(NearSolids near, vec3 x, out vec3 center, out vec3 direction) {
  uint nearest = kNoSolid, m = 0u, k;
  float least = 3.0e38;
  center = direction = vec3(0.0);
  bool some = nextSolid(near, m, k);
  LOOP_WHILE (some) {
    SolidRecord s = solidAt(k);
    vec3 normal;
    float distance = surfaceDistance(s.shape, localPoint(s.pose, x), normal);
    if (s.body == kNoBody && distance < least) {
      least = distance;
      nearest = k;
      center = centerOf(s.pose);
      direction = toScene(s.pose, normal);
    }
    ++m;
    some = nextSolid(near, m, k);
  } LOOP_END(some);
  return nearest;
}

// Turns pushes by `pushed` m along the normal at x into pushes along the normal at `start`, where pressure acted: the difference would
// accelerate particles along curved solids. See docs/notes/walls-and-solids.md.
vec3 alongSurface(NearSolids near, vec3 start, vec3 x, float pushed) {
  if (pushed <= 0.0) return vec3(0.0);
  vec3 center, normal, local;
  uint k = nearestSolid(near, x, center, normal);
  if (k == kNoSolid) return vec3(0.0);
  SolidRecord s = solidAt(k);
  PoseRecord pose = later(s.pose, -control.step);
  if (surfaceDistance(s.shape, localPoint(pose, start), local) > contactReach()) return vec3(0.0);
  vec3 startNormal = toScene(pose, local), by = pushed * (startNormal - dot(startNormal, normal) * normal);
  PUSHED(k, s, x, normal, by);
  return by;
}

// The velocity of particle i at x after contact with a solid that is near enough.
vec3 touch(uint i, uint k, SolidRecord s, vec3 x, vec3 normal, vec3 v, vec3 given) {
  vec3 moving = velocityAt(s.pose, x);
  float before = dot(freeVelocity[i].xyz - moving, normal);
  vec3 relative = v - moving;
  float away = dot(relative, normal);
  vec3 along = relative - away * normal;
  float predicted_ = BODIES && s.body != kNoBody ? 0.0 : freeVelocity[i].w / control.step;
  float impulse = max(0.0, dot(given, normal) + predicted_);
  if (before < 0.0 && s.restitution > 0.0 && away < -s.restitution * before) {
    float bounce = -s.restitution * before - away;
    if (BODIES) bounce *= shareOf(s.body, x, normal);
    impulse += bounce;
    away = BODIES ? away + bounce : -s.restitution * before;
  }
  float slip = length(along);
  float stopped = slip > 0.0 ? min(1.0, s.friction * impulse / slip) : 0.0;
  if (BODIES && slip > 0.0) stopped *= shareOf(s.body, x, along / slip);
  along *= 1.0 - stopped;
  vec3 after = moving + along + away * normal;
  if (LOADS) addToSolid(k, centerOf(s.pose), control.step / ownInverseMass * (after - v), x);
  return after;
}

// The velocity of particle i, which solids have moved from `from` to x.
vec3 velocityAfter(uint i, NearSolids near, vec3 from, vec3 x) {
  vec3 gained = (x - from) / control.step;
  if (BODIES) gained -= rejected / control.step;
  float fastest = BODIES ? max(control.solidSpeed, control.bodySpeed) : control.solidSpeed;
  if (!gaveWay) gained *= keptPush(velocity[i].xyz, gained, maxSpeedGain() + fastest);
  vec3 v = velocity[i].xyz + gained;
  // The multiplier in all, never positive: what the warm start had, and the change. `warm` has a
  // share of the change already.
  float change = unpackHalf2x16(work[i].w).x * (params.inverseRestGradient / kMultiplierScale);
  float multiplier = min(0.0, (WARM ? warm[i] : 0.0) + (1.0 - control.warmGain) * change);
  vec3 given = ownInverseMass * multiplier * nearDisplaced[i].xyz / control.step + gained;
  if (LOADS && FIRM_SOLIDS && freeVelocity[i].w > 0.0) {
    vec3 center, direction, at = uintBitsToFloat(work[i].xyz);
    uint pushing = nearestSolid(near, at, center, direction);
    if (pushing != kNoSolid) addToSolid(pushing, center, freeVelocity[i].w / ownInverseMass * direction, at);
  }
  uint m = 0u, k;
  bool some = nextSolid(near, m, k);
  LOOP_WHILE (some) {
    SolidRecord s = solidAt(k);
    vec3 normal;
    bool touches = (s.friction > 0.0 || s.restitution > 0.0) && !isBeyond(centerOf(s.pose), s.radius, x, contactReach() + params.spacing);
    touches = touches && surfaceDistance(s.shape, localPoint(s.pose, x), normal) <= contactReach();
    if (touches) v = touch(i, k, s, x, toScene(s.pose, normal), v, given);
    ++m;
    some = nextSolid(near, m, k);
  } LOOP_END(some);
  return v * min(1.0, params.speedLimit / max(sqrt(dot(v, v)), 1.0e-20));
}

// What rests on a solid has a velocity into it until here.
void subtractStoppedMotion(float before, float after) {
  float stopped = motionOf(before) - motionOf(after);
  if (stopped > 0.0) ADD_MOTION(sums.stoppedLow, sums.stoppedHigh, stopped)
  // correct.comp has counted it; the margin is for rounding
  if (before > 1.001 * restMaxSpeed() && after <= restMaxSpeed()) atomicAdd(sums.fast, 0xffffffffu);
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.reached) return;
  uvec2 entry = inReachAt(n);
  NearSolids near = nearSolidsOf(entry.x);
  near.mask = entry.y;
  uint i = near.particle;
  vec3 from = position[i].xyz;
  if (!isActive(from)) return;
  uint fluid = fluidOfPosition(position[i]);
  ownInverseMass = inverseMassOf(fluid);
  float pushed;
  vec3 x = outside(from, near, 0.0, true, pushed), v = velocity[i].xyz;
  if (control.phase == kPhaseAdvancing) {
    if (FIRM_SOLIDS) x = insideWalls(x + alongSurface(near, from - control.step * v, x, freeVelocity[i].w + pushed));
    if (params.sleeps != 0u) subtractStoppedMotion(length(v), length(v + (x - from) / control.step));
    v = velocityAfter(i, near, from, x);
  }
  position[i] = vec4(x, storedFluid(fluid));
  velocity[i] = vec4(v, 1.0);
  if (FORCES) return;  // predict.comp, after them
  vec3 planned = predicted(x, v, keptWarmAcceleration(warmAcceleration[i]));
  pushed = 0.0;
  vec3 next = FIRM_SOLIDS ? outside(planned, near, ahead(), false, pushed) : insideWalls(planned);
  prediction[i] = vec4(next, withFluid(pushed, fluid));
}
