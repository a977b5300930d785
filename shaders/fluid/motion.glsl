// How much a particle moves, for the gains and for sleep: squared speeds over gravity times spacing, summed up in
// kMotionUnit. Needs `params`.
#ifndef RILL_MOTION_GLSL
#define RILL_MOTION_GLSL

float motionOf(float speed) { return min(speed * speed / params.layerHead, kMaxMotion); }

// m/s, of the fastest particle of a fluid at rest.
float restMaxSpeed() { return kRestMaxSpeed * sqrt(params.layerHead); }

// Adds to a sum of 64 bits in a buffer.
#define ADD_MOTION(LOW, HIGH, motion) { \
  float units = round((motion) / kMotionUnit), high = floor(units / 4294967296.0); \
  uint add = uint(units - high * 4294967296.0), old = atomicAdd(LOW, add), carry = uint(high) + uint(old + add < old); \
  if (carry > 0u) atomicAdd(HIGH, carry); \
}
#endif
