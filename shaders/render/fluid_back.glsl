// Where the fluid ends, as fluid_back.comp stores it: a depth whose last eight bits say how far it is to be trusted, and a normal, away
// from the eye, as x / z and y / z.
struct BackSample {
  float z;
  vec2 slope;
  float trust;  // 0 to 1
};
uvec2 noBack() { return uvec2(floatBitsToUint(1.0) & ~0xFFu, 0u); }
uvec2 packBack(float z, vec3 normal, float trust) {
  const vec2 slope = clamp(normal.xy / (abs(normal.z) > 1e-6 * length(normal) ? normal.z : 1e-6), vec2(-60.0), vec2(60.0));
  return uvec2((floatBitsToUint(z) & ~0xFFu) | uint(clamp(trust, 0.0, 1.0) * 255.0 + 0.5), packHalf2x16(slope));
}
BackSample unpackBack(uvec2 packed) {
  return BackSample(uintBitsToFloat(packed.x & ~0xFFu), unpackHalf2x16(packed.y), float(packed.x & 0xFFu) / 255.0);
}
