// target(x, y) = source(x + 1, y) + own(x, y), the source repeated at its right edge
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 64) in;
layout(binding = 0) uniform texture2D source;
layout(binding = 1, r32f) uniform readonly image2D own;
layout(binding = 2, r32f) uniform writeonly image2D target;
void main() {
  const ivec2 size = imageSize(target);
  const int i = int(gl_GlobalInvocationID.x);
  const ivec2 at = ivec2(i % size.x, i / size.x);
  if (at.y >= size.y) return;
  const float neighbor = texelFetch(source, ivec2(min(at.x + 1, size.x - 1), at.y), 0).x;
  imageStore(target, at, vec4(neighbor + imageLoad(own, at).x));
}
