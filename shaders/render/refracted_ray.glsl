// Where the ray of a pixel, bent where it enters the fluid and where it leaves it, meets the scene's depth. Needs scene_depth.glsl,
// backAt() and thicknessAtPixel().

const float kMaxDepth = 1e4;     // spacings: farthest
const float kStride = 8.0;       // pixels between points of the march
const int kMaxStrides = 16;      // at most, over each of the ray's two parts
const int kHalvings = 6;         // at most
const float kRayError = 0.5;     // pixels: ends the halving
const int kBackSteps = 2;        // of the search for where the ray leaves the fluid
// Spacings between its last two: from a ray that is bent there to one that runs on parallel to the view ray.
const vec2 kBackFade = vec2(0.5, 1.5);
// Of the squared cosine behind the surface, below 0 with total reflection: from a ray that runs on parallel to one that is bent, and from
// one that stays in the fluid to one that leaves it.
const vec2 kBentFade = vec2(0.05, 0.25), kTotalFade = vec2(-0.1, 0.1);
const vec2 kParallelFade = vec2(0.1, 0.03);  // of the change of direction: less than that may be noise of the thickness
const float kAway = 0.01;        // least cosine to the view direction of rays that go far
const float kBorder = 0.06;      // heights of the picture: rays that meet nothing before they are so near to its border see the environment
const float kSilhouette = 16.0;  // pixels: least step in depth from one pixel to the next that is an edge of the scene

float sceneDepthAt(vec2 pixel) { return sceneDepth(uvec2(pixel)); }

BackSample backAtPixel(vec2 pixel) {
  const Around near = around(pixel);
  const vec2 rest = 1.0 - near.part;
  const vec4 shares = vec4(rest.x * rest.y, near.part.x * rest.y, rest.x * near.part.y, near.part.x * near.part.y);
  BackSample sum = BackSample(0.0, vec2(0.0), 0.0);
  for (int k = 0; k < 4; ++k) {
    const BackSample one = unpackBack(backAt(near.samples[k]));
    const float w = shares[k] * one.trust;
    sum.z += w * one.z;
    sum.slope += w * one.slope;
    sum.trust += w;
  }
  const float inverse = 1.0 / max(sum.trust, 1e-4);
  return BackSample(sum.z * inverse, sum.slope * inverse, sum.trust);
}

// How a ray leaves the fluid.
struct Leaving {
  vec3 direction;
  float inside;     // length of the ray in the fluid, m
  // That of the view ray, here or where it leaves the fluid, whichever is longer, m. Totally reflected rays stay for as long again.
  float straight;
  float thickness;  // of the view ray there, m
  float bends;      // 0: parallel to the view ray, 1: by Snell's law
};

// `trust`: 1 for a ray that was bent where it entered, 0 for one that was not.
Leaving leavingRay(vec3 from, vec3 bent, vec3 sight, float straight, float trust) {
  const vec2 last_pixel = pictureSize() - 1.0;
  const vec3 guess = from + straight * bent;
  const float thickness = thicknessAtPixel(clamp(pixelOf(guess), vec2(0.0), last_pixel));
  const float longest = max(straight, thickness);
  // Each step meets the plane that the back has where the last one ended.
  float size = straight, change = 0.0;
  vec3 normal = sight;
  RILL_LOOP for (int k = 0; k < kBackSteps; ++k) {
    const vec2 pixel = clamp(pixelOf(from + size * bent), vec2(0.0), last_pixel), axis = axisOf(pixel);
    const BackSample behind = backAtPixel(pixel);
    normal = normalize(vec3(behind.slope, 1.0));
    const vec3 end = rayFrom(axis) + behind.z * rayAlong(axis);
    const float next = clamp(dot(normal, end - from) / max(dot(normal, bent), 0.1), 0.0, 2.0 * straight);
    change = next - size;
    size = next;
    trust = min(trust, behind.trust);
  }
  trust *= 1.0 - smoothstep(kBackFade.x, kBackFade.y, abs(change) / view.spacing);
  const float index = look.absorption.w, cosine = dot(bent, normal), square = 1.0 - index * index * (1.0 - cosine * cosine);
  const vec3 refracted = index * bent - (index * cosine - sqrt(max(square, 0.0))) * normal;
  const float reflected = trust * (1.0 - smoothstep(kTotalFade.x, kTotalFade.y, square));
  trust *= smoothstep(kBentFade.x, kBentFade.y, square) * smoothstep(kParallelFade.y, kParallelFade.x, length(refracted - sight));
  return Leaving(normalize(mix(sight, refracted, trust)), mix(longest, size, trust), longest * (1.0 + reflected), thickness, trust);
}

// On the screen the ray goes on a line to where it leaves the fluid, and on another one from there. `part` of 0 to 1 is in the fluid, of 1
// to 2 behind it, evenly on the screen.
struct RayParts {
  vec2 from, leaves, end;  // pixels
  vec3 depths;             // the same; in perspective their inverses, which change evenly on the screen
};
vec2 rayPixel(RayParts ray, float part) {
  return clamp(part < 1.0 ? mix(ray.from, ray.leaves, part) : mix(ray.leaves, ray.end, part - 1.0), vec2(0.0), pictureSize() - 1.0);
}
float rayDepth(RayParts ray, float part) {
  const float depth = part < 1.0 ? mix(ray.depths.x, ray.depths.y, part) : mix(ray.depths.y, ray.depths.z, part - 1.0);
  return view.perspective > 0.0 ? 1.0 / depth : depth;
}

// The parts of a ray that ends where it leaves the picture, or far away.
RayParts rayParts(vec2 middle, float start, vec3 leaves, vec3 direction) {
  const float far = kMaxDepth * view.spacing;
  const bool away = direction.z > kAway;
  const float reach = away ? (far - leaves.z) / direction.z : 0.9 * (leaves.z - view.near_depth) / max(-direction.z, kAway);
  const vec3 end = leaves + reach * direction;
  RayParts ray;
  ray.from = middle;
  ray.leaves = pixelOf(leaves);
  // In perspective where rays of this direction meet.
  ray.end = view.perspective > 0.0 && away ? pixelOfAxis(direction.xy / direction.z) : pixelOf(end);
  ray.depths = view.perspective > 0.0 ? 1.0 / vec3(start, leaves.z, end.z) : vec3(start, leaves.z, end.z);
  const vec2 size = pictureSize() - 1.0, to = ray.end - ray.leaves;
  if (all(greaterThanEqual(ray.leaves, vec2(0.0))) && all(lessThanEqual(ray.leaves, size))) {
    const bvec2 still = lessThan(abs(to), vec2(1e-6));
    const vec2 parts = (mix(vec2(0.0), size, greaterThan(to, vec2(0.0))) - ray.leaves) / mix(to, vec2(1.0), still);
    const float part = clamp(min(still.x ? 1.0 : parts.x, still.y ? 1.0 : parts.y), 0.0, 1.0);
    ray.end = mix(ray.leaves, ray.end, part);
    ray.depths.z = mix(ray.depths.y, ray.depths.z, part);
  }
  return ray;
}
float stridesOver(float pixels) { return clamp(ceil(pixels / kStride), 1.0, float(kMaxStrides)); }
float pixelsBetween(vec2 a, vec2 b) { return min(max(abs(a.x - b.x), abs(a.y - b.y)), 1e4); }

struct RayEnd {
  vec2 pixel;
  float front;    // depth in front of which the scene is not what the ray meets
  float inside;   // length of the ray in the fluid, m
  float outside;  // share of it that ends outside of the picture
};

// A march finds the first point behind the scene's depth, and halving the pixel before it. Where a solid's edge lies between, the ray
// passes behind the solid, and what is beside the edge stands for what is hidden.
RayEnd refractedRay(vec2 middle, vec3 from, vec3 bent, Leaving leaving) {
  const float far = kMaxDepth * view.spacing;
  vec3 leaves = from + leaving.inside * bent;
  leaves.z = clamp(leaves.z, view.near_depth, far);
  const RayParts ray = rayParts(middle, from.z, leaves, leaving.direction);
  const float pixels = pixelsBetween(ray.from, ray.leaves), pixels_behind = pixelsBetween(ray.leaves, ray.end);
  const float strides = stridesOver(pixels), strides_behind = stridesOver(pixels_behind);
  float first = 0.0, last = 2.0;
  RILL_LOOP for (int k = 1; k <= 2 * kMaxStrides; ++k) {
    last = float(k) <= strides ? float(k) / strides : min(1.0 + (float(k) - strides) / strides_behind, 2.0);
    if (last > 1.999 || sceneDepthAt(rayPixel(ray, last)) <= rayDepth(ray, last)) break;
    first = last;
  }
  const float length_here = last > 1.0 ? pixels_behind : pixels;
  RILL_LOOP for (int k = 0; k < kHalvings; ++k) {
    if ((last - first) * length_here < kRayError) break;
    const float part = 0.5 * (first + last);
    const bool behind = sceneDepthAt(rayPixel(ray, part)) <= rayDepth(ray, part);
    first = behind ? first : part;
    last = behind ? part : last;
  }
  const float before = min(sceneDepthAt(rayPixel(ray, first)), far), beyond = min(sceneDepthAt(rayPixel(ray, last)), far);
  const float near = rayDepth(ray, first), gap = max(before - near, 0.0), beyond_gap = min(beyond - rayDepth(ray, last), 0.0);
  const bool edge = beyond < before - kSilhouette * metersAPixel(beyond);
  const float part = edge ? first : mix(first, last, gap / max(gap - beyond_gap, 1e-20));
  const float z = edge ? before : rayDepth(ray, part);
  const vec2 pixel = rayPixel(ray, part), to_border = min(pixel, pictureSize() - pixel);
  const float in_fluid = part < 1.0 ? (z - from.z) / max(bent.z, 0.1) : mix(leaving.straight, leaving.inside, leaving.bends);
  const bool met = beyond < far && beyond <= rayDepth(ray, last);
  const float outside = met ? 0.0 : leaving.bends * (1.0 - smoothstep(0.0, kBorder, min(to_border.x, to_border.y) / float(view.height)));
  return RayEnd(pixel, max(edge ? 0.5 * (before + beyond) : from.z, from.z), in_fluid, outside);
}
