#version 460
// A picture of RGBA8 words, stretched over an area of the window; where it is transparent, what lies behind it.
layout(std430, set = 0, binding = 0) readonly buffer Picture { uint picture[]; };
layout(push_constant) uniform Push {
  uvec2 size;    // pixels of the picture
  vec2 scale;    // of them a pixel of the window
  vec2 corner;   // of the area in the window, pixels
  vec4 behind;
};
layout(location = 0) out vec4 result;

vec4 pixel(ivec2 at) {
  const uvec2 inside = uvec2(clamp(at, ivec2(0), ivec2(size) - 1));
  const vec4 p = unpackUnorm4x8(picture[inside.y * size.x + inside.x]);
  return vec4(p.rgb * p.a, p.a);
}

void main() {
  vec4 p;
  if (scale == vec2(1.0)) {
    p = pixel(ivec2(gl_FragCoord.xy - corner));
  } else {
    const vec2 place = (gl_FragCoord.xy - corner) * scale - 0.5, corner = floor(place), part = place - corner;
    const ivec2 at = ivec2(corner);
    p = mix(mix(pixel(at), pixel(at + ivec2(1, 0)), part.x), mix(pixel(at + ivec2(0, 1)), pixel(at + ivec2(1, 1)), part.x), part.y);
  }
  result = vec4(p.rgb + (1.0 - p.a) * behind.rgb, 1.0);
}
