// The sky that fluids reflect and that lights the scenery: a gradient, a bright band near the horizon, a wide soft light around the sun.
const vec3 kZenith = vec3(0.16, 0.30, 0.58);
const vec3 kHorizon = vec3(0.62, 0.74, 0.88);
const vec3 kGround = vec3(0.20, 0.20, 0.21);

vec3 skyColour(vec3 direction, vec3 sun) {
  const float up = direction.y;
  const vec3 above = mix(kHorizon, kZenith, pow(clamp(up, 0.0, 1.0), 0.55));
  const vec3 base = mix(kGround, above, smoothstep(-0.08, 0.04, up));
  const float near_sun = max(dot(direction, sun), 0.0);
  // A wide soft light overhead: its edges show how a surface curves.
  const vec2 at = direction.xz / max(up, 1e-3) - vec2(-0.35, -0.55);
  const vec2 inside = smoothstep(vec2(1.5, 1.0), vec2(0.2, 0.1), abs(at));
  const vec3 lamp = vec3(1.0, 0.97, 0.92) * (up > 0.05 ? inside.x * inside.y * 0.9 : 0.0);
  return base + lamp + vec3(1.0, 0.93, 0.82) * 0.5 * pow(near_sun, 24.0);
}
