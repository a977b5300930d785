// Shares of several fluids in a particle, from its own fluid and the concentrations of those that diffuse. What is left is its own fluid,
// or of one that diffuses the first fluid that does not. Without that, shares are over their sum.
#ifndef RILL_MIXTURE_GLSL
#define RILL_MIXTURE_GLSL
const uint kNoShare = 0xffffffffu;
layout(constant_id = 1) const uint DIFFUSING_0 = kNoShare;  // indices of the fluids that diffuse
layout(constant_id = 2) const uint DIFFUSING_1 = kNoShare;
layout(constant_id = 3) const uint DIFFUSING_2 = kNoShare;
layout(constant_id = 4) const uint DIFFUSING_3 = kNoShare;
layout(constant_id = 5) const uint CARRIER = kNoShare;      // the first that does not

vec4 componentOf(uint fluid) { return vec4(equal(uvec4(fluid), uvec4(DIFFUSING_0, DIFFUSING_1, DIFFUSING_2, DIFFUSING_3))); }

float shareOf(uint fluid, uint own, vec4 concentration) {
  const vec4 used = vec4(notEqual(uvec4(DIFFUSING_0, DIFFUSING_1, DIFFUSING_2, DIFFUSING_3), uvec4(kNoShare)));
  const vec4 shares = clamp(mix(vec4(0.0), concentration, notEqual(used, vec4(0.0))), 0.0, 1.0);
  const uint rest = componentOf(own) == vec4(0.0) ? own : CARRIER;
  const float sum = dot(shares, vec4(1.0)), left = rest == kNoShare ? 0.0 : max(1.0 - sum, 0.0);
  if (sum + left <= 0.0) return fluid == own ? 1.0 : 0.0;
  return (dot(shares, componentOf(fluid)) + (fluid == rest ? left : 0.0)) / (sum + left);
}
#endif
