#version 460
// The solids that each body may touch in the substep at hand: those whose surface its bounding sphere reaches, and
// whose bounding box its own box reaches. Lists the bodies whose contact points are to be tested.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/arrays.glsl"
READ_UINT(6, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
layout(local_size_x = kFluidGroup) in;
READ_UINT4(2, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 3) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 4) writeonly buffer TouchedBlock { TouchedRecord touched[]; };
layout(std430, binding = 5) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 7) buffer ContactBodiesBlock { uint contactBodies[]; };
layout(std430, binding = 8) buffer PointCommandBlock { uint pointCommands[]; };
#include "fluid/bodies.glsl"

#include "shared/loops.glsl"
const uint kMaxNear = 4u * kMaxTouched;

// Half extents of the bounding box along the solid's axes.
vec3 boundsOf(SolidRecord s) { return s.shape.kind == kShapeSphere ? vec3(s.shape.halfX) : halfExtents(s.shape); }
vec3 middleOf(SolidRecord s) { return centerOf(s.pose) + (MESHES ? toScene(s.pose, middleOf(s.shape)) : vec3(0.0)); }

// Half extents of the bounding box of s along the axes of the scene, and, below, along those of a.
vec3 alongScene(SolidRecord s) {
  vec3 b = boundsOf(s);
  if (s.shape.kind == kShapeSphere) return b;
  return abs(toScene(s.pose, vec3(b.x, 0.0, 0.0))) + abs(toScene(s.pose, vec3(0.0, b.y, 0.0))) + abs(toScene(s.pose, vec3(0.0, 0.0, b.z)));
}
vec3 alongAxesOf(SolidRecord a, SolidRecord s) {
  vec3 b = boundsOf(s);
  if (s.shape.kind == kShapeSphere) return b;
  vec3 x = toScene(s.pose, vec3(b.x, 0.0, 0.0)), y = toScene(s.pose, vec3(0.0, b.y, 0.0)), z = toScene(s.pose, vec3(0.0, 0.0, b.z));
  return abs(toSolid(a.pose, x)) + abs(toSolid(a.pose, y)) + abs(toSolid(a.pose, z));
}

// m, how far two bounding boxes are apart at least, by the axes of a: negative if they overlap there.
float apartAlong(SolidRecord a, SolidRecord b) {
  vec3 gap = abs(toSolid(a.pose, middleOf(b) - middleOf(a))) - boundsOf(a) - alongAxesOf(a, b);
  return max(gap.x, max(gap.y, gap.z));
}

// Lists the points of a body that may touch something. One that might before has slips that end.
void listBody(uint n, bool found) {
  if (bodyStep() <= 0.0) return;
  bool tested = found || bodies[n].mayTouch != 0u;
  bodies[n].mayTouch = uint(found);
  if (!tested) return;
  uint end = n + 1u < params.bodyCount ? bodies[n + 1u].firstPoint : params.contactPoints;
  uint groups = divideUp(end - bodies[n].firstPoint, kFluidGroup), place = atomicAdd(contactBodies[0], groups);
  for (uint g = 0u; g < groups; ++g) contactBodies[kContactLists + place + g] = n * kPointWorkgroups + g;
  atomicMax(pointCommands[0], place + groups);
}

void main() {
  uint n = flatInvocation();
  if (n >= params.bodyCount) return;
  uint own = bodies[n].solid, count = 0u, skipped = 0u;
  bodies[n].contacts = 0u;
  vec3 middle = centerOf(bodies[n].predicted);
  float reach = bodies[n].radius + contactMargin();
  // First by bounding spheres: CPU drivers execute all of a loop's body for every solid.
  uint near[kMaxNear], nearCount = 0u;
  for (uint first = 0u; first < params.solidCount; first += 32u) {
    uint mask = 0u, end = min(first + 32u, params.solidCount);
    for (uint k = first; k < end; ++k) {
      SolidRecord s = solidAt(k);
      bool beyond = isBeyond(centerOf(s.pose), s.radius, middle, reach + params.spacing);  // as in outside.glsl
      mask |= uint(k != own && !beyond) << (k - first);
    }
    LOOP_WHILE (mask != 0u) {
      if (nearCount < kMaxNear)
        near[nearCount++] = first + uint(findLSB(mask));
      else
        ++skipped;
      mask &= mask - 1u;
    } LOOP_END(mask != 0u);
  }
  SolidRecord self = solidAt(own);
  float slack = contactMargin() + (MESHES ? 1.0 : 0.01) * params.spacing;  // a sheet is thicker than its bounds; rounding
  uint m = 0u;
  bool more = nearCount > 0u;
  LOOP_WHILE (more) {
    uint k = near[m];
    SolidRecord s = solidAt(k);
    vec3 normal;
    bool reaches = surfaceDistance(s.shape, localPoint(s.pose, middle), normal) <= reach;
    if (reaches && max(apartAlong(self, s), apartAlong(s, self)) <= slack) {
      if (count < kMaxTouched)
        touched[n].solids[count++] = k;
      else
        ++skipped;
    }
    ++m;
    more = m < nearCount;
  } LOOP_END(more);
  vec3 bounds = alongScene(self) + slack;
  bool walls = any(lessThan(middleOf(self) - bounds, wallsLow())) || any(greaterThan(middleOf(self) + bounds, wallsHigh()));
  touched[n].count = count;
  touched[n].walls = uint(walls);
  if (skipped > 0u) atomicAdd(sums.boundHits, skipped);
  listBody(n, count > 0u || walls);
}
