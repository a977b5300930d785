#version 460
// Ends a substep in one loop over the neighbors: position correction (Macklin and Mueller 2013,
// equations 12 to 14), walls, velocity, and the prediction of the next substep with the warm
// start's acceleration. Gathers from `work`: the prediction, and the two multipliers as halves.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "fluid/artificial_pressure.glsl"
#include "fluid/background_pressure.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/kernel.glsl"
#include "fluid/motion.glsl"
#include "fluid/solid_samples.glsl"
#include "fluid/speed_gain.glsl"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { ChunkPush push; };
layout(std430, binding = 8) buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 9) buffer VelocityBlock { vec4 velocity[]; };
READ_NEAR_DISPLACED(10)
layout(std430, binding = 11) buffer PredictionBlock { vec4 prediction[]; };
// m/s^2; w, in the initial-pressure phase: the last multiplier
layout(std430, binding = 12) buffer WarmAccelerationBlock { vec4 warmAcceleration[]; };
// before the solve: what contacts with solids compare with; w: the prediction's
layout(std430, binding = 13) writeonly buffer FreeBlock { vec4 freeVelocity[]; };
layout(std430, binding = 14) buffer WarmBlock { float warm[]; };
READ_FLOAT4(15, nearCorrection)  // of pairs.comp
// LOADS, near solids: by what the gradient of the displaced density is multiplied in this substep, and in the warm start of the next, m^2
layout(std430, binding = 16) writeonly buffer NearMultipliersBlock { vec2 nearMultipliers[]; };
READ_FLOAT(17, coherence)

vec3 here;
vec2 own;                           // multiplier change, warm start; in the unit
uint fluid;
float inverseMass;
vec3 correction = vec3(0.0);        // m, once scaled
vec3 warmDisplacement = vec3(0.0);  // m, once scaled
vec3 gradients = vec3(0.0);         // 1/m, once scaled

float unit = params.inverseRestGradient / kMultiplierScale;  // m^2, of the multipliers
float pressure = control.artificialPressure * kMultiplierScale;

void visit(uvec4 particle) {
  vec3 r = here - uintBitsToFloat(particle.xyz);
  float distance = sqrt(dot(r, r));
  vec3 gradient = gradientShape(distance) * r;
  vec2 both = own + unpackHalf2x16(particle.w);
  if (ARTIFICIAL_PRESSURE) both.x -= artificialPressure(distance) * pressure / max(inverseMass, inverseMassOf(fluidOfWork(particle)));
  correction += both.x * gradient;
  gradients += gradient;
  if (WARM) warmDisplacement += both.y * gradient;
}
void reflectSums(vec3 signs) {
  correction *= signs;
  gradients *= signs;
  warmDisplacement *= signs;
}
#define IMAGES
#include "fluid/neighbors.glsl"

// Displacement from the start of the substep to its prediction. Computed from the velocity where
// nothing else changed the prediction: the rounding of a difference of positions would make a
// random walk of the velocity. What walls, solids and earlier iterations pushed it by beyond their approach is a correction, too.
vec3 predictedDisplacement(vec3 from, vec3 velocity, vec3 acceleration) {
  vec3 difference = here - from;
  vec3 planned = control.step * (velocity + control.step * (gravity() + acceleration));
  vec3 rounding = 3.0e-7 * (abs(from) + abs(here)), pushed = difference - planned;
  if (all(lessThanEqual(abs(pushed), rounding))) return planned;
  float kept = keptPush(planned, pushed, control.step * (maxSpeedGain() + control.solidSpeed));
  return kept < 1.0 ? planned + kept * pushed : difference;
}

// The sums over neighbors in meters, and what mouths add; near solids what pairs.comp has summed up.
void endSums(uint i, uint head) {
  vec3 displaced = MOUTHS ? displacedAt(i, head).xyz : vec3(0.0);
  float flow = coherenceAt(coherencePlace(i));
  vec3 ownGradient = displaced - backgroundGradient(params.gradientScale * gradients + displaced, vec3(0.0), velocity[i].xyz, flow);
  correction = unit * (params.gradientScale * correction + own.x * ownGradient);
  warmDisplacement = unit * (params.gradientScale * warmDisplacement + own.y * ownGradient);
  if (!isNearSolids(head)) return;
  correction = nearCorrectionAt(2u * i).xyz;
  warmDisplacement = nearCorrectionAt(2u * i + 1u).xyz;
}

// Of a particle that sleeps: what would move it, for rest_motion.comp.
void storeAcceleration(uint i, uint head) {
  endSums(i, head);
  if (WARM) warmAcceleration[i] = vec4(inverseMass * warmDisplacement / (control.warmStep * control.warmStep), 0.0);
}

// Speed of the particle (m/s), whose substep ends here.
float endSubstep(uint i, uint head) {
  endSums(i, head);
  correction *= inverseMass;
  warmDisplacement *= inverseMass;

  vec3 from = position[i].xyz, before = velocity[i].xyz;
  vec4 lastAcceleration = WARM ? warmAcceleration[i] : vec4(0.0);
  bool solvesPressure = control.phase == kPhaseInitialPressure;
  vec3 to = solvesPressure ? from : insideWalls(here + correction);
  // A correction separates particles in full, but adds no more speed than can have brought them
  // together: see docs/notes/overlaps.md.
  vec3 gained = to - here;
  float gain = sqrt(dot(gained, gained));
  float maxGain = control.step * maxSpeedGain();
  float kept = min(1.0, maxGain / max(gain, 1.0e-20));
  // clamping deep overlaps also dissipates energy
  vec3 displacement = (0.5 + 0.5 * kept) * predictedDisplacement(from, before, lastAcceleration.xyz) + gained * kept;
  // At most twice the distance that cfl allows: the next step shrinks to follow a faster particle.
  float limit = max(2.0 * params.cfl, 0.02) * params.spacing;
  if (MESHES && control.phase == kPhaseSettling) limit = min(limit, 0.45 * params.spacing);  // a fill may begin inside a sheet
  vec3 whole = to - from;
  float far = sqrt(dot(whole, whole));
  if (far > limit) { displacement *= limit / far; to = insideWalls(from + whole * (limit / far)); }
  float speedLimit = max(params.speedLimit, 2.0 * control.emitterSpeed);  // the host may have raised a flow
  displacement *= min(1.0, min(limit, speedLimit * control.step) / max(sqrt(dot(displacement, displacement)), 1.0e-20));
  // not (to - from): a particle that starts outside the walls is moved inside without a change of
  // velocity
  vec3 v = control.phase == kPhaseAdvancing ? displacement / control.step : before;
  vec3 acceleration = warmDisplacement / (control.warmStep * control.warmStep);
  vec3 next = insideWalls(predicted(to, v, acceleration));
  bool finite = isFinite(to) && isFinite(next);
  if (!finite) {
    bool left = isFinite(here) || !isActive(from);  // left through an open side, or inactive before
    if (!left) { atomicAdd(sums.nonFinite, 1u); }
    to = from;
    v = vec3(0.0);
    acceleration = vec3(0.0);
    next = from;
    if (WARM) warm[i] = 0.0;
  }
  float found = 0.0;
  if (WARM && solvesPressure) {  // heavy ball (Polyak 1964): the last change goes on in the next, if there is one
    found = warm[i];
    float momentum = control.nextPhase == kPhaseInitialPressure ? params.initialPressureMomentum : 0.0;
    warm[i] = min(0.0, found + momentum * (found - lastAcceleration.w));
  }
  position[i] = vec4(to, storedFluid(fluid));
  if (LOADS && isNearSolids(head)) nearMultipliers[i] = finite ? unit * vec2(kept * own.x, own.y) : vec2(0.0);
  if (SOLIDS) freeVelocity[i] = vec4(before + control.step * gravity(), numberOfPrediction(prediction[i].w));
  velocity[i] = vec4(v, 1.0);
  if (WARM) warmAcceleration[i] = vec4(acceleration, found);
  prediction[i] = vec4(next, withFluid(0.0, fluid));
  return sqrt(dot(v, v));
}

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool inRange = i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  uvec4 particle = particleAt(i);
  here = uintBitsToFloat(particle.xyz);
  own = unpackHalf2x16(particle.w);
  fluid = fluidOfWork(particle);
  inverseMass = inverseMassOf(fluid);
  uint head = headOf(i, inRange);
  bool moves = inRange && !sleeps(head);
  bool gathers = moves || (inRange && gathersAsleep());
  bool visits = gathers && !isNearSolids(head);  // of the others pairs.comp has the sums
  visitNeighbors(i, visits ? head : 0u, local, visits);
  // No lane leaves before the maximum: those that are left need not come together again.
  float speed = moves ? endSubstep(i, head) : 0.0;
  if (REGIONS && gathers && !moves) storeAcceleration(i, head);
  float fastest = subgroupMax(speed);
  float motion = subgroupAdd(motionOf(speed));
  uint fast = params.sleeps != 0u ? subgroupAdd(uint(speed > restMaxSpeed())) : 0u;
  if (SOLIDS && inRange && i == 0u) {  // for collide.comp; the next substep counts anew
    sums.reached = sums.inReach;
    sums.inReach = 0u;
  }
  if (!subgroupElect()) return;
  atomicMax(sums.speedMax, floatBitsToUint(fastest));
  ADD_MOTION(sums.motionLow, sums.motionHigh, motion);
  if (fast > 0u) atomicAdd(sums.fast, fast);
}
