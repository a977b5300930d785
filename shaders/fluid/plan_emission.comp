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

void addBlockedTime(float seconds) {
  precise float sum = flow.blockedHigh + (seconds + flow.blockedLow);
  precise float rest = (flow.blockedHigh - sum) + (seconds + flow.blockedLow);
  flow.blockedHigh = sum;
  flow.blockedLow = rest;
}

// Layers that have left the mouth since it was last accounted for. Returns the seconds in which it was open.
float account(uint e) {
  float all = since(emitters[e].doneHigh, emitters[e].doneLow);
  emitters[e].doneHigh = control.timeHigh;
  emitters[e].doneLow = control.timeLow;
  float late = max(since(emitters[e].until, 0.0), 0.0);
  float open = max(min(all, since(emitters[e].from, 0.0)) - late, 0.0);
  emitters[e].late = late;
  float layers = emitters[e].rate * open, whole = floor(layers);
  uint share = min(uint((layers - whole) * 4294967296.0), 0xffffff00u), before = emitters[e].phase;
  emitters[e].phase = before + share;
  uint due = emitters[e].due + uint(min(whole, 1.0e6)) + uint(before + share < before);
  if (emitters[e].rate <= 0.0) due = 0u;  // the host has closed it
  if (due > kMaxDueLayers) emitters[e].blocked = 1u;
  emitters[e].due = min(due, kMaxDueLayers);
  return open;
}

// Seconds until a rebuild is due for the next layer.
float wait(uint e) {
  if (emitters[e].due > 0u) return 0.0;
  if (emitters[e].rate <= 0.0 || emitters[e].late > 0.0) return kNever;
  float left = float(~emitters[e].phase) / 4294967296.0;
  return max(-since(emitters[e].from, 0.0), 0.0) + (left + kLateLayers) / emitters[e].rate;
}

// Entries behind the last particle for the layers that are due, in the order of the emitters.
void makeRoom() {
  uint room = params.capacity - min(control.count, params.capacity), ids = kMaxIds - min(flow.nextId, kMaxIds);
  uint candidates = 0u;
  for (uint e = 0u; e < params.emitterCount; ++e) {
    uint wanted = emitters[e].due * emitters[e].points, taken = min(wanted, min(room, ids) - candidates);
    emitters[e].firstCandidate = candidates;
    emitters[e].layers = emitters[e].due;
    emitters[e].due = 0u;
    candidates += taken;
    if (wanted > 0u) emitters[e].blocked = uint(taken < wanted);
    if (taken < wanted && ids < room) flow.outOfIds = 1u;
    else if (taken < wanted) flow.full = 1u;
  }
  flow.firstBorn = control.count;
  flow.candidates = candidates;
  flow.nextId += candidates;
  control.count += candidates;
}

void main() {
  bool rebuilds = (startsOn(kNoSubstep) >> kStartRebuild & 1u) != 0u;
  if (push.births != 0u && !rebuilds) return;
  float blocked = 0.0, next = kNever, fastest = 0.0;
  for (uint e = 0u; e < params.emitterCount; ++e) {
    bool had = emitters[e].blocked != 0u;
    float open = account(e);
    if (had) blocked = max(blocked, open);
    bool opens = emitters[e].rate > 0.0 && emitters[e].late <= 0.0 && since(emitters[e].from, 0.0) + push.advance > 0.0;
    if (opens) fastest = max(fastest, emitters[e].speed);
  }
  addBlockedTime(blocked);
  if (push.births != 0u) makeRoom();
  else control.emitterSpeed = fastest;
  for (uint e = 0u; e < params.emitterCount; ++e) next = min(next, wait(e));
  control.emissionWait = next;
  if (push.births != 0u) switchCommands(startsOn(kNoSubstep), 0u, 1u);  // over the new count
}
