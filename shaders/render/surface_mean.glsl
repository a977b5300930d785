// Means of normals: how they are stored, what counts as one piece of water, and what they are taken over.

const float kSameWater = 4.0;  // times what depth may change by between faces of one piece of water

// In 32 bits: no longer than 1, rounded to 1 / 1023 and, of z, 1 / 511.
uint packMean(vec3 n) {
  const ivec3 q = ivec3(round(n * vec3(1023.0, 1023.0, 511.0)));
  return uint(q.x & 0x7FF) | uint(q.y & 0x7FF) << 11 | uint(q.z & 0x3FF) << 22;
}
vec3 unpackMean(uint packed) {
  const ivec3 q = ivec3(bitfieldExtract(int(packed), 0, 11), bitfieldExtract(int(packed), 11, 11), bitfieldExtract(int(packed), 22, 10));
  return vec3(q) / vec3(1023.0, 1023.0, 511.0);
}

// What depth may change by to a face `across` m away, m: a spacing, and a quarter of what this
// face's own slant makes of the way. That is enough for even water seen at five degrees; with all
// of it torn water, whose faces are slanted anyhow, would be even, too.
float changeOf(float spacing, float across, vec3 normal, vec3 sight) { return spacing + 0.25 * across / max(-dot(normal, sight), 0.04); }
// From 1 at the same depth to 0 at kSameWater times `change` (m), and where there is no fluid (infinite).
float sameWater(float behind, float change) {
  const float off = behind / (kSameWater * change);
  return max(1.0 - off * off, 0.0);
}

// Samples that a mean over some spacings looks at on each side: kTaps at most, and where they lie
// closer than that, every second or third one.
const int kTaps = 12;
struct Taps {
  int stride;
  float apart;  // of the reach
};
Taps tapsOver(float spacings, float z) {
  const float side = max(metersAPixel(z) * float(view.step) / (spacings * spacingAt(z)), 1e-3);
  const int stride = int(max(1.0 / (side * float(kTaps)) + 0.5, 1.0));
  return Taps(stride, side * float(stride));
}
float tapWeight(Taps taps, int k) {
  const float off = float(k) * taps.apart, inside = max(1.0 - off * off, 0.0);
  return inside * inside;
}
