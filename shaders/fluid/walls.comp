#version 460
// The density that walls and solids displace near a particle, and its gradient, from the tables of
// engine/sph/wall.hpp, and the tangential scale from their coverage (wall_coverage.glsl). CORNER 0
// handles particles near one wall alone, CORNER 1 those near several walls or a solid. MERGED: one
// dispatch, in which the first workgroups take the latter; on CPU drivers every workgroup would execute
// the code of both.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"
#include "fluid/wall_coverage.glsl"
layout(local_size_x = kFluidGroup) in;
// walls of an axis that can be near at once: one takes an eighth of the corner look-ups
const int SIDES = THIN ? 2 : 1;

READ_FLOAT4(2, place)
READ_UINT(3, nearPlane)
READ_UINT(4, nearCorner)
layout(std430, binding = 5) readonly buffer SumsBlock { FluidSums sums; };
READ_FLOAT4(6, table)  // value and slope of a node, and of the next one along the first axis
layout(std430, binding = 7) readonly buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 8) writeonly buffer DisplacedBlock { vec4 nearDisplaced[]; };
layout(std430, binding = 9) writeonly buffer TangentialBlock { vec4 nearTangential[]; };

// Node and weight of a distance; beyond the table both nodes are its last, which is 0.
void locate(float s, float step, uint nodes, out uint node, out float weight) {
  float place = clamp(s, 0.0, params.support * 2.0) / step;
  node = min(uint(place), nodes - 2u);
  weight = clamp(place - float(node), 0.0, 1.0);
}

// Between node k and the next one.
vec2 between(uint k, float weight) {
  vec4 nodes = tableAt(k);
  return mix(nodes.xy, nodes.zw, weight);
}

vec2 line(uint offset, uint nodes, float step, float s) {
  uint node;
  float w;
  locate(s, step, nodes, node, w);
  return between(offset + node, w);
}

// Value and slope by s1.
vec2 edge(float s1, float s2) {
  uint a, b;
  float u, v;
  locate(s1, params.tableStep, params.tableNodes, a, u);
  locate(s2, params.tableStep, params.tableNodes, b, v);
  uint at = params.tableOffset2 + b * params.tableNodes + a;
  return mix(between(at, u), between(at + params.tableNodes, u), v);
}

vec2 corner(float s1, float s2, float s3) {
  uint a, b, c, n = params.cornerNodes;
  float u, v, w;
  locate(s1, params.cornerStep, n, a, u);
  locate(s2, params.cornerStep, n, b, v);
  locate(s3, params.cornerStep, n, c, w);
  uint at = params.tableOffset3 + (c * n + b) * n + a;
  vec2 low = mix(between(at, u), between(at + n, u), v);
  at += n * n;
  return mix(low, mix(between(at, u), between(at + n, u), v), w);
}

// Domain walls by inclusion and exclusion over the axes.
vec4 domainWalls(vec3 x, out vec3 coverage) {
  vec3 low = x - vec3(params.lowX, params.lowY, params.lowZ), high = vec3(params.highX, params.highY, params.highZ) - x;
  float s[3][2], d[3][2];  // distance to a wall, and the sign of its normal
  for (int a = 0; a < 3; ++a) {
    s[a][0] = SIDES == 2 ? low[a] : min(low[a], high[a]);
    d[a][0] = SIDES == 2 || low[a] <= high[a] ? 1.0 : -1.0;
    s[a][1] = high[a];
    d[a][1] = -1.0;
  }
  float value = 0.0;
  vec3 gradient = vec3(0.0);
  coverage = vec3(0.0);
  float reach = params.tableStep * float(params.tableNodes - 1u);
  for (int a = 0; a < 3; ++a) {
    int b = (a + 1) % 3, c = (a + 2) % 3;
    for (int i = 0; i < SIDES; ++i) {
      if (s[a][i] >= reach) continue;
      float di = d[a][i];
      vec2 one = line(0u, params.tableNodes, params.tableStep, s[a][i]);
      value += one.x;
      coverage[b] += one.x;
      coverage[c] += one.x;
      gradient[a] += di * one.y;
      for (int j = 0; j < SIDES; ++j) {
        if (s[b][j] >= reach) continue;
        float dj = d[b][j];
        vec2 two = edge(s[a][i], s[b][j]);
        value -= two.x;
        coverage[c] -= two.x;
        gradient[a] -= di * two.y;
        gradient[b] -= dj * edge(s[b][j], s[a][i]).y;
        if (a != 0) continue;
        for (int k = 0; k < SIDES; ++k) {
          if (s[2][k] >= reach) continue;
          float dk = d[2][k];
          vec2 three = corner(s[0][i], s[1][j], s[2][k]);
          value += three.x;
          gradient.x += di * three.y;
          gradient.y += dj * corner(s[1][j], s[2][k], s[0][i]).y;
          gradient.z += dk * corner(s[2][k], s[0][i], s[1][j]).y;
        }
      }
    }
  }
  return vec4(gradient, value);
}

// F of engine/sph/wall.hpp: the share that a half-space at signed distance s displaces, and its slope.
vec2 face(float s) {
  vec2 f = line(params.tableOffsetFace, params.tableNodes, params.tableStep, abs(s));
  return s < 0.0 ? vec2(1.0 - f.x, f.y) : f;
}

// A box displaces the product of its slabs, a ball what its own table says.
vec4 solidSample(SolidRecord s, vec3 x) {
  vec3 local = localPoint(s.pose, x);
  if (s.shape.kind == kShapeSphere) {
    vec3 normal;
    float distance = surfaceDistance(s.shape, local, normal);
    vec2 f = line(s.tableOffset, s.tableNodes, params.tableStep, distance - s.tableFirst);
    return vec4(toScene(s.pose, normal * f.y), f.x);
  }
  vec3 half_ = halfExtents(s.shape), slab, slope;
  for (int a = 0; a < 3; ++a) {
    vec2 near = face(local[a] - half_[a]), far = face(local[a] + half_[a]);
    slab[a] = near.x - far.x;
    slope[a] = near.y - far.y;
  }
  vec3 gradient = vec3(slope.x * slab.y * slab.z, slab.x * slope.y * slab.z, slab.x * slab.y * slope.z);
  return vec4(toScene(s.pose, gradient), slab.x * slab.y * slab.z);
}

void store(uint i, vec4 displaced, WallCoverage coverage) {
  nearDisplaced[i] = displaced;
  nearTangential[i] = packWallScale(coverage);
}

void nearOneWall(uint i) {
  vec3 x = placeAt(i).xyz;
  vec3 low = x - vec3(params.lowX, params.lowY, params.lowZ);
  vec3 high = vec3(params.highX, params.highY, params.highZ) - x;
  vec3 nearest = min(low, high);
  float s = min(nearest.x, min(nearest.y, nearest.z));
  vec3 axis = s == nearest.x ? vec3(1, 0, 0) : (s == nearest.y ? vec3(0, 1, 0) : vec3(0, 0, 1));
  vec2 f = line(0u, params.tableNodes, params.tableStep, s);
  float sign = dot(axis, low) <= dot(axis, high) ? 1.0 : -1.0;
  store(i, vec4(sign * f.y * axis, f.x), WallCoverage(f.x * (1.0 - axis), vec3(0.0)));
}

void nearSeveral(uint i) {
  vec3 x = placeAt(i).xyz;
  WallCoverage coverage = WallCoverage(vec3(0.0), vec3(0.0));
  vec4 displaced = domainWalls(x, coverage.diagonal);
  if (SOLIDS) {
    for (uint k = 0u; k < params.solidCount; ++k) {
      vec4 solid = solidSample(solids[k], x);
      displaced += solid;
      cover(coverage, solid.w, solid.xyz);
    }
  }
  store(i, displaced, coverage);
}

void main() {
  uint n = flatInvocation();
#ifdef MERGED
  uint several = sums.cornerCount, wholeGroups = divideUp(several, kFluidGroup) * kFluidGroup;
  if (n < several) nearSeveral(nearCornerAt(n));
  else if (n >= wholeGroups && n - wholeGroups < sums.planeCount) nearOneWall(nearPlaneAt(n - wholeGroups));
#else
  if (CORNER && n < sums.cornerCount) nearSeveral(nearCornerAt(n));
  if (!CORNER && n < sums.planeCount) nearOneWall(nearPlaneAt(n));
#endif
}
