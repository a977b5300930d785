// Shading tiles, the width of the domain's edges, and the storage of shaded pixels between passes.
uint shadeColumns() { return (view.width + kShadeTile - 1u) / kShadeTile; }
uint shadeTiles() { return shadeColumns() * ((view.height + kShadeTile - 1u) / kShadeTile); }
uvec2 shadeTileOrigin(uint tile) { return uvec2(tile % shadeColumns(), tile / shadeColumns()) * kShadeTile; }

float edgeHalfWidth() { return max(0.55, float(view.height) / 1600.0); }

// Linear RGB in 0 .. 1 as the square roots in 11, 11 and 10 bits.
uint packColor(vec3 color) {
  const uvec3 c = uvec3(sqrt(clamp(color, 0.0, 1.0)) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
  return c.r | c.g << 11 | c.b << 22;
}
vec3 unpackColor(uint packed) {
  const vec3 root = vec3(float(packed & 0x7FFu) / 2047.0, float((packed >> 11) & 0x7FFu) / 2047.0, float(packed >> 22) / 1023.0);
  return root * root;
}

// A rim: the nearest crossing of the owner's outline along x or y, if less than a pixel from the pixel's center. Bits 0 and 1: the
// direction +x, -x, +y (down), -y; above them the distance in 1/4096 pixel, of which 1 and more mean no rim.
const uint kNoRim = 4096u << 2;
uint packRim(uint side, float distance) { return side | uint(clamp(distance, 0.0, 1.0) * 4096.0) << 2; }
float rimDistance(uint rim) { return float(rim >> 2) / 4096.0; }
ivec2 rimStep(uint rim) {
  const uint side = rim & 3u;
  return ivec2(side == 0u ? 1 : (side == 1u ? -1 : 0), side == 2u ? 1 : (side == 3u ? -1 : 0));
}

// The rim of a sphere (view space) at a ray that hits it.
uint sphereRim(vec3 center, float radius, vec2 tangent) {
  const float middle = dot(center, vec3(tangent, 1.0)) / (1.0 + dot(tangent, tangent));
  const vec3 miss = center - middle * vec3(tangent, 1.0);
  const float off = length(miss);
  const bool across = abs(miss.x) >= abs(miss.y);
  const float slope = middle * max(abs(miss.x), abs(miss.y));  // derivative of off^2 / 2 along that axis
  if (slope <= 0.0) return kNoRim;
  const float distance = (radius - off) * off / slope * view.focal;
  return packRim(across ? (miss.x < 0.0 ? 0u : 1u) : (miss.y < 0.0 ? 3u : 2u), distance);
}
