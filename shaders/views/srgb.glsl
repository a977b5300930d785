#ifndef RILL_SRGB_GLSL
#define RILL_SRGB_GLSL
vec3 decodeSrgb(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(c, vec3(0.04045)))); }

// Encodes a linear color as an RGBA8 sRGB pixel. The power is a polynomial of the square root, within 0.1/255.
uint encodeSrgb(vec3 linear) {
  const vec3 c = clamp(linear, 0.0, 1.0), r = sqrt(c);
  const vec3 power = ((((0.5173121 * r - 1.623691) * r + 2.031615) * r - 1.402758) * r + 1.517956) * r - 0.04010996;
  const uvec3 bytes = uvec3(min(mix(12.92 * c, power, vec3(greaterThan(c, vec3(0.0031308)))), 1.0) * 255.0 + 0.5);
  return bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
#endif
