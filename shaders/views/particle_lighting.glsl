// Lights of the particle view: a warm key light, a cool sky and a neutral ground. Linear RGB.
const vec3 kKey = vec3(0.92, 0.88, 0.80);     // radiance reflected by a white surface
const vec3 kSky = vec3(0.44, 0.50, 0.58);     // ambient light from above
const vec3 kGround = vec3(0.20, 0.19, 0.18);  // ambient light from below

// Surroundings in unlit pictures: grays below the darkest color of every map (0.022 in linear gray).
const vec3 kPlain = vec3(0.006);
const vec3 kPlainGrid = vec3(0.012);
const vec3 kPlainSolid = vec3(0.018);  // brightest value; also the domain's edges

vec3 ambient(vec3 normal) { return mix(kGround, kSky, 0.5 + 0.5 * normal.y); }
