#version 460
// Density of the prediction, the constraint's gradient and the multiplier (Macklin and Mueller
// 2013, equations 1, 2, 9 and 11), with the integral warm start: see docs/method.md.
// Gathers from the predicted positions. MERGED: the subgroup that finishes last accounts for the
// substep, which is a pass less on GPUs; CPU drivers would execute that code, masked, in every subgroup.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"
#include "fluid/density_scale.glsl"
#include "fluid/fluids.glsl"
#include "fluid/solid_samples.glsl"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { DensityPush push; };
layout(std430, binding = 8) buffer WarmBlock { float warm[]; };
layout(std430, binding = 9) buffer WorkBlock { uvec4 work[]; };  // w: what storeWork() packs
READ_NEAR_DISPLACED(10)
layout(std430, binding = 11) buffer MultiplierBlock { float multiplier[]; };
READ_NEAR_TANGENTIAL(12)
READ_FLOAT(13, nearStiffness)
#ifdef MERGED
layout(std430, binding = 14) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 15) coherent buffer CommandBlock { uint commands[]; };
layout(std430, binding = 16) readonly buffer GravityBlock { vec4 gravityChanges[]; };
#endif

vec3 here;
float rho = 0.0;        // over rest density
vec3 gradientSum = vec3(0.0);
float gradientSquares = 0.0;  // each over the neighbor's mass
uint fluid;

void visit(vec4 particle) {
  vec3 r = here - particle.xyz;
  float squared = dot(r, r);
  float value, gradient;
  kernelShapes(sqrt(squared), value, gradient);
  rho += value;
  gradientSum += gradient * r;
  gradientSquares += inverseMassOf(fluidOfPrediction(particle.w)) * gradient * gradient * squared;
}
void reflectSums(vec3 signs) { gradientSum *= signs; }
#define IMAGES
#include "fluid/neighbors.glsl"

float unit = kMultiplierScale / params.inverseRestGradient;  // of multipliers as halves

void storeWork(uint i, float change, float warmNext) {
  work[i] = uvec4(placeWithFluid(here, fluid), packHalf2x16(clamp(vec2(change, warmNext) * unit, -60000.0, 60000.0)));
}

// What the last change of the multiplier adds to this one (heavy ball, Polyak 1964), m^2, in a block, where particles keep their places.
// `scale`: from the last step's terms to the present ones. See docs/notes/momentum.md.
float momentumOf(uint i, float scale, float stiffness) {
  if (push.blockStart != 0u || control.phase != kPhaseAdvancing || control.nextPhase != kPhaseAdvancing) return 0.0;
  float last = unpackHalf2x16(work[i].w).x / unit * scale, ended = last * stiffness / kMomentumCompression, squared = ended * ended;
  return params.momentum * (1.0 - control.restFraction) * squared / (1.0 + squared) * last;
}

// Asleep: the multiplier stays, in the terms of the next step.
void keepMultiplier(uint i) {
  float ratio = push.iteration == 0u ? control.nextStep / control.warmStep : 1.0;
  float kept = WARM ? warm[i] * ratio * ratio : 0.0;
  if (WARM) warm[i] = kept;
  if (MULTIPLIERS) multiplier[i] = kept;
  storeWork(i, 0.0, kept);
}

// Compression of the particle, from 0 to 1; its multiplier is updated.
float updateMultiplier(uint i, uint head) {
  rho = densityScale() * (rho + kernelShape(0.0));
  gradientSum *= params.gradientScale;
  gradientSquares *= params.gradientScale * params.gradientScale;
  SolidScale solids = kNoSolids;
  if (SOLIDS || MOUTHS) {
    vec4 displaced = displacedAt(i, head);
    gradientSum += displaced.xyz;
    rho += displaced.w;
    if (SOLIDS) solids = solidScaleAt(i, head);
  }

  float constraint = isActive(here) ? rho - 1.0 : -1.0;  // inactive particles coincide; exclude them from the error
  float inverseMass = inverseMassOf(fluid);
  float stiffness = stiffnessAtSolids(solids, gradientSum, inverseMass, gradientSquares, inverseMass * params.regularization);
  if (BODIES && (head & kNearSolidsBit) != 0u) stiffness += nearStiffnessAt(i);
  bool first = push.iteration == 0u;
  float delta = -(first ? control.nextRelaxation : control.relaxation) * constraint / max(stiffness, 1.0e-20);

  float before, after, warmNext = 0.0;
  if (first && !WARM) {
    before = 0.0;
    after = min(0.0, delta);
  } else if (first) {
    float ratio = control.nextStep / control.warmStep;
    before = warm[i] * ratio * ratio;  // 0 while particles settle
    after = min(0.0, before + delta + momentumOf(i, ratio * ratio, stiffness));
    float gain = control.nextPhase == kPhaseInitialPressure ? 1.0 : control.nextWarmGain * (delta > 0.0 ? params.warmRelease : 1.0);
    warmNext = min(0.0, before + gain * delta);
    // bounded: in fluid without room it would grow without limit
    warmNext = max(warmNext, -params.warmLimit * control.nextStep * control.nextStep);
    if (control.nextPhase == kPhaseSettling) warmNext = 0.0;
    warm[i] = warmNext;
  } else {
    before = multiplier[i];
    after = min(0.0, before + delta);
    if (WARM) warmNext = warm[i];
  }
  if (MULTIPLIERS) multiplier[i] = after;

  storeWork(i, after - before, warmNext);
  return isWithin(vec3(constraint), 1.0e30) ? clamp(constraint, 0.0, 1.0) : 0.0;
}

// Whether there is something to do.
bool runs() {
#ifdef MERGED
  return (push.iteration == 0u ? control.running : control.again) != 0u;
#else
  return true;
#endif
}

void addCompression(float sum, float most) {
  uint add = uint(sum / kErrorUnit + 0.5);
  uint old = atomicAdd(sums.errorLow, add);
  if (old + add < old) atomicAdd(sums.errorHigh, 1u);
  atomicMax(sums.errorMax, floatBitsToUint(most));
}

#ifdef MERGED
#include "fluid/control.glsl"
#include "fluid/dispatch_commands.glsl"

// One invocation of each subgroup, which has `mine`, calls this. The starts to switch the commands by, if its subgroup is the last of all.
uint startsAfterLast(uint mine) {
  uint invocations = kFluidGroup * gl_NumWorkGroups.x * gl_NumWorkGroups.y * divideUp(params.capacity, params.chunkParticles);
  memoryBarrierBuffer();  // what was added to the sums comes before the ticket
  if (atomicAdd(commands[kTicketWord], mine) + mine != invocations) return 0u;
  memoryBarrierBuffer();
  commands[kTicketWord] = 0u;
  uint parity = accountSubstep(push.iteration, push.parity, push.blockStart != 0u);
  return parity == kKeepCommands ? 0u : startsOn(parity);
}
#endif

void main() {
  uint local = clusterInvocation();
  uint i = push.first + local;
  bool going = runs(), inRange = going && i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  vec4 particle = particleAt(i);
  here = particle.xyz;
  fluid = fluidOfPrediction(particle.w);
  uint head = headOf(i, inRange);
  bool moves = inRange && !sleeps(head);
  visitNeighbors(i, moves ? head : 0u, local, moves);
  // No lane leaves before the sums: those that are left need not come together again.
  float compression = moves ? updateMultiplier(i, head) : 0.0;
  if (inRange && !moves) keepMultiplier(i);
  float sum = subgroupAdd(compression);  // of 64 lanes, in kErrorUnit, it fits into 32 bits
  float most = subgroupMax(compression);
#ifdef MERGED
  uint on = 0u, lanes = subgroupAdd(1u);
  subgroupBarrier();  // all have read the control block
  if (subgroupElect()) {
    if (going) addCompression(sum, most);
    on = startsAfterLast(lanes);
  }
  on = subgroupMax(on);
  if (on != 0u) switchCommands(on, subgroupExclusiveAdd(1u), lanes);
#else
  if (subgroupElect()) addCompression(sum, most);
#endif
}
