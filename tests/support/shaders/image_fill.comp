// target(x, y) = base + x + 1000 y
#version 460
layout(local_size_x = 64) in;
layout(binding = 0, r32f) uniform writeonly image2D target;
layout(push_constant) uniform Push { float base; };
void main() {
  const int i = int(gl_GlobalInvocationID.x), width = imageSize(target).x;
  const ivec2 at = ivec2(i % width, i / width);
  if (at.y < imageSize(target).y) imageStore(target, at, vec4(base + float(at.x) + 1000.0 * float(at.y)));
}
