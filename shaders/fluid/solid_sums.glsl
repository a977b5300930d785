// The sums of solids (shared/solid_loads.h): adds to them, and takes them. Needs `params` and the storage array `solidSums`.
#ifndef RILL_SOLID_SUMS_GLSL
#define RILL_SOLID_SUMS_GLSL
#include "shared/solid_loads.h"

// Adds `high` 2^24 + `low` to the sum at `word`.
void addWide(uint word, int high, uint low) {
  if (high == 0 && low == 0u) return;
  uint carry, add = uaddCarry(uint(high) << 24, low, carry), old = atomicAdd(solidSums[word], add);
  uint above = uint(high >> 8) + carry + uint(old + add < old);
  if (above != 0u) atomicAdd(solidSums[word + 1u], above);
}

// A number of units as high 2^24 + low; 0 for one that is not finite.
void split(float units, out int high, out uint low) {
  const float kMaxUnits = kMaxDisplacement / kDisplacementUnits;
  float whole = isWithin(vec3(units), 3.0e38) ? round(clamp(units, -kMaxUnits, kMaxUnits)) : 0.0, upper = floor(whole / 16777216.0);
  high = int(upper);
  low = uint(whole - upper * 16777216.0);
}

// The sum at `word`, in units; it begins anew.
float takeSum(uint word) {
  uint low = solidSums[word], high = solidSums[word + 1u];
  solidSums[word] = 0u;
  solidSums[word + 1u] = 0u;
  bool negative = high >= 0x80000000u;
  if (negative) {
    low = ~low + 1u;
    high = ~high + uint(low == 0u);
  }
  float size = float(high) * 4294967296.0 + float(low);
  return negative ? -size : size;
}

// m, or m^2 of a moment, from units. In an order in which no product is denormal.
float toDisplacement(uint component, float units) {
  float displacement = units * kDisplacementUnits * params.spacing;
  return component < 3u ? displacement : displacement * params.loadLever;
}
#endif
