// The density that a half-space displaces, from the table of engine/sph/half_space.hpp. Needs `params` and tableAt(k).
#ifndef RILL_HALF_SPACE_GLSL
#define RILL_HALF_SPACE_GLSL

// Value and slope at distance s of the table that begins at `offset`; beyond it those of its last node, which are 0.
vec2 line(uint offset, uint nodes, float s) {
  float at = clamp(s, 0.0, params.support * 2.0) / params.tableStep;
  uint node = min(uint(at), nodes - 2u);
  vec4 both = tableAt(offset + node);
  return mix(both.xy, both.zw, clamp(at - float(node), 0.0, 1.0));
}

// F of engine/sph/half_space.hpp: the share that a half-space at signed distance s displaces, and its slope.
vec2 face(float s) {
  vec2 f = line(0u, params.tableNodes, abs(s));
  return s < 0.0 ? vec2(1.0 - f.x, f.y) : f;
}
#endif
