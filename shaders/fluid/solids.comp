#version 460
// The density that solids, and their images behind walls, displace near a particle, and its gradient, from
// the tables of engine/sph/solid_density.hpp; the tangential scale from their coverage (solid_coverage.glsl); and the stiffness of bodies.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/images.glsl"
#include "shared/loops.glsl"
#include "shared/arrays.glsl"
READ_UINT(9, meshWord)
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"
READ_UINT4(3, nearSolids)
#include "fluid/near_solids.glsl"
#include "fluid/solid_coverage.glsl"
layout(local_size_x = kFluidGroup) in;

layout(push_constant) uniform Push { DisplacePush push; };
READ_FLOAT4(2, place)
layout(std430, binding = 4) buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(5, table)  // value and slope of a node, and of the next one
READ_UINT4(6, solids)  // SolidRecord
#include "fluid/solid_array.glsl"
layout(std430, binding = 7) writeonly buffer DisplacedBlock { vec4 nearDisplaced[]; };
layout(std430, binding = 8) writeonly buffer TangentialBlock { vec4 nearTangential[]; };

#include "fluid/solid_density.glsl"
READ_UINT4(10, bodies)  // BodyRecord
#include "fluid/body_array.glsl"
layout(std430, binding = 11) writeonly buffer StiffnessBlock { float nearStiffness[]; };
layout(std430, binding = 12) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 14) writeonly buffer InReachBlock { uvec2 inReach[]; };  // entries, and NearSolids::mask of those in reach
layout(std430, binding = 13) writeonly buffer SampledBlock { uint nearSampled[]; };  // of each entry, see NearSolids::mask
READ_UINT(15, listHead)
#include "fluid/sleeping.glsl"
#include "fluid/bodies.glsl"
#include "fluid/solid_sums.glsl"
#include "fluid/solid_reach.glsl"

// What a body adds to D of a particle at x, where it displaces `gradient`: see docs/notes/bodies.md. Adds the particle to the sum that the
// next substep takes.
float stiffnessOf(uint k, uint body, vec3 gradient, vec3 x) {
  if (body == kNoBody) return 0.0;
  BodyRecord b = bodyAt(body);
  float root = sqrt(mobility(b, x, gradient));
  float added = root * params.spacing * sqrt(b.mass);
  float counted = added < kMaxStiffness ? added : (added >= kMaxStiffness ? kMaxStiffness : 0.0);  // NaN: nothing
  uint units = uint(counted / kStiffnessUnits + 0.5);
  if (push.begins != 0u) addWide(k * kSolidSumWords + kStiffnessSum, 0, units);
  return b.held != 0u ? 0.0 : root * b.stiffness;
}

// The listed solids whose bounding box along their own axes is within the support or the reach of x. CPU drivers execute all of a loop's
// body for every solid that any lane has.
NearSolids solidsWithin(NearSolids near, vec3 x) {
  if (near.all) return near;
  NearSolids within = near;
  within.mask = 0u;
  float limit = max(params.support, maxReach());
  uint m = 0u, k;
  bool some = nextSolid(near, m, k);
  LOOP_WHILE (some) {
    SolidRecord s = solidAt(k);
    vec3 half_ = s.shape.kind == kShapeSphere ? vec3(s.shape.halfX) : halfExtents(s.shape), beyond = abs(localPoint(s.pose, x)) - half_;
    bool mesh = MESHES && s.shape.kind == kShapeMesh;  // a sheet is thicker than its bounds
    if (mesh || max(beyond.x, max(beyond.y, beyond.z)) < limit) within.mask |= 1u << m;
    ++m;
    some = nextSolid(near, m, k);
  } LOOP_END(some);
  return within;
}

void main() {
  uint n = flatInvocation();
  if (n >= sums.nearSolids) return;
  NearSolids near = nearSolidsOf(n);
  uint i = near.particle;
  if (REGIONS && i >= control.solved && push.measures == 0u) return;  // figures alone see what is far from all that moves
  vec3 x = placeAt(i).xyz;
  SolidCoverage coverage = SolidCoverage(vec3(0.0), vec3(0.0));
  vec4 displaced = vec4(0.0);
  float stiffness = 0.0;
  uint sampled = near.all ? 0xffffffffu : 0u, reached = 0u;
  Images images = imagesNear(x, params.support);
  bool more = true;
  LOOP_WHILE (more) {
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    NearSolids within = solidsWithin(near, image);
    uint m = 0u, k;
    bool some = nextSolid(within, m, k);
    LOOP_WHILE (some) {
      SolidRecord s = solidAt(k);
      float distance;
      vec4 solid = solidSample(s, image, distance);
      if (signs == vec3(1.0) && distance < reachOf(s)) reached |= 1u << min(m, 31u);
      if (solid != vec4(0.0)) {
        if (!near.all) sampled |= 1u << m;
        solid *= shareOfImage(s, image);
        if (BODIES) stiffness += stiffnessOf(k, s.body, solid.xyz, image);
        solid.xyz *= signs;
        displaced += solid;
        cover(coverage, solid.w, solid.xyz);
      }
      ++m;
      some = nextSolid(within, m, k);
    } LOOP_END(some);
    more = advance(images);
  } LOOP_END(more);
  nearDisplaced[i] = displaced;
  nearTangential[i] = packSolidScale(coverage);
  if (BODIES) nearStiffness[i] = stiffness;
  if (LOADS) nearSampled[n] = sampled;
  if (push.begins != 0u && reached != 0u && !isAsleep(i)) inReach[atomicAdd(sums.inReach, 1u)] = uvec2(n, reached);
}
