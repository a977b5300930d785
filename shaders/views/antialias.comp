#version 460
// Antialiasing of the listed pixels of a finished picture, for edges of fluid in front of fluid, of solids and of refracted objects.
// An edge is followed to both of its ends; the pixel takes the share of its neighbor that the edge between them covers.
#extension GL_GOOGLE_include_directive : require
#include "views/antialias.glsl"

layout(local_size_x = kAntialiasGroup) in;
layout(std430, set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 2) readonly buffer Edges { uint edges[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Picture { uint picture[]; };

const int kMaxReach = 8;  // pixels that an edge is followed to each side

// Length of the edge to a side (-1, 1): to where the mean of both rows differs from the edge's. `off`: by how much.
int endOf(ivec2 p, ivec2 along, ivec2 across, int side, float edge, float least, out float off) {
  off = 0.0;
  int end = 1;
  bool open = true;
  [[dont_unroll]] while (open && end < kMaxReach) {
    const ivec2 q = p + side * end * along;
    off = 0.5 * (lumaAt(q) + lumaAt(q + across)) - edge;
    open = abs(off) < least;
    end += int(open);
  }
  return end;
}

void main() {
  const uint k = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kAntialiasGroup + gl_LocalInvocationIndex;
  if (k >= counts[kEdgePixels]) return;
  const uint index = edges[k], own = aliasedAt(index);
  const ivec2 p = ivec2(index % push.width, index / push.width);
  const float c = lumaOf(own);
  const float n = lumaAt(p + ivec2(0, -1)), s = lumaAt(p + ivec2(0, 1)), w = lumaAt(p + ivec2(-1, 0)), e = lumaAt(p + ivec2(1, 0));
  const float nw = lumaAt(p + ivec2(-1, -1)), ne = lumaAt(p + ivec2(1, -1)), sw = lumaAt(p + ivec2(-1, 1)), se = lumaAt(p + ivec2(1, 1));
  const float up = 2.0 * abs(n + s - 2.0 * c) + abs(ne + se - 2.0 * e) + abs(nw + sw - 2.0 * w);
  const float sideways = 2.0 * abs(w + e - 2.0 * c) + abs(nw + ne - 2.0 * n) + abs(sw + se - 2.0 * s);
  const bool level = up >= sideways;  // the edge runs along the row
  const float first = level ? n : w, second = level ? s : e;
  const bool to_first = abs(first - c) >= abs(second - c);
  const ivec2 along = ivec2(int(level), int(!level)), across = ivec2(int(!level), int(level)) * (to_first ? -1 : 1);
  const float other = to_first ? first : second, edge = 0.5 * (c + other), least = 0.25 * abs(other - c);
  float off_before, off_after;
  const int before = endOf(p, along, across, -1, edge, least, off_before), after = endOf(p, along, across, 1, edge, least, off_after);
  const int nearer = min(before, after);
  const float off = before <= after ? off_before : off_after;
  // The edge covers the pixel only if it bends into this row at its nearer end.
  const bool cut = nearer < kMaxReach && (off < 0.0) != (c < edge);
  const float share = cut ? max(0.5 - (float(nearer) - 0.5) / float(before + after - 1), 0.0) : 0.0;
  // Light is about the square of the stored value.
  const vec3 mine = colorOf(own), its = colorOf(pixelAt(p + across));
  const uvec3 bytes = uvec3(sqrt(mix(mine * mine, its * its, share)) * 255.0 + 0.5);
  if (share > 0.0) picture[index] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
