#version 460
// Adds each photon's light to the texels of the map where it lands, over the width of its beam, in whole numbers whose sum is kept.
// With SOLIDS the map has a second layer, for them.
#extension GL_GOOGLE_include_directive : require
#include "render/caustics.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kCausticGroup) in;
READ_UINT4(1, landings)
layout(std430, set = 0, binding = 2) buffer Sums { uint sums[]; };

const float kSunDisc = 0.0093;  // rad, of its diameter
const float kWidest = 2.5;      // texels, half the width of a beam at most; wider ones are summed in coarse texels

// To a neighbor's place; false where it has no photon on the same receiver.
bool beamTo(ivec2 other, vec2 place, float path, ivec2 size, out vec2 beam) {
  beam = vec2(0.0);
  if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) return false;
  const uvec4 next = landingsAt(uint(other.y * size.x + other.x));
  beam = uintBitsToFloat(next.xy) - place;
  return unpackHalf2x16(next.w).y * path > 0.0 && all(lessThan(abs(beam), vec2(1e5)));
}

// How far apart neighbors land; without any, as far as they started.
vec2 beamAlong(ivec2 own, ivec2 along, vec2 place, float path, ivec2 size) {
  vec2 after, before;
  const bool has_after = beamTo(own + along, place, path, size, after), has_before = beamTo(own - along, place, path, size, before);
  return has_after ? after : has_before ? -before : vec2(along);
}

void main() {
  const uint index = invocation();
  const ivec2 size = fineSize();
  if (index >= uint(size.x * size.y)) return;
  const uvec4 own = landingsAt(index);
  const vec2 last = unpackHalf2x16(own.w);
  if (last.y == 0.0) return;
  vec2 place = uintBitsToFloat(own.xy);
  if (!all(lessThan(abs(place), vec2(1e5)))) return;
  const vec3 counts = vec3(unpackHalf2x16(own.z), last.x) * sun.flux;
  const ivec2 at = ivec2(index % uint(size.x), index / uint(size.x));
  const vec2 beam = abs(beamAlong(at, ivec2(1, 0), place, last.y, size)) + abs(beamAlong(at, ivec2(0, 1), place, last.y, size));
  const float disc = kSunDisc * abs(last.y);
  // caustics_resolve.comp widens by another half texel
  vec2 wide = sqrt(beam * beam + disc * disc) - 0.5;
#ifdef SOLIDS
  const uint layer = last.y < 0.0 ? 1u : 0u, layers = 2u;
#else
  const uint layer = 0u, layers = 1u;
#endif
  const bool coarse = max(wide.x, wide.y) > kWidest;
  const ivec2 side = coarse ? coarseSize() : size;
  const uint start = coarse ? coarseSums(layer, layers) : fineSums(layer);
  if (coarse) {
    place = (place + 0.5) / float(kCausticCoarse) - 0.5;
    wide /= float(kCausticCoarse);
  }
  wide = clamp(wide, vec2(1.0), vec2(kWidest));
  // A tent, whose shares are made to add up to 1: by a loop of one length for all, because lavapipe lost turns of one of its own for each
  const ivec2 low = ivec2(ceil(place - wide)), high = ivec2(floor(place + wide));
  vec2 whole = vec2(0.0);
  RILL_LOOP for (int k = 0; k <= 2 * int(kWidest); ++k) whole += max(1.0 - abs(vec2(low + k) - place) / wide, vec2(0.0));
  const float scale = 1.0 / (whole.x * whole.y);
  const int columns = high.x - low.x + 1, taps = columns * (high.y - low.y + 1);
  float share = 0.0;
  uvec3 given = uvec3(0u);
  for (int k = 0; k < taps; ++k) {
    const ivec2 texel = low + ivec2(k % columns, k / columns);
    const vec2 tent = max(1.0 - abs(vec2(texel) - place) / wide, vec2(0.0));
    share += tent.x * tent.y * scale;
    const uvec3 next = max(uvec3(counts * min(share, 1.0) + 0.5), given), amount = next - given;
    given = next;
    if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, side))) {
      const uint first = 3u * (start + uint(texel.y * side.x + texel.x));
      for (uint c = 0u; c < 3u; ++c)
        if (amount[c] > 0u) atomicAdd(sums[first + c], amount[c]);
    }
  }
}
