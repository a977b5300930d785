// The studio: a warm key light, a cool sky, a neutral backdrop. Linear light.
const vec3 kKey = vec3(0.92, 0.88, 0.80);     // the key light, as reflected by white
const vec3 kSky = vec3(0.44, 0.50, 0.58);     // ambient light from above
const vec3 kGround = vec3(0.20, 0.19, 0.18);  // and from below

// Unlit, around the particles: grays below the darkest color of every map (0.022 in linear gray).
const vec3 kPlain = vec3(0.006);
const vec3 kPlainGrid = vec3(0.012);
const vec3 kPlainSolid = vec3(0.018);  // where it is lit best; the domain's edges, too

vec3 ambient(vec3 normal) { return mix(kGround, kSky, 0.5 + 0.5 * normal.y); }
