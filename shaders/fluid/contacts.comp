#version 460
// Contacts of bodies with walls and other solids, a sample point an invocation: position-based (Mueller et al. 2020), all at once.
// COUNTS: counts the contacts of each body, which share its mass, so that together they do not correct too much (Tonge et al. 2012), and
// lists the points that may touch something, which the solving passes run over.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT(9, meshWord)
#define MESH_WORDS
#include "shared/loops.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"
layout(local_size_x = kFluidGroup) in;
READ_UINT4(2, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 3) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 4) readonly buffer TouchedBlock { TouchedRecord touched[]; };
layout(std430, binding = 5) readonly buffer ContactPointBlock { ContactPointRecord contactPoints[]; };
layout(std430, binding = 6) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 7) buffer SlipBlock { SlipRecord slips[]; };
// First, in x, how many; then points, and what they may touch: bits of TouchedRecord::solids, and kMayTouchWalls.
layout(std430, binding = 8) buffer ContactCandidateBlock { uvec2 contactCandidates[]; };
#ifdef COUNTS
layout(std430, binding = 10) buffer ContactCommandBlock { uint contactCommands[]; };
layout(std430, binding = 11) buffer ContactBodiesBlock { uint contactBodies[]; };
const bool kCounts = true;
#else
const bool kCounts = false;
#endif
layout(push_constant) uniform Push { ContactPush push; };
#include "fluid/bodies.glsl"
#include "fluid/solid_reaction.glsl"

// What a body touches. A wall, or a solid that is held or moves by itself, has no body.
struct Partner {
  uint name;    // as in SlipRecord
  uint body;
  float friction, restitution;
  vec3 moved;   // m, its displacement in the substep at the contact
  vec3 before;  // m/s, its velocity there before
};

Partner partnerOf(uint k, vec3 at) {
  SolidRecord solid = solidAt(k);
  PoseRecord pose = solid.pose;
  vec3 velocity = velocityAt(pose, at), before = velocity;
  uint n = solid.body;
  if (n != kNoBody && bodies[n].held != 0u) n = kNoBody;
  if (n != kNoBody) {
    PoseRecord s = bodies[n].state;
    bool advances = control.nextPhase == kPhaseAdvancing;
    before = advances ? velocityOf(s) + cross(angularVelocity(s), at - centerOf(bodies[n].predicted)) : vec3(0.0);
  }
  return Partner(k + 1u, n, solid.friction, solid.restitution, bodyStep() * velocity, before);
}

vec3 tangential(vec3 v, vec3 normal) { return v - dot(v, normal) * normal; }

// How far a unit impulse moves the partner along a unit vector, 1/kg, while its mass is split between its contacts. 0 if that is rounding.
float compliance(Partner p, vec3 at, vec3 direction) {
  if (p.body == kNoBody) return 0.0;
  BodyRecord b = bodies[p.body];
  float w = mobility(b, at, direction);
  return w > 1.0e-6 / b.mass ? float(max(b.contacts, 1u)) * w : 0.0;
}

// In units of the body's own mass, so that no other body decides how it is rounded.
void addImpulse(Partner p, vec3 impulse, vec3 at) {
  if (p.body != kNoBody) addToSolid(bodies[p.body].solid, centerOf(solidAt(bodies[p.body].solid).pose), impulse / bodies[p.body].mass, at);
}

SlipRecord slip;                                          // of the point
SlipRecord counted = SlipRecord(0u, 0.0, 0.0, 0.0, 0.0);  // the same in this substep
bool persists = false;                                    // it continues that of the last one

// Counts a contact of body n, and lists the body at its first.
void countContact(uint n) {
  if (n == kNoBody || atomicAdd(bodies[n].contacts, 1u) != 0u) return;
#ifdef COUNTS
  uint place = atomicAdd(contactBodies[1], 1u);
  contactBodies[kContactLists + kPointWorkgroups * params.bodyCount + place] = n;
  atomicMax(contactCommands[3], place / kFluidGroup + 1u);
#endif
}

// The slip of a point continues where it touches what it touched in the last substep, which added to it; else it begins at one of its
// contacts.
void count(Partner own, Partner other, vec3 normal) {
  countContact(own.body);
  countContact(other.body);
  if (persists) return;
  persists = slip.partner == other.name && control.phase == kPhaseAdvancing;
  vec3 slipped = vec3(0.0);
  if (persists) {
    slipped = tangential(vec3(slip.x, slip.y, slip.z) + control.step * (own.before - other.before), normal);
    float size = length(slipped);
    if (size > slip.limit) slipped *= slip.limit / size;
  }
  counted = SlipRecord(other.name, slipped.x, slipped.y, slipped.z, 0.0);
}

// A contact at `at`, `depth` deep; `normal` is outward from the partner.
void solve(Partner own, Partner other, vec3 at, vec3 normal, float depth) {
  float dt = bodyStep();
  vec3 moved = own.moved - other.moved;
  float approach = -dot(moved, normal), before = dot(own.before - other.before, normal);
  float correction = min(depth, approach + params.separationSpeed * dt);
  float restitution = max(own.restitution, other.restitution);
  if (before < -2.0 * dt * length(gravity())) correction = max(correction, approach - restitution * before * dt);
  float compliant = compliance(own, at, normal) + compliance(other, at, normal);
  if (compliant <= 0.0 || correction <= 0.0) return;
  float impulse = correction / compliant;
  bool continues = slip.partner == other.name;
  vec3 along = tangential(moved + (continues ? vec3(slip.x, slip.y, slip.z) : vec3(0.0)), normal), total = impulse * normal;
  float slipped = length(along);
  if (slipped > 0.0) {
    along /= slipped;
    float complianceAlong = compliance(own, at, along) + compliance(other, at, along);
    float limit = sqrt(own.friction * other.friction) * impulse * complianceAlong;
    if (continues && push.iteration == 0u) slip.limit = limit;
    if (complianceAlong > 0.0) total -= min(slipped, limit) / complianceAlong * along;
  }
  addImpulse(own, total, at);
  addImpulse(other, -total, at);
}

void touch(Partner own, Partner other, vec3 at, vec3 normal, float depth) {
  if (own.body == kNoBody && other.body == kNoBody) return;
  if (kCounts)
    count(own, other, normal);
  else
    solve(own, other, at, normal, depth);
}

#ifdef COUNTS
// Of all points of the bodies that touched_solids.comp lists, a workgroup for up to kFluidGroup points of one.
bool pointAt(out uint n, out uint candidates) {
  uint listed = contactBodies[kContactLists + flatGroup()], body = listed / kPointWorkgroups;
  n = bodies[body].firstPoint + listed % kPointWorkgroups * kFluidGroup + gl_LocalInvocationID.x;
  candidates = ((1u << touched[body].count) - 1u) | (touched[body].walls != 0u ? kMayTouchWalls : 0u);
  return flatGroup() < contactBodies[0] && n < params.contactPoints && contactPoints[n].body == body;
}

void listPoint(uint n, uint found) {
  if (found == 0u) return;
  uint place = atomicAdd(contactCandidates[0].x, 1u);
  contactCandidates[place + 1u] = uvec2(n, found);
  atomicMax(contactCommands[0], place / kFluidGroup + 1u);
}
#else
bool pointAt(out uint n, out uint candidates) {
  uint k = flatInvocation(), count = contactCandidates[0].x;
  uvec2 point = contactCandidates[min(k + 1u, count)];
  n = point.x;
  candidates = point.y;
  return k < count;
}
#endif

// How deep a sphere is in the wall at a side of the domain.
float depthAtWall(uint side, vec3 center, float radius) {
  uint a = side >> 1;
  return radius - ((side & 1u) != 0u ? wallsHigh()[a] - center[a] : center[a] - wallsLow()[a]);
}

void main() {
  uint n, candidates, found = 0u;
  if (!pointAt(n, candidates)) return;
  uint body = contactPoints[n].body;
  ContactPointRecord point = contactPoints[n];
  slip = slips[n];
  uint own = bodies[body].solid;
  PoseRecord pose = solidAt(own).pose;
  vec3 center = centerOf(pose) + toScene(pose, vec3(point.x, point.y, point.z));
  float margin = kCounts ? contactMargin() : 0.0;
  // One loop over walls, then solids: CPU drivers execute what is in a loop at least once.
  uint sides = 0u, left = candidates & ~kMayTouchWalls;
  for (uint side = 0u; side < 6u; ++side) sides |= uint(depthAtWall(side, center, point.radius) > -margin) << side;
  if ((candidates & kMayTouchWalls) == 0u) sides = 0u;
  bool more = (sides | left) != 0u;
  LOOP_WHILE (more) {
    bool wall = sides != 0u;
    uint side = wall ? uint(findLSB(sides)) : 0u, m = left != 0u ? uint(findLSB(left)) : 0u, k = wall ? own : touched[body].solids[m];
    SolidRecord s = solidAt(k);
    vec3 normal;
    float depth = -margin;
    if (wall) {
      depth = depthAtWall(side, center, point.radius);
      normal = mix(vec3(0.0), vec3((side & 1u) != 0u ? -1.0 : 1.0), equal(uvec3(side >> 1), uvec3(0u, 1u, 2u)));
    } else if (!isBeyond(centerOf(s.pose), s.radius, center, point.radius + params.spacing)) {
      depth = point.radius - surfaceDistance(s.shape, localPoint(s.pose, center), normal);
      normal = toScene(s.pose, normal);
    }
    if (depth > -margin) {
      found |= wall ? kMayTouchWalls : 1u << m;
      vec3 at = center - point.radius * normal;
      Partner partner = partnerOf(own, at), other = partnerOf(k, at);
      if (wall) other = Partner(kWallPartner + side, kNoBody, partner.friction, 0.0, vec3(0.0), vec3(0.0));
      touch(partner, other, at, normal, depth);
    }
    if (wall) sides &= sides - 1u;
    else left &= left - 1u;
    more = (sides | left) != 0u;
  } LOOP_END(more);
  slips[n] = kCounts ? counted : slip;
#ifdef COUNTS
  listPoint(n, found);
#endif
}
