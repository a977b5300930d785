// The sky that fluids reflect and that lights the scenery, and the sunlight on a white surface. Needs `look`. With ENVIRONMENT, a binding
// number, it is an environment map.
#ifdef ENVIRONMENT
#include "shared/arrays.glsl"
READ_UINT(ENVIRONMENT, environment)

vec3 environmentTexel(uint first, ivec2 at, ivec2 size) {
  const uint texel = environmentAt(first + uint(at.y * size.x + at.x));
  // E5B9G9R9: nine-bit mantissas over 2^24, times two to the power of the upper five bits.
  return vec3(texel & 0x1FFu, (texel >> 9) & 0x1FFu, (texel >> 18) & 0x1FFu) * uintBitsToFloat(((texel >> 27) + 103u) << 23);
}

// Bilinear in a level of `rows` rows whose first texel is `first`; wraps around at the back.
vec3 environmentLevel(vec2 uv, uint first, int rows) {
  const ivec2 size = ivec2(2 * rows, rows);
  const vec2 at = uv * vec2(size) - 0.5, part = at - floor(at);
  const ivec2 base = ivec2(floor(at));
  const ivec2 columns = (ivec2(base.x, base.x + 1) + size.x) % size.x, lines = clamp(ivec2(base.y, base.y + 1), ivec2(0), ivec2(rows - 1));
  const vec3 a = environmentTexel(first, ivec2(columns.x, lines.x), size), b = environmentTexel(first, ivec2(columns.y, lines.x), size);
  const vec3 c = environmentTexel(first, ivec2(columns.x, lines.y), size), d = environmentTexel(first, ivec2(columns.y, lines.y), size);
  return mix(mix(a, b, part.x), mix(c, d, part.x), part.y);
}

// Equirectangular: rows from +y to -y, the middle column towards -z. The mean over `spread` rad, without the sun.
vec3 skyColor(vec3 direction, vec3 sun, float spread) {
  const vec2 flat_on = dot(direction.xz, direction.xz) > 1e-20 ? direction.xz : vec2(0.0, -1.0);
  const vec2 uv = vec2(atan(flat_on.x, -flat_on.y) * 0.15915494 + 0.5, acos(clamp(direction.y, -1.0, 1.0)) * 0.31830989);
  int rows = int(look.below.w);
  const float level = log2(max(spread * 0.31830989 * float(rows), 1.0));
  uint first = 0u;
  RILL_LOOP for (int k = int(level); k > 0 && rows > 1; --k) {
    first += uint(2 * rows * rows);
    rows = max(rows / 2, 1);
  }
  const vec3 fine = environmentLevel(uv, first, rows);
  const float part = fract(level);
  if (part <= 0.0 || rows == 1) return fine;
  return mix(fine, environmentLevel(uv, first + uint(2 * rows * rows), max(rows / 2, 1)), part);
}

vec3 sunlight() { return look.sunlight.rgb; }
const float kAmbientShare = 1.0, kSunShare = 1.0;

float skyShare(vec3 direction) { return 1.0; }  // the map covers all directions

vec3 skyLight(vec3 normal) { return mix(look.below.rgb, look.above.rgb, 0.5 + 0.5 * normal.y); }

#else
// A gradient with a bright band at the horizon and a wide soft light around the sun.
const vec3 kZenith = vec3(0.16, 0.30, 0.58);
const vec3 kHorizon = vec3(0.62, 0.74, 0.88);
const vec3 kGround = vec3(0.09, 0.13, 0.16);
// What ambient light and the sun add to a white surface.
const float kAmbientShare = 0.55, kSunShare = 0.8;

vec3 sunlight() { return vec3(1.0, 0.95, 0.88); }

float skyShare(vec3 direction) { return smoothstep(-0.08, 0.04, direction.y); }  // the rest is ground

vec3 skyColor(vec3 direction, vec3 sun, float spread) {
  const float up = direction.y;
  const vec3 above = mix(kHorizon, kZenith, pow(clamp(up, 0.0, 1.0), 0.55));
  const vec3 base = mix(kGround, above, skyShare(direction));
  const float near_sun = max(dot(direction, sun), 0.0);
  // A wide soft light overhead, whose reflected edges show curvature.
  const vec2 at = direction.xz / max(up, 1e-3) - vec2(-0.35, -0.55);
  const vec2 inside = smoothstep(vec2(1.5, 1.0), vec2(0.2, 0.1), abs(at));
  const vec3 lamp = vec3(1.0, 0.97, 0.92) * (up > 0.05 ? inside.x * inside.y * 0.9 : 0.0);
  return base + lamp + vec3(1.0, 0.93, 0.82) * 0.5 * pow(near_sun, 24.0);
}

vec3 skyLight(vec3 normal) { return mix(kGround, mix(kHorizon, kZenith, 0.4), 0.5 + 0.5 * normal.y); }
#endif
