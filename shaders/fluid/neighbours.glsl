// Visits the neighbours of a particle: from its list, or by walking the grid where there is no list or it overflowed.
// The shader defines `void visit(uint j, vec4 particle)` before it includes this, and binds at 2 the array whose elements are handed over.
// With TEXEL the arrays are uniform texel buffers (twice as fast on lavapipe: a storage load is made lane by lane there), else storage buffers.
#ifndef RILL_NEIGHBOURS_GLSL
#define RILL_NEIGHBOURS_GLSL
#include "fluid/walk.glsl"
layout(constant_id = 1) const uint LIST_CAPACITY = 0;  // 0: no list

layout(std430, binding = 6) readonly buffer StartBlock { uint cellStart[]; };
layout(std430, binding = 7) buffer SumsBlock { FluidSums sums; };

void visitNeighbours(uint i, uint local) {
  uint count = LIST_CAPACITY == 0u ? 0u : COUNT_OF(i);
  bool listed = LIST_CAPACITY != 0u && count <= LIST_CAPACITY;
  if (LIST_CAPACITY != 0u) {
    uint at = (local / kListBlock) * (kListBlock * (LIST_CAPACITY / 4u)) + local % kListBlock;
    uint groups = listed ? (count + 3u) / 4u : 0u;
    for (uint k = 0u; k < groups; ++k) {
      uvec4 js = LIST_AT(at);
      vec4 x = PARTICLE(js.x), y = PARTICLE(js.y), z = PARTICLE(js.z), w = PARTICLE(js.w);
      visit(js.x, x);
      visit(js.y, y);
      visit(js.z, z);
      visit(js.w, w);
      at += kListBlock;
    }
  }
  if (!listed) {
    uvec3 home = cellFromKey(KEY_OF(i));
    WALK_GRID(i, home, , visit)
  }
}
#endif
