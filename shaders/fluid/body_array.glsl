// The bodies of a pass that only reads them: see solid_array.glsl. Needs READ_UINT4(binding, bodies) before it.
#ifndef RILL_BODY_ARRAY_GLSL
#define RILL_BODY_ARRAY_GLSL
#include "shared/body_records.h"

// What mobility() takes, `held` and `stiffness` alone.
BodyRecord bodyAt(uint k) {
  uint q = kBodyQuads * k;
  vec3 center = uintBitsToFloat(bodiesAt(q + 3u).yzw);
  uvec4 state = bodiesAt(q + 8u);
  vec4 a = uintBitsToFloat(bodiesAt(q + 9u));
  vec3 b = uintBitsToFloat(bodiesAt(q + 10u).xyz);
  BodyRecord body;
  body.predicted.centerX = center.x;
  body.predicted.centerY = center.y;
  body.predicted.centerZ = center.z;
  body.mass = uintBitsToFloat(state.x);
  body.locked = state.y;
  body.held = state.z;
  body.stiffness = a.x;
  body.inverseXX = a.y;
  body.inverseYY = a.z;
  body.inverseZZ = a.w;
  body.inverseYZ = b.x;
  body.inverseZX = b.y;
  body.inverseXY = b.z;
  return body;
}
#endif
