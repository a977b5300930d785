#version 460
// The picture: every pixel's owner shaded in linear light, the tank's walls and edges over it, encoded as sRGB.
// Where a pixel's neighbours have other owners, four rays are tested against all of them: anti-aliasing at edges alone.
#extension GL_GOOGLE_include_directive : require
#include "render/particle_view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 2) readonly buffer Tint { uvec2 tint[]; };
layout(std430, set = 0, binding = 3) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 4) readonly buffer Poses { PoseRecord poses[]; };
layout(std430, set = 0, binding = 5) readonly buffer Edges { EdgeRecord edges[]; };
layout(std430, set = 0, binding = 6) readonly buffer LightMap { uint light_map[]; };
layout(std430, set = 0, binding = 7) readonly buffer FloorLight { float floor_light[]; };
layout(std430, set = 0, binding = 8) writeonly buffer Picture { uint picture[]; };
#define LIGHT_MAP_READ
#include "render/particle_light.glsl"
#include "render/particle_solids.glsl"

const float kFar = 1e30;
const vec3 kKey = vec3(0.92, 0.88, 0.80);      // the key light, as reflected by white
const vec3 kSky = vec3(0.44, 0.50, 0.58);      // ambient light from above
const vec3 kGround = vec3(0.20, 0.19, 0.18);   // and from below
const vec3 kFloor = vec3(0.50, 0.50, 0.49);
const vec3 kSolid = vec3(0.62, 0.50, 0.36);
const vec3 kLine = vec3(0.045, 0.055, 0.07);
const vec3 kWall = vec3(0.30, 0.42, 0.52);

vec3 background(float y) { return mix(vec3(0.78, 0.80, 0.82), vec3(0.50, 0.52, 0.55), smoothstep(0.0, 1.0, y / float(view.height))); }

vec3 ambient(vec3 normal) { return mix(kGround, kSky, 0.5 + 0.5 * normal.y); }

vec3 shadeParticle(uint id, vec2 tangent) {
  const vec3 centre = viewPoint(particlePoint(position[id].xyz));
  const float radius = drawnRadius(centre.z);
  const vec3 ray = rayOf(tangent);
  const float t = max(sphereDepth(centre, radius, tangent), view.near_depth);
  const vec3 local = (vec3(tangent, 1.0) * t - centre) / radius;
  const vec3 normal = normalize(rightAxis() * local.x + upAxis() * local.y + forwardAxis() * local.z);
  const uvec2 packed = tint[id];
  const vec3 root = vec3(unpackUnorm2x16(packed.x), float(packed.y & 0xFFFFu) / 65535.0);
  const float open = float((packed.y >> 16) & 0xFFu) / 255.0, light = float(packed.y >> 24) / 255.0;
  const vec3 to_light = scene.light_to.xyz;
  const float facing = dot(normal, to_light);
  const float diffuse = max(0.85 * facing + 0.15, 0.0);
  const vec3 to_eye = -normalize(ray);
  const float glint = pow(max(dot(normal, normalize(to_eye + to_light)), 0.0), 40.0);
  const float shade = mix(0.35, 1.0, open);
  return root * root * (ambient(normal) * shade + kKey * (diffuse * mix(0.25, 1.0, light) * mix(0.7, 1.0, open))) + kKey * (0.10 * glint * light);
}

vec3 shadeSolid(uint number, vec2 tangent) {
  const vec3 ray = rayOf(tangent);
  vec3 normal;
  const float t = solidHit(poses[number], eyePoint(), ray, normal);
  const vec3 at = eyePoint() + t * ray;
  const float light = lightVisibility(at + normal * scene.light_texel.x, 1.5 * scene.light_texel.x);
  const float diffuse = max(dot(normal, scene.light_to.xyz), 0.0);
  const float lifted = scene.domain_min.w > 0.0 ? (at.y - scene.domain_min.y) / (scene.domain_max.y - scene.domain_min.y) : 1.0;
  return kSolid * (ambient(normal) * mix(0.6, 1.0, smoothstep(0.0, 0.12, lifted)) + kKey * (diffuse * light));
}

// How much of a pixel `width` wide the grid lines cover at `at`, lines being `line` wide and `step` apart.
float gridCover(float at, float width, float line, float step) {
  const float drawn = max(line, width);
  const float distance = abs(fract(at / step - 0.5) - 0.5) * step;
  const float cover = clamp((0.5 * drawn - distance) / width + 0.5, 0.0, 1.0) * (line / drawn);
  return mix(cover, line / step, clamp(2.0 * width / step - 0.5, 0.0, 1.0));
}

float floorLight(vec3 at) {
  if (view.count + scene.counts.x == 0u) return 1.0;  // nothing casts a shadow, and there is no map
  const vec2 texel = lightTexel(at);
  const ivec2 size = ivec2(scene.counts.yz);
  if (any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, vec2(size - 1)))) return 1.0;
  const uvec2 base = uvec2(texel);
  const vec2 part = texel - vec2(base);
  const uint row = base.y * scene.counts.y + base.x;
  return mix(mix(floor_light[row], floor_light[row + 1u], part.x),
             mix(floor_light[row + scene.counts.y], floor_light[row + scene.counts.y + 1u], part.x), part.y);
}

vec3 shadeFloor(vec2 tangent) {
  const vec3 ray = rayOf(tangent), eye = eyePoint();
  const float t = (scene.domain_min.y - eye.y) / ray.y;
  const vec2 at = eye.xz + t * ray.xz;
  // How far the hit moves from a pixel to the next.
  const vec2 right = (rightAxis().xz - ray.xz * (rightAxis().y / ray.y)) * (t / view.focal);
  const vec2 up = (upAxis().xz - ray.xz * (upAxis().y / ray.y)) * (t / view.focal);
  const vec2 width = abs(right) + abs(up);
  const float step = scene.domain_max.w, line = 0.02 * step;
  const vec2 inner = at - scene.domain_min.xz;
  const float grid = max(gridCover(inner.x, width.x, line, step), gridCover(inner.y, width.y, line, step));
  const vec2 extent = scene.domain_max.xz - scene.domain_min.xz;
  const vec2 rim = min(inner, extent - inner) / (0.06 * max(min(extent.x, extent.y), step));
  const float corner = (1.0 - 0.12 * exp(-max(rim.x, 0.0))) * (1.0 - 0.12 * exp(-max(rim.y, 0.0)));
  const float light = floorLight(vec3(at.x, scene.domain_min.y, at.y));
  const vec3 colour = kFloor * mix(1.0, 0.72, grid);
  return colour * corner * (kSky * mix(0.55, 1.0, light) + kKey * (max(scene.light_to.y, 0.0) * light));
}

vec3 shadeOwner(uint id, vec2 pixel) {
  const vec2 tangent = tangentOf(pixel);
  if (id == kNobody) return background(pixel.y);
  if (id == kFloorId) return shadeFloor(tangent);
  if (id >= kSolidBase) return shadeSolid(id - kSolidBase, tangent);
  return shadeParticle(id, tangent);
}

bool onFloor(vec3 ray, out float t) {
  const vec3 eye = eyePoint();
  t = ray.y < 0.0 ? (scene.domain_min.y - eye.y) / ray.y : kFar;
  const vec2 at = eye.xz + t * ray.xz;
  return t < kFar && all(greaterThanEqual(at, scene.domain_min.xz)) && all(lessThanEqual(at, scene.domain_max.xz));
}

// Depth at which the ray through `tangent` meets the owner, negative for a miss.
float ownerDepth(uint id, vec2 tangent) {
  if (id == kNobody) return kFar;
  float t = -1.0;
  if (id == kFloorId) {
    if (!onFloor(rayOf(tangent), t)) t = -1.0;
  } else if (id >= kSolidBase) {
    vec3 normal;
    t = solidHit(poses[id - kSolidBase], eyePoint(), rayOf(tangent), normal);
  } else {
    const vec3 centre = viewPoint(particlePoint(position[id].xyz));
    t = sphereDepth(centre, drawnRadius(centre.z), tangent);
  }
  return t >= view.near_depth ? t : -1.0;
}

const vec2 kSamples[4] = vec2[4](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));

uint ownerAt(ivec2 pixel) {
  const ivec2 at = clamp(pixel, ivec2(0), ivec2(view.width, view.height) - 1);
  return winner[uint(at.y) * view.width + uint(at.x)];
}

// The closed wall through which the ray leaves the domain tints what is behind it.
vec3 overWalls(vec3 colour, vec2 tangent, vec4 depths) {
  if (scene.domain_min.w == 0.0) return colour;
  const vec3 eye = eyePoint(), ray = rayOf(tangent);
  const vec3 step = vec3(ray.x < 0.0 ? -1.0 : 1.0, ray.y < 0.0 ? -1.0 : 1.0, ray.z < 0.0 ? -1.0 : 1.0) * max(abs(ray), vec3(1e-12));
  const vec3 a = (scene.domain_min.xyz - eye) / step, b = (scene.domain_max.xyz - eye) / step;
  const vec3 enter = min(a, b), leave = max(a, b);
  const float in_at = max(max(enter.x, enter.y), max(enter.z, 0.0)), out_at = min(leave.x, min(leave.y, leave.z));
  if (out_at <= in_at) return colour;
  const uint side = out_at == leave.x ? (ray.x < 0.0 ? 0u : 1u) : (out_at == leave.y ? (ray.y < 0.0 ? 2u : 3u) : (ray.z < 0.0 ? 4u : 5u));
  if (side == 2u || (scene.counts.w & (1u << side)) == 0u) return colour;
  const float behind = dot(vec4(greaterThan(depths, vec4(out_at * 1.0001))), vec4(0.25));
  const float height = clamp((eye.y + out_at * ray.y - scene.domain_min.y) / (scene.domain_max.y - scene.domain_min.y), 0.0, 1.0);
  return mix(colour, kWall, behind * mix(0.26, 0.10, height));
}

vec3 overEdges(vec3 colour, vec2 pixel, vec4 depths) {
  if (scene.domain_min.w == 0.0) return colour;
  const float half_width = max(0.55, float(view.height) / 1600.0);
  float cover = 0.0;
  for (uint k = 0u; k < kEdges; ++k) {
    const EdgeRecord edge = edges[k];
    const float distance = abs(dot(edge.line.xy, pixel) + edge.line.z);
    if (edge.line.w == 0.0 || distance >= half_width + 0.5) continue;
    const float along = dot(edge.along.xy, pixel);
    const float ends = min(along - edge.along.z, edge.along.w - along) + 0.5;
    if (ends <= 0.0) continue;
    const float depth = 0.9995 / max(edge.depth.x + edge.depth.y * (along - edge.along.z), 1e-30);
    const float seen = dot(vec4(greaterThan(depths, vec4(depth))), vec4(0.25));
    cover = max(cover, min(half_width + 0.5 - distance, 1.0) * min(ends, 1.0) * seen);
  }
  return mix(colour, kLine, 0.62 * cover);
}

vec3 encoded(vec3 linear) {
  const vec3 c = clamp(linear, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, vec3(greaterThan(c, vec3(0.0031308))));
}

void main() {
  const uint columns = (view.width + kShadeTile - 1u) / kShadeTile;
  const uint group = groupIndex();
  const uvec2 at = uvec2(group % columns, group / columns) * kShadeTile + gl_LocalInvocationID.xy;
  if (at.x >= view.width || at.y >= view.height) return;
  const vec2 pixel = vec2(at) + 0.5;
  const uint own = winner[at.y * view.width + at.x];

  uint neighbours[8];
  bool edge = false;
  for (int k = 0; k < 8; ++k) {
    const int cell = k < 4 ? k : k + 1;
    neighbours[k] = ownerAt(ivec2(at) + ivec2(cell % 3 - 1, cell / 3 - 1));
    edge = edge || neighbours[k] != own;
  }

  vec3 colour = vec3(0.0);
  vec4 depths = vec4(ownerDepth(own, tangentOf(pixel)));
  if (!edge) {
    colour = shadeOwner(own, pixel);
  } else {
    vec4 best = vec4(2.0 * kFar);
    uvec4 owner = uvec4(own);
    uint before = own;
    for (int k = -1; k < 8; ++k) {
      const uint id = k < 0 ? own : neighbours[k];
      if (k >= 0 && (id == before || id == own)) continue;
      before = id;
      for (int s = 0; s < 4; ++s) {
        const float t = ownerDepth(id, tangentOf(pixel + kSamples[s]));
        if (t > 0.0 && (t < best[s] || (t == best[s] && id < owner[s]))) {
          best[s] = t;
          owner[s] = id;
        }
      }
    }
    // Every owner once, where the middle of its rays hits: projections of spheres, boxes and the floor are convex.
    uint left = 0u;
    float weight = 0.0;
    for (int s = 0; s < 4; ++s) {
      if (best[s] < 2.0 * kFar) left |= 1u << s; else best[s] = depths.x;
    }
    for (int round = 0; round < 4 && left != 0u; ++round) {
      const uint id = owner[findLSB(left)];
      vec2 middle = vec2(0.0);
      float share = 0.0;
      for (int s = 0; s < 4; ++s) {
        if ((left & (1u << s)) != 0u && owner[s] == id) {
          middle += kSamples[s];
          share += 1.0;
          left &= ~(1u << s);
        }
      }
      colour += share * shadeOwner(id, pixel + middle / share);
      weight += share;
    }
    colour = weight > 0.0 ? colour / weight : shadeOwner(own, pixel);
    depths = best;
  }
  colour = overWalls(colour, tangentOf(pixel), depths);
  colour = overEdges(colour, pixel, depths);
  const uvec3 bytes = uvec3(encoded(colour) * 255.0 + 0.5);
  picture[at.y * view.width + at.x] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
