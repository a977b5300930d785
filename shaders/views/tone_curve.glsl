// AgX with the look "Punchy" (Sobotka 2022): a sigmoid of the logarithm of light, in primaries that are nearer to white than those of
// sRGB, so that bright colors fade to white and keep their hue. Grays stay gray: what mixes channels adds the same to all of them.

const float kInset = 0.2;  // of the way from a primary to white
const vec3 kInsetWeights = vec3(0.2119946, 0.3921508, 0.3958546);  // of sRGB's primaries, each as far from white as the others
const float kMiddleGray = 0.18 / 1.4142136;  // half a stop brighter, so that 0.18 is shown as sRGB shows it
const float kStopsBelow = 10.0, kStopsAbove = 6.5;  // of middle gray: black and white
const float kSaturation = 1.4;
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);

// Negative values and NaNs become 0 (by bits, because a compiler may assume that there are no NaNs), infinity the largest half.
vec3 bounded(vec3 c) {
  return min(mix(vec3(0.0), c, lessThanEqual(floatBitsToUint(c), uvec3(0x7F800000u))), 65504.0);
}

// The sigmoid through (0, 0), (20/33, 1/2) and (1, 1) with slope 2, toe 3 and shoulder 3.25, to the power of 1.35; within 0.7/255.
vec3 sigmoid(vec3 x) {
  const vec3 q = (((-21.638744 * x + 41.3660118) * x - 20.3761352) * x + 2.40955033) * x - 1.16226046;
  return max(x + (x - x * x) * q, 0.0);
}

// Linear color to display values, 0 to 1.
vec3 toneCurve(vec3 color) {
  const vec3 inset = (1.0 - kInset) * color + kInset * dot(kInsetWeights, color);
  const vec3 stops = log2(max(inset, 1e-10) / kMiddleGray);
  const vec3 curve = sigmoid(clamp((stops + kStopsBelow) / (kStopsBelow + kStopsAbove), 0.0, 1.0));
  const vec3 vivid = kSaturation * curve - (kSaturation - 1.0) * dot(kLuminance, curve);
  return clamp((vivid - kInset * dot(kInsetWeights, vivid)) / (1.0 - kInset), 0.0, 1.0);
}
