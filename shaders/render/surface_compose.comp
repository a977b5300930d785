#version 460
// The surface of the pixels of listed tiles: interpolated between four samples on one surface. Other pixels near fluid are listed for
// surface_edges.comp, because few need it and they would stall their workgroup.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kSurfaceTile, local_size_y = kSurfaceTile) in;
READ_UINT(0, depth)
READ_UINT2(1, samples)
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 3) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Surface { uvec2 surface[]; };  // packPixel()
layout(std430, set = 0, binding = 5) writeonly buffer Edges { uint edges[]; };
#include "render/surface_corners.glsl"
#include "render/surface_depth_range.glsl"

void main() {
  if (groupIndex() >= counters[kSurfaceTileCount]) return;
  const uint tile = tiles[groupIndex()];
  const uint columns = (view.width + kSurfaceTile - 1u) / kSurfaceTile;
  const uvec2 pixel = uvec2(tile % columns, tile / columns) * kSurfaceTile + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const uint index = pixel.y * view.width + pixel.x;
  const Corners c = cornersOf(vec2(pixel) + 0.5);
  if (c.coplanar) {
    const vec4 weight = vec4((1.0 - c.part.x) * (1.0 - c.part.y), c.part.x * (1.0 - c.part.y), (1.0 - c.part.x) * c.part.y,
                             c.part.x * c.part.y);
    // In perspective the inverse depth is linear across a plane.
    const vec4 each = vec4(c.depths[0], c.depths[1], c.depths[2], c.depths[3]);
    const float z = view.perspective > 0.0 ? 1.0 / dot(weight, 1.0 / each) : dot(weight, each);
    const vec3 normal = weight.x * c.normals[0] + weight.y * c.normals[1] + weight.z * c.normals[2] + weight.w * c.normals[3];
    surface[index] = packPixel(z, normalize(normal), 1.0);
    return;
  }
  float nearest = noDepth(), farthest = 0.0;
  depthRange(sampleOfPixel(pixel), nearest, farthest);
  if (nearest < noDepth())
    edges[atomicAdd(counters[kEdgeCount], 1u)] = index;
  else
    surface[index] = uvec2(kNoDepthBits, 0u);
}
