#version 460
// A quad for each tile with fluid.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(std430, set = 0, binding = 1) readonly buffer Tiles { uint tiles[]; };

void main() {
  const uint columns = (view.width + kSurfaceTile - 1u) / kSurfaceTile;
  const uint tile = tiles[gl_InstanceIndex];
  const uint corner = gl_VertexIndex < 3 ? gl_VertexIndex : (gl_VertexIndex == 3 ? 2u : (gl_VertexIndex == 4 ? 1u : 3u));
  const uvec2 tileCorner = uvec2(tile % columns, tile / columns) + uvec2(corner & 1u, corner >> 1);
  const uvec2 pixel = min(tileCorner * kSurfaceTile, uvec2(view.width, view.height));
  gl_Position = vec4(vec2(pixel) / pictureSize() * 2.0 - 1.0, 0.0, 1.0);
}
