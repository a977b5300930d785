#version 460
// The picture: shaded pixels, blended along outlines, under the tank's walls and edges, encoded as sRGB.
// An outline that crosses a pixel says how much of it the owner covers; the rest is the neighbour's beyond the outline.
#extension GL_GOOGLE_include_directive : require
#include "render/particle_view.glsl"
#include "render/particle_edges.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 2) readonly buffer Shaded { uint shaded[]; };
layout(std430, set = 0, binding = 3) readonly buffer Rims { uint rims[]; };
layout(std430, set = 0, binding = 4) readonly buffer Edges { EdgeRecord edges[]; };
layout(std430, set = 0, binding = 5) readonly buffer TileEdges { uint tile_edges[]; };
layout(std430, set = 0, binding = 6) writeonly buffer Picture { uint picture[]; };

const vec3 kLine = vec3(0.045, 0.055, 0.07);
const vec3 kWall = vec3(0.30, 0.42, 0.52);

uint indexAt(ivec2 pixel) {
  const ivec2 at = clamp(pixel, ivec2(0), ivec2(view.width, view.height) - 1);
  return uint(at.y) * view.width + uint(at.x);
}

// The closed wall through which the ray leaves the domain tints what is behind it.
vec3 overWalls(vec3 colour, vec2 tangent, float own) {
  const vec3 eye = eyePoint(), ray = rayOf(tangent);
  const vec3 step = vec3(ray.x < 0.0 ? -1.0 : 1.0, ray.y < 0.0 ? -1.0 : 1.0, ray.z < 0.0 ? -1.0 : 1.0) * max(abs(ray), vec3(1e-12));
  const vec3 a = (scene.domain_min.xyz - eye) / step, b = (scene.domain_max.xyz - eye) / step;
  const vec3 enter = min(a, b), leave = max(a, b);
  const float in_at = max(max(enter.x, enter.y), max(enter.z, 0.0)), out_at = min(leave.x, min(leave.y, leave.z));
  const uint side = out_at == leave.x ? (ray.x < 0.0 ? 0u : 1u) : (out_at == leave.y ? (ray.y < 0.0 ? 2u : 3u) : (ray.z < 0.0 ? 4u : 5u));
  const bool tinted = scene.domain_min.w > 0.0 && out_at > in_at && side != 2u && (scene.counts.w & (1u << side)) != 0u && own > out_at * 1.0001;
  const float height = clamp((eye.y + out_at * ray.y - scene.domain_min.y) / (scene.domain_max.y - scene.domain_min.y), 0.0, 1.0);
  return tinted ? mix(colour, kWall, mix(0.26, 0.10, height)) : colour;
}

vec3 overEdges(vec3 colour, uint crossing, vec2 pixel, float own) {
  const float half_width = edgeHalfWidth();
  float cover = 0.0;
  for (; crossing != 0u; crossing &= crossing - 1u) {
    const EdgeRecord edge = edges[findLSB(crossing)];
    const float distance = abs(dot(edge.line.xy, pixel) + edge.line.z);
    const float along = dot(edge.along.xy, pixel);
    const float ends = min(along - edge.along.z, edge.along.w - along) + 0.5;
    const float at = 0.9995 / max(edge.depth.x + edge.depth.y * (along - edge.along.z), 1e-30);
    if (own > at) cover = max(cover, clamp(half_width + 0.5 - distance, 0.0, 1.0) * clamp(ends, 0.0, 1.0));
  }
  return mix(colour, kLine, 0.62 * cover);
}

vec3 encoded(vec3 linear) {
  const vec3 c = clamp(linear, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, vec3(greaterThan(c, vec3(0.0031308))));
}

void main() {
  const uint tile = groupIndex();
  if (tile >= shadeTiles()) return;
  const ivec2 pixel = ivec2(shadeTileOrigin(tile) + gl_LocalInvocationID.xy);
  if (pixel.x >= int(view.width) || pixel.y >= int(view.height)) return;
  const uint index = indexAt(pixel);
  const uint bits = depth[index];

  vec3 colour = unpackColour(shaded[index]);
  const uint rim = rims[index];
  const uint beyond = indexAt(pixel + rimStep(rim));
  // A neighbour that is nearer, or as near, is no background: two spheres that touch keep their seam.
  if (rimDistance(rim) < 0.5) colour = mix(unpackColour(shaded[beyond]), colour, 0.5 + rimDistance(rim));
  for (uint side = 0u; side < 4u; ++side) {
    const ivec2 step = rimStep(side);
    const uint other = indexAt(pixel - step);  // whose outline may reach over to here
    const uint reaching = rims[other];
    const float reach = rimDistance(reaching) - 0.5;
    if ((reaching & 3u) == side && reach > 0.0 && reach < 0.5 && depth[other] < bits) colour = mix(colour, unpackColour(shaded[other]), reach);
  }
  const float own = uintBitsToFloat(bits);
  const vec2 middle = vec2(pixel) + 0.5;
  colour = overWalls(colour, tangentOf(middle), own);
  colour = overEdges(colour, tile_edges[tile], middle, own);
  const uvec3 bytes = uvec3(encoded(colour) * 255.0 + 0.5);
  picture[index] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
