// The light that a solid sends back to the eye. Needs scenery.glsl.
const vec3 kSolidAlbedo = vec3(0.66, 0.50, 0.36);

vec3 litSolid(vec3 p, vec3 normal, vec3 albedo) {
  const float facing = max(dot(normal, scene.light_to.xyz), 0.0);
  const float bias = scene.light_texel.x * (1.0 + 2.0 * sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.1));
  const vec3 direct = reaching(sunlight() * facing, p, bias, metersAPixel(viewPoint(p).z), true);
  return albedo * (kAmbientShare * skyLight(normal) + kSunShare * direct);
}
