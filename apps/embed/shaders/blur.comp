// One direction of a blur: target(p) = (source(p - step) + 2 source(p) + source(p + step)) / 4, clamped at the edges.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2D source;
layout(binding = 1, rgba8) uniform writeonly image2D target;
layout(push_constant) uniform Push { ivec2 direction; };
vec4 texel(ivec2 at) { return texelFetch(source, clamp(at, ivec2(0), textureSize(source, 0) - 1), 0); }
void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(target)))) return;
  imageStore(target, at, (texel(at - direction) + 2.0 * texel(at) + texel(at + direction)) / 4.0);
}
