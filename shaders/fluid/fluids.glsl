// Several fluids of one spacing, whose particles have different masses. A particle keeps the index of its fluid in w of its position. For
// passes over neighbors the last bits of its prediction's w, and of its place in `work`, repeat it.
// FLUIDS: the scene has several; else it is compiled for one. Needs `params`.
#ifndef RILL_FLUIDS_GLSL
#define RILL_FLUIDS_GLSL
const uint kFluidBits = 7u;
const float kMinTagged = 1.0e-30;  // the bits of 0 would make a denormal number

uint fluidOfPosition(vec4 position) { return FLUIDS ? uint(position.w) : 0u; }

// w of a position.
float storedFluid(uint fluid) { return FLUIDS ? float(fluid) : 0.0; }

// w of a prediction: a number with the index of a fluid in its last bits. Also start_state.cpp.
float withFluid(float number, uint fluid) {
  if (!FLUIDS) return number;
  float normal = abs(number) < kMinTagged ? kMinTagged : number;
  return uintBitsToFloat((floatBitsToUint(normal) & ~kFluidBits) | fluid);
}
uint fluidOfPrediction(float w) { return FLUIDS ? floatBitsToUint(w) & kFluidBits : 0u; }
float numberOfPrediction(float w) { return FLUIDS && abs(w) < 2.0 * kMinTagged ? 0.0 : w; }

// The first words of `work`: a place with a bit of the index in the last bit of each coordinate. A bit that is wrong is changed
// by a step up or down, whichever the bit before it says: always the same way would let particles drift.
uvec3 placeWithFluid(vec3 place, uint fluid) {
  uvec3 bits = floatBitsToUint(place);
  if (!FLUIDS) return bits;
  uvec3 wrong = (bits ^ uvec3(fluid, fluid >> 1, fluid >> 2)) & 1u, up = bits >> 1 & 1u;
  up |= uvec3(equal(bits & 0x7fffffffu, uvec3(0u)));
  return bits + wrong * (2u * up - 1u);
}
uint fluidOfWork(uvec4 particle) { return FLUIDS ? (particle.x & 1u) | (particle.y & 1u) << 1 | (particle.z & 1u) << 2 : 0u; }

// Of a particle of this fluid, over that of one of the densest.
float inverseMassOf(uint fluid) {
  if (!FLUIDS) return 1.0;
  vec4 first = vec4(params.inverseMass0, params.inverseMass1, params.inverseMass2, params.inverseMass3);
  vec4 others = vec4(params.inverseMass4, params.inverseMass5, params.inverseMass6, params.inverseMass7);
  return fluid < 4u ? first[fluid] : others[fluid & 3u];
}

// Viscosity over that of the most viscous fluid.
float viscosityOf(uint fluid) {
  if (!FLUIDS) return 1.0;
  vec4 first = vec4(params.viscosity0, params.viscosity1, params.viscosity2, params.viscosity3);
  vec4 others = vec4(params.viscosity4, params.viscosity5, params.viscosity6, params.viscosity7);
  return fluid < 4u ? first[fluid] : others[fluid & 3u];
}

// Concentrations in a particle of one fluid that has not mixed, of those that diffuse.
vec4 unmixed(uint fluid) {
  return vec4(equal(uvec4(fluid), uvec4(params.diffusing0, params.diffusing1, params.diffusing2, params.diffusing3)));
}

// Surface tension over the largest.
float tensionOf(uint fluid) {
  if (!FLUIDS) return 1.0;
  vec4 first = vec4(params.tension0, params.tension1, params.tension2, params.tension3);
  vec4 others = vec4(params.tension4, params.tension5, params.tension6, params.tension7);
  return fluid < 4u ? first[fluid] : others[fluid & 3u];
}

// How much particles of each fluid cover samples of one: see engine/sph/interface_tension.hpp.
uvec4 coverRow(uint fluid) {
  uvec4 row = uvec4(params.cover0A, params.cover0B, params.cover0C, params.cover0D);
  if (fluid == 1u) row = uvec4(params.cover1A, params.cover1B, params.cover1C, params.cover1D);
  if (fluid == 2u) row = uvec4(params.cover2A, params.cover2B, params.cover2C, params.cover2D);
  if (fluid == 3u) row = uvec4(params.cover3A, params.cover3B, params.cover3C, params.cover3D);
  if (fluid == 4u) row = uvec4(params.cover4A, params.cover4B, params.cover4C, params.cover4D);
  if (fluid == 5u) row = uvec4(params.cover5A, params.cover5B, params.cover5C, params.cover5D);
  if (fluid == 6u) row = uvec4(params.cover6A, params.cover6B, params.cover6C, params.cover6D);
  if (fluid == 7u) row = uvec4(params.cover7A, params.cover7B, params.cover7C, params.cover7D);
  return row;
}
float coverBy(uvec4 row, uint fluid) {
  vec2 pair = unpackUnorm2x16(row[(fluid >> 1) & 3u]);
  return (fluid & 1u) == 0u ? pair.x : pair.y;
}

// xyz of a fluid whose viscosity shear may change: yield stress, consistency and flow index less 1; see FluidParams.
vec3 rheologyOf(uint fluid) {
  vec3 all[8] = vec3[](
    vec3(params.yield0, params.consistency0, params.thinning0), vec3(params.yield1, params.consistency1, params.thinning1),
    vec3(params.yield2, params.consistency2, params.thinning2), vec3(params.yield3, params.consistency3, params.thinning3),
    vec3(params.yield4, params.consistency4, params.thinning4), vec3(params.yield5, params.consistency5, params.thinning5),
    vec3(params.yield6, params.consistency6, params.thinning6), vec3(params.yield7, params.consistency7, params.thinning7));
  return FLUIDS ? all[fluid] : all[0];
}

// Of a pair of particles: the harmonic mean, by which the shear stress is continuous.
float harmonicMean(float one, float other) { return 2.0 * one * other / max(one + other, 1.0e-20); }
float pairViscosity(uint a, uint b) {
  if (!FLUIDS) return 1.0;
  return harmonicMean(viscosityOf(a), viscosityOf(b));
}
#endif
