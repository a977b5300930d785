// Fluid particles within the support of a point. The including shader declares the arrays `place` and `start` before, and then visit().
#include "shared/loops.glsl"
void visit(uint slot, vec3 to, float square);  // `to`: from the point, m; `square`: of the distance in supports

// False if kWhiteMaxVisits has cut the walk off.
bool walk(vec3 x) {
  const ivec3 cell = cellAt(x);
  const float inverse = 1.0 / (support() * support());
  uint left = kWhiteMaxVisits;
  for (int k = 0; k < 9; ++k) {
    const ivec2 near = cell.xy + ivec2(k / 3, k % 3) - 1;
    const uint column = columnOf(near), first = binOf(ivec3(near, cell.z - 1)), last = first + 2u;
    // Three cells along z are one range, or two at the end of the bins
    const uint parts = last < white.bins ? 1u : 2u;
    uint part = 0u;
    LOOP_WHILE (part < parts) {
      const uint low = part == 0u ? first : 0u, high = part == 0u ? min(last, white.bins - 1u) : last - white.bins;
      uint slot = startAt(low);
      const uint end = slot + min(startAt(high + 1u) - slot, left);
      left -= end - slot;
      LOOP_WHILE (slot < end) {
        const uvec4 there = placeAt(slot);
        const vec3 to = uintBitsToFloat(there.xyz) - x;
        const float square = dot(to, to) * inverse;
        if (square < 1.0 && there.w == column) visit(slot, to, square);
        ++slot;
      } LOOP_END(slot < end);
      ++part;
    } LOOP_END(part < parts);
  }
  return left > 0u;
}
