// target(x, y) = sum of the four texels of source that it covers
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 64) in;
layout(binding = 0) uniform texture2D source;
layout(binding = 1, r32f) uniform writeonly image2D target;
void main() {
  const ivec2 size = imageSize(target);
  const int i = int(gl_GlobalInvocationID.x);
  const ivec2 at = ivec2(i % size.x, i / size.x);
  if (at.y >= size.y) return;
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += texelFetch(source, 2 * at + ivec2(k & 1, k >> 1), 0).x;
  imageStore(target, at, vec4(sum));
}
