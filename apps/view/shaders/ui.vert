#version 460
// Vertices in Dear ImGui's format: position, font atlas coordinates, color; five words each.
layout(std430, set = 0, binding = 0) readonly buffer Vertices { uint vertices[]; };
layout(std430, set = 0, binding = 1) readonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push {
  vec2 clipMin, clipSize;  // of the clip rectangle, pixels
  uint firstIndex;
  uint fontWidth, fontHeight;
};
layout(location = 0) out vec2 texel;
layout(location = 1) out vec4 color;

void main() {
  const uint at = 5u * indices[firstIndex + gl_VertexIndex];
  const vec2 position = vec2(uintBitsToFloat(vertices[at]), uintBitsToFloat(vertices[at + 1u]));
  texel = vec2(uintBitsToFloat(vertices[at + 2u]), uintBitsToFloat(vertices[at + 3u])) * vec2(fontWidth, fontHeight);
  color = unpackUnorm4x8(vertices[at + 4u]);
  gl_Position = vec4((position - clipMin) / clipSize * 2.0 - 1.0, 0.0, 1.0);
}
