// A mean of normals, which is no longer than 1, in 32 bits: its direction's steps are 0.06 degrees.
uint packMean(vec3 n) {
  const ivec3 q = ivec3(round(n * vec3(1023.0, 1023.0, 511.0)));
  return uint(q.x & 0x7FF) | uint(q.y & 0x7FF) << 11 | uint(q.z & 0x3FF) << 22;
}
vec3 unpackMean(uint packed) {
  const ivec3 q = ivec3(bitfieldExtract(int(packed), 0, 11), bitfieldExtract(int(packed), 11, 11), bitfieldExtract(int(packed), 22, 10));
  return vec3(q) / vec3(1023.0, 1023.0, 511.0);
}
