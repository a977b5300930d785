// Mean normals: storage, which samples belong to one surface, and the filter's taps.

const float kMaxDepthChange = 4.0;  // in allowed depth changes: beyond it samples are of different surfaces

// A vector no longer than 1 in 32 bits, rounded to 1/1023 (x, y) and 1/511 (z).
uint packMean(vec3 n) {
  const ivec3 q = ivec3(round(n * vec3(1023.0, 1023.0, 511.0)));
  return uint(q.x & 0x7FF) | uint(q.y & 0x7FF) << 11 | uint(q.z & 0x3FF) << 22;
}
vec3 unpackMean(uint packed) {
  const ivec3 q = ivec3(bitfieldExtract(int(packed), 0, 11), bitfieldExtract(int(packed), 11, 11), bitfieldExtract(int(packed), 22, 10));
  return vec3(q) / vec3(1023.0, 1023.0, 511.0);
}

// Allowed depth change (m) at a distance of `across` m: a spacing and a quarter of the change that the slant of this normal implies.
// That suffices for level water seen at five degrees; the whole change would make whitewater coherent.
float allowedDepthChange(float spacing, float across, vec3 normal, vec3 sight) {
  return spacing + 0.25 * across / max(-dot(normal, sight), 0.04);
}
// Weight from 1 at the same depth to 0 at kMaxDepthChange * `change` (m), and 0 without fluid (infinite depth).
float sameSurface(float behind, float change) {
  const float off = behind / (kMaxDepthChange * change);
  return max(1.0 - off * off, 0.0);
}

// Taps on each side of a mean over some spacings: at most kTaps, with a stride where samples are denser.
const int kTaps = 12;
struct Taps {
  int stride;
  float apart;  // distance of two taps, relative to the reach
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
