#version 460
// Smooths the stairs that are left in a finished picture: edges of fluid before fluid, of solids, of what is seen bent. Where light changes sharply across a row of pixels,
// the row is followed to both of its ends, and the pixel takes as much of its neighbour across as an edge between those ends would cover (Lottes 2009, FXAA).
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "views/antialias_record.h"

layout(local_size_x = kAntialiasGroup, local_size_y = kAntialiasGroup) in;
layout(push_constant) uniform Push { AntialiasPush push; };
READ_UINT(0, before)  // RGBA8, sRGB
layout(std430, set = 0, binding = 1) writeonly buffer After { uint after[]; };

const float kLeast = 0.06, kShare = 0.15;  // of contrast, absolute and of the brightest: less is no edge
const int kFarthest = 8;                   // pixels that an edge is followed to a side
const float kSpeck = 0.6;                  // of what differs from all around it

uint pixelAt(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(push.width, push.height) - 1);
  return beforeAt(uint(p.y) * push.width + uint(p.x));
}
vec3 colourOf(uint pixel) { return vec3(pixel & 0xFFu, (pixel >> 8) & 0xFFu, (pixel >> 16) & 0xFFu) / 255.0; }
float lumaAt(ivec2 p) { return dot(colourOf(pixelAt(p)), vec3(0.299, 0.587, 0.114)); }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= int(push.width) || p.y >= int(push.height)) return;
  const uint index = uint(p.y) * push.width + uint(p.x), own = pixelAt(p);
  const float c = dot(colourOf(own), vec3(0.299, 0.587, 0.114));
  const float n = lumaAt(p + ivec2(0, -1)), s = lumaAt(p + ivec2(0, 1)), w = lumaAt(p + ivec2(-1, 0)), e = lumaAt(p + ivec2(1, 0));
  const float highest = max(c, max(max(n, s), max(w, e))), range = highest - min(c, min(min(n, s), min(w, e)));
  if (range < max(kLeast, kShare * highest)) {
    after[index] = own;
    return;
  }
  const float nw = lumaAt(p + ivec2(-1, -1)), ne = lumaAt(p + ivec2(1, -1)), sw = lumaAt(p + ivec2(-1, 1)), se = lumaAt(p + ivec2(1, 1));
  const float up = 2.0 * abs(n + s - 2.0 * c) + abs(ne + se - 2.0 * e) + abs(nw + sw - 2.0 * w);
  const float sideways = 2.0 * abs(w + e - 2.0 * c) + abs(nw + ne - 2.0 * n) + abs(sw + se - 2.0 * s);
  const bool level = up >= sideways;  // the edge runs along the row
  const float before_it = level ? n : w, behind_it = level ? s : e;
  const bool towards_first = abs(before_it - c) >= abs(behind_it - c);
  const ivec2 along = ivec2(int(level), int(!level)), across = ivec2(int(!level), int(level)) * (towards_first ? -1 : 1);
  const float other = towards_first ? before_it : behind_it;
  const float edge = 0.5 * (c + other), least = 0.25 * abs(other - c);
  // To both ends: where the mean of the two rows is no longer that of the edge.
  ivec2 ends = ivec2(kFarthest);
  vec2 beyond = vec2(0.0);
  for (int side = 0; side < 2; ++side) {
    bool open = true;
    for (int k = 1; k < kFarthest && open; ++k) {
      const ivec2 q = p + (side == 0 ? -k : k) * along;
      const float off = 0.5 * (lumaAt(q) + lumaAt(q + across)) - edge;
      if (abs(off) >= least) {
        ends[side] = k;
        beyond[side] = off;
        open = false;
      }
    }
  }
  const int nearer = ends.x <= ends.y ? 0 : 1;
  const bool cut = ends[nearer] < kFarthest && (beyond[nearer] < 0.0) != (c < edge);  // at that end the edge turns into this row
  const float part = cut ? 0.5 - (float(ends[nearer]) - 0.5) / float(ends.x + ends.y - 1) : 0.0;
  // A pixel unlike all around it.
  const float mean = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
  const float unlike = smoothstep(0.0, 1.0, clamp(abs(mean - c) / range, 0.0, 1.0));
  const float share = max(part, unlike * unlike * kSpeck);
  const uvec3 bytes = uvec3(mix(colourOf(own), colourOf(pixelAt(p + across)), share) * 255.0 + 0.5);
  after[index] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
