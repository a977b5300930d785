// Fluid particles within the support of a point. The including shader declares the arrays `place` and `start` before, and then visit().
#include "shared/loops.glsl"
void visit(uint slot, vec3 to, float square);  // `to`: from the point, m; `square`: of the distance in supports

// False if kWhiteMaxVisits has cut the walk off.
bool walk(vec3 x) {
  const ivec3 cell = cellAt(x);
  const float inverse = 1.0 / (support() * support());
  const vec3 within = x / support() - vec3(cell);
  uint left = kWhiteMaxVisits;
  for (int k = 0; k < 9; ++k) {
    const ivec2 to = ivec2(k / 3, k % 3) - 1, near = cell.xy + to;
    const vec2 gap = mix(mix(vec2(0.0), within.xy, lessThan(to, ivec2(0))), 1.0 - within.xy, greaterThan(to, ivec2(0)));
    const float free = 1.0 - dot(gap, gap), reach = sqrt(max(free, 0.0));
    // Cells along z are one range, or two at the end of the bins
    const int below = within.z < reach ? 1 : 0, above = 1.0 - within.z < reach ? 1 : 0;
    const uint column = columnOf(near), first = binOf(ivec3(near, cell.z - below)), last = first + uint(below + above);
    const uint parts = free <= 0.0 ? 0u : last < white.bins ? 1u : 2u;
    uint part = 0u;
    LOOP_WHILE (part < parts) {
      const uint low = part == 0u ? first : 0u, high = part == 0u ? min(last, white.bins - 1u) : last - white.bins;
      uint slot = startAt(low);
      const uint end = slot + min(startAt(high + 1u) - slot, left);
      left -= end - slot;
      LOOP_WHILE (slot < end) {
        const uvec4 neighbor = placeAt(slot);
        const vec3 off = uintBitsToFloat(neighbor.xyz) - x;
        const float square = dot(off, off) * inverse;
        if (square < 1.0 && neighbor.w == column) visit(slot, off, square);
        ++slot;
      } LOOP_END(slot < end);
      ++part;
    } LOOP_END(part < parts);
  }
  return left > 0u;
}
