// Where the ray of a pixel, bent at the fluid's surface, meets the scene's depth. Needs `scene_depth` and thicknessAt().

const float kMaxDepth = 1e4;     // spacings: farthest
const float kStride = 8.0;       // pixels between points of the march
const int kMaxStrides = 16;      // at most, over each of the ray's two parts
const int kHalvings = 6;         // at most
const float kRayError = 0.5;     // pixels: ends the halving
const float kSilhouette = 16.0;  // pixels: least step in depth from one pixel to the next that is an edge of the scene

float sceneDepthAt(vec2 pixel) { return scene_depth[uint(pixel.y) * view.width + uint(pixel.x)]; }

// In the fluid the ray runs along its bent direction, behind it parallel to the view ray. On the screen it goes out to where it leaves the
// fluid and, in perspective, back along the same line. `part` of 0 to 1 is in the fluid, of 1 to 2 behind it, evenly on the screen.
struct RayParts {
  vec2 from, out_to;    // pixels
  float start, leaves;  // depths; in perspective their inverses, which change evenly on the screen
  float end;
};
vec2 rayPixel(RayParts ray, float part) {
  const float along = part < 1.0 ? part : (view.perspective > 0.0 ? 2.0 - part : 1.0);
  return clamp(ray.from + along * ray.out_to, vec2(0.0), pictureSize() - 1.0);
}
float rayDepth(RayParts ray, float part) {
  const float depth = part < 1.0 ? mix(ray.start, ray.leaves, part) : mix(ray.leaves, ray.end, part - 1.0);
  return view.perspective > 0.0 ? 1.0 / depth : depth;
}

struct RayEnd {
  vec2 pixel;
  float front;      // depth in front of which the scene is not what the ray meets
  float size;       // of the ray, m
  float inside;     // of the ray in the fluid, unless it ends before, m
  float thickness;  // where it leaves the fluid, m
};

// A march finds the first point behind the scene's depth, and halving the pixel before it. Where a solid's edge lies between, the ray
// passes behind the solid, and what is beside the edge stands for what is hidden.
RayEnd refractedRay(vec2 middle, vec3 from, vec3 bent, vec3 sight, float straight) {
  const float far = kMaxDepth * view.spacing;
  vec3 leaves = from + straight * bent;
  leaves.z = max(leaves.z, view.near_depth);
  const float exit_thickness = thicknessAt(clamp(pixelOf(leaves), vec2(0.0), pictureSize() - 1.0));
  const float inside = max(straight, exit_thickness);
  leaves = from + inside * bent;
  leaves.z = clamp(leaves.z, view.near_depth, far);
  RayParts ray = RayParts(middle, pixelOf(leaves) - middle, from.z, leaves.z, far);
  if (view.perspective > 0.0) ray = RayParts(middle, ray.out_to, 1.0 / from.z, 1.0 / leaves.z, 1.0 / far);
  const float pixels = min(max(abs(ray.out_to.x), abs(ray.out_to.y)), 1e4);
  const float stride = 1.0 / clamp(ceil(pixels / kStride), 1.0, float(kMaxStrides));
  float first = 0.0, last = 2.0;
  RILL_LOOP for (int k = 1; k <= 2 * kMaxStrides; ++k) {
    last = min(float(k) * stride, 2.0);
    if (last > 1.999 || sceneDepthAt(rayPixel(ray, last)) <= rayDepth(ray, last)) break;
    first = last;
  }
  RILL_LOOP for (int k = 0; k < kHalvings; ++k) {
    if ((last - first) * pixels < kRayError) break;
    const float part = 0.5 * (first + last);
    const bool behind = sceneDepthAt(rayPixel(ray, part)) <= rayDepth(ray, part);
    first = behind ? first : part;
    last = behind ? part : last;
  }
  const float before = min(sceneDepthAt(rayPixel(ray, first)), far), beyond = min(sceneDepthAt(rayPixel(ray, last)), far);
  const float near = rayDepth(ray, first), gap = max(before - near, 0.0), beyond_gap = min(beyond - rayDepth(ray, last), 0.0);
  const bool edge = beyond < before - kSilhouette * metersAPixel(beyond);
  const float part = edge ? first : mix(first, last, gap / max(gap - beyond_gap, 1e-20));
  const float z = edge ? before : rayDepth(ray, part), in_fluid = min(z, leaves.z);
  const float size = (in_fluid - from.z) / max(bent.z, 0.1) + (z - in_fluid) / sight.z;
  return RayEnd(rayPixel(ray, part), max(edge ? 0.5 * (before + beyond) : from.z, from.z), size, inside, exit_thickness);
}
