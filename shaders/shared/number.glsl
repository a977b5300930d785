// Whole numbers below 2^31 - 2^24 that travel among floats. They are the bits of normal floats: a device may
// flush denormals, and need not keep the bits of NaN.
#ifndef RILL_NUMBER_GLSL
#define RILL_NUMBER_GLSL
float numberToFloat(uint number) { return uintBitsToFloat(number + 0x00800000u); }
uint numberFromFloat(float bits) { return floatBitsToUint(bits) - 0x00800000u; }
#endif
