// The solids of a pass that only reads them, four words at a time: CPU drivers load the words of a struct one by one for each lane.
// Needs READ_UINT4(binding, solids) before it.
#ifndef RILL_SOLID_ARRAY_GLSL
#define RILL_SOLID_ARRAY_GLSL
#include "shared/solid_records.h"

// Without what moves it by keyframes.
SolidRecord solidAt(uint k) {
  uint q = kSolidQuads * k;
  vec4 a = uintBitsToFloat(solidsAt(q)), b = uintBitsToFloat(solidsAt(q + 1u)), c = uintBitsToFloat(solidsAt(q + 2u)),
       d = uintBitsToFloat(solidsAt(q + 3u)), f = uintBitsToFloat(solidsAt(q + 5u));
  uvec4 e = solidsAt(q + 4u), g = solidsAt(q + 6u);
  vec3 middle = uintBitsToFloat(e.yzw);
  SolidRecord s;
  s.pose = PoseRecord(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w, d.x);
  s.shape = ShapeRecord(d.y, d.z, d.w, e.x, middle.x, middle.y, middle.z, floatBitsToUint(f.x));
  s.friction = f.y;
  s.restitution = f.z;
  s.radius = f.w;
  s.body = g.x;
  s.noSlip = g.y;
  s.tableOffset = g.z;
  s.tableNodes = g.w;
  s.tableFirst = uintBitsToFloat(solidsAt(q + 7u).x);
  return s;
}
#endif
