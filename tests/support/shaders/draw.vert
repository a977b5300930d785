// The rectangle push.rect, in clip space, at a given depth.
#version 460
layout(push_constant) uniform Push { vec4 rect; float depth; float value; };
void main() {
  const vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
  gl_Position = vec4(mix(rect.xy, rect.zw, corner), depth, 1.0);
}
