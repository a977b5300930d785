// The last steps of a pixel: the domain's edges over it, and sRGB. Needs `edges`.
const vec3 kLine = vec3(0.045, 0.055, 0.07);

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

// An RGBA8 pixel of a linear colour. sRGB's power as a polynomial of the root, within a tenth of a step of 1/255.
uint encoded(vec3 linear) {
  const vec3 c = clamp(linear, 0.0, 1.0), r = sqrt(c);
  const vec3 power = ((((0.5173121 * r - 1.623691) * r + 2.031615) * r - 1.402758) * r + 1.517956) * r - 0.04010996;
  const uvec3 bytes = uvec3(min(mix(12.92 * c, power, vec3(greaterThan(c, vec3(0.0031308)))), 1.0) * 255.0 + 0.5);
  return bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
