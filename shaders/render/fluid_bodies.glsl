// What several fluids along a ray absorb and scatter together. Needs `look`.
layout(constant_id = 0) const uint FLUIDS = 1u;  // 1: all fluid is that of the look

// Of a ray through a mixture; with one fluid, of the look.
struct Interior {
  vec3 absorption;   // 1/m, mean over the ray
  vec3 scatter;      // as LookRecord has them, mean over what the ray loses
  vec3 emission;
  float scattering;  // share of the ray in fluid that scatters as the look
};

Interior lookInterior() { return Interior(look.absorption.rgb, look.scatter.rgb, look.emission.rgb, 1.0); }

vec3 absorptionOf(uint fluid) { return FLUIDS == 1u ? look.absorption.rgb : look.fluid_absorption[fluid].rgb; }
vec3 scatterOf(uint fluid) { return FLUIDS == 1u ? look.scatter.rgb : look.fluid_scatter[fluid].rgb; }
// Of one of several fluids.
Interior interiorOf(uint fluid) {
  const vec4 rates = look.fluid_absorption[fluid];
  return Interior(rates.rgb, look.fluid_scatter[fluid].rgb, rates.w * look.emission.rgb, rates.w);
}
Interior noInterior() { return Interior(vec3(0.0), vec3(0.0), vec3(0.0), 0.0); }

// Adds a length of one fluid to sums over all: depths in place of rates and means.
void addFluid(inout Interior sums, uint fluid, float meters) {
  const vec4 rates = look.fluid_absorption[fluid];
  const vec3 depth = rates.rgb * meters;
  sums.absorption += depth;
  sums.scatter += depth * look.fluid_scatter[fluid].rgb;
  sums.emission += depth * rates.w * look.emission.rgb;
  sums.scattering += meters * rates.w;
}

Interior meanOf(Interior sums, float meters) {
  const float length_inverse = 1.0 / max(meters, 1e-20);
  const vec3 depth_inverse = 1.0 / max(sums.absorption, vec3(1e-20));
  return Interior(sums.absorption * length_inverse, sums.scatter * depth_inverse, sums.emission * depth_inverse,
                  sums.scattering * length_inverse);
}
