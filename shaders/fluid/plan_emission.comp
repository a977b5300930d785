#version 460
// Accounts for the time of emitters, and at a rebuild makes room for the layers that are due: emit.comp places their particles. One
// invocation. See docs/notes/flows.md.
#extension GL_GOOGLE_include_directive : require
#include "shared/fluid_records.h"
#include "shared/flow_records.h"
layout(local_size_x = 1) in;
layout(push_constant) uniform Push { EmissionPush push; };
layout(binding = 0) uniform ParamsBlock { FluidParams params; };
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; };
layout(std430, binding = 2) readonly buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 3) readonly buffer ShapeBlock { uint shapes[]; };
layout(std430, binding = 4) buffer CommandBlock { uint commands[]; };
layout(std430, binding = 5) buffer EmitterBlock { EmitterRecord emitters[]; };
layout(std430, binding = 6) buffer FlowBlock { FlowRecord flow; };
#include "fluid/dispatch_commands.glsl"

// Seconds from a time, as the sum of two floats, to now.
float since(float high, float low) {
  precise float seconds = (control.timeHigh - high) + (control.timeLow - low);
  return seconds;
}

// To a time as the sum of two floats.
void addTo(inout float high, inout float low, float seconds) {
  precise float sum = high + (seconds + low);
  precise float rest = (high - sum) + (seconds + low);
  high = sum;
  low = rest;
}

// Layers that have left the mouth since it was last accounted for. Returns the seconds in which it was open.
float account(uint e) {
  float all = since(emitters[e].doneHigh, emitters[e].doneLow), rate = emitters[e].rate;
  emitters[e].doneHigh = control.timeHigh;
  emitters[e].doneLow = control.timeLow;
  emitters[e].age += all;
  if (rate <= 0.0 || (emitters[e].blocked & kNoRoom) != 0u) emitters[e].opened = 0.0;
  if (rate <= 0.0) {
    emitters[e].blocked = 0u;
    return 0.0;
  }
  float closed = max(since(emitters[e].until, 0.0), 0.0), open = max(min(all, since(emitters[e].from, 0.0)) - closed, 0.0);
  float layers = min(rate * open, 1.0e6), whole = floor(layers);
  emitters[e].opened = min(emitters[e].opened + layers, 1.0);
  uint share = min(uint((layers - whole) * 4294967296.0), 0xffffff00u), phase = emitters[e].phase + share;
  uint due = uint(whole) + uint(phase < share);
  emitters[e].phase = phase;
  if (due == 0u) return open;
  emitters[e].due = min(emitters[e].due + due, 1000000u);
  emitters[e].age = closed + min(float(phase) / 4294967296.0 / rate, open);
  emitters[e].interval = 1.0 / rate;
  return open;
}

// Seconds until a rebuild is due for the next layer: when it is late by a part of itself, or has fallen by a part of a spacing.
float wait(uint e) {
  if (emitters[e].due > 0u) return 0.0;
  if (emitters[e].rate <= 0.0 || since(emitters[e].until, 0.0) > 0.0) return kNever;
  float acceleration = length(vec3(control.gravityX, control.gravityY, control.gravityZ));
  float left = float(~emitters[e].phase) / 4294967296.0 / emitters[e].rate;
  float late = min(kLateLayers / emitters[e].rate, sqrt(2.0 * kLateLayers * params.spacing / max(acceleration, 1.0e-20)));
  return max(-since(emitters[e].from, 0.0), 0.0) + left + late;
}

// Entries behind the last particle for the layers that are due, in the order of the emitters.
void makeRoom() {
  uint room = params.capacity - min(control.count, params.capacity), ids = kMaxIds - min(flow.nextId, kMaxIds);
  uint candidates = 0u;
  for (uint e = 0u; e < params.emitterCount; ++e) {
    uint layers = min(emitters[e].due, kMaxBornLayers), wanted = layers * emitters[e].points;
    uint taken = min(wanted, min(room, ids) - candidates);
    emitters[e].firstCandidate = candidates;
    emitters[e].layers = layers;
    emitters[e].due -= layers;
    emitters[e].waiting = emitters[e].due;
    candidates += taken;
    if (wanted > 0u) emitters[e].blocked = taken < wanted ? kNoRoom : 0u;
    if (taken < wanted && ids < room) flow.outOfIds = 1u;
    else if (taken < wanted) flow.full = 1u;
  }
  flow.firstBorn = control.count;
  flow.candidates = candidates;
  flow.nextId += candidates;
  control.count += candidates;
}

void main() {
  bool births = push.births != 0u;
  if (births ? (startsOn(kNoSubstep) >> kStartRebuild & 1u) == 0u : push.queued != 0u && control.timeLeft > 0.0) return;
  float blocked = 0.0, next = kNever, fastest = 0.0;
  for (uint e = 0u; e < params.emitterCount; ++e) {
    bool had = emitters[e].blocked != 0u;
    float open = account(e);
    if (had) {
      blocked = max(blocked, open);
      addTo(emitters[e].blockedHigh, emitters[e].blockedLow, open);
    }
    bool opens = emitters[e].rate > 0.0 && since(emitters[e].until, 0.0) <= 0.0 && since(emitters[e].from, 0.0) + push.advance > 0.0;
    if (opens) fastest = max(fastest, emitters[e].speed + emitters[e].motionSpeed);
  }
  addTo(flow.blockedHigh, flow.blockedLow, blocked);
  if (births) makeRoom();
  else control.emitterSpeed = fastest;
  for (uint e = 0u; e < params.emitterCount; ++e) next = min(next, wait(e));
  control.emissionWait = next;
  if (births) switchCommands(startsOn(kNoSubstep), 0u, 1u);  // over the new count
}
