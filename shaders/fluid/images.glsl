// The domain's walls are mirrors: a particle counts its neighbors' images behind each wall too, and its own.
// As |x_i - M x_j| = |M x_i - x_j|, a pass over neighbors visits them again from the image M x_i. The vectors
// that it sums there are reflected. Needs fluid/uniforms.glsl.
//
// Along an axis image 0 is the particle itself, 1 that in the low wall and 2 that in the high one. THIN: walls that
// face each other reflect these too, and so on; 1, 3, 5 and 7 lie behind the low wall, 2, 4, 6 and 8 behind the
// high one. Its images in the domain are all combinations of one of each axis.
#ifndef RILL_IMAGES_GLSL
#define RILL_IMAGES_GLSL

const uint kLowImages = 0xAAu, kHighImages = 0x154u;  // as bits
const uint kImagesAlongAxis = THIN ? 9u : 3u;

// Image `which` along an axis of a place x; sign -1 if it is reflected.
float imageAlongAxis(uint which, float x, float low, float high, out float sign) {
  uint reflections = (which + 1u) / 2u;
  bool reflected = reflections % 2u == 1u, lowSide = which % 2u == 1u;
  sign = reflected ? -1.0 : 1.0;
  float across = lowSide ? low - high : high - low;  // from the other wall to this one
  float image = reflected ? 2.0 * (lowSide ? low : high) - x : x;
  return image + float(reflected ? reflections - 1u : reflections) * across;
}

// Image `n` of x, of which 0 is x itself, and the signs of its axes.
vec3 imageOf(uint n, vec3 x, out vec3 signs) {
  vec3 low = wallsLow(), high = wallsHigh(), image;
  for (int a = 0; a < 3; ++a) {
    image[a] = imageAlongAxis(n % kImagesAlongAxis, x[a], low[a], high[a], signs[a]);
    n /= kImagesAlongAxis;
  }
  return image;
}

// The images that a particle inside the walls can be within `reach` (m) of.
struct Images {
  uvec3 near;  // a bit for each image along an axis
  uvec3 left;  // of those, what is still to be visited; the lowest is the next
};

Images imagesNear(vec3 x, float reach) {
  vec3 low = wallsLow(), high = wallsHigh();
  uvec3 near = uvec3(1u);
  for (uint n = 1u; n < (WALLS ? kImagesAlongAxis : 1u); ++n)
    for (int a = 0; a < 3; ++a) {
      float sign, image = imageAlongAxis(n, x[a], low[a], high[a], sign);
      float gap = max(low[a] + params.margin - image, image - high[a] + params.margin);
      near[a] |= uint(gap < reach) << n;
    }
  if (aboveOutflow(x)) near[params.outflowSide / 2u] &= params.outflowSide % 2u == 0u ? ~kLowImages : ~kHighImages;
  return Images(near, near);
}

// The number of the next image; the first is 0.
uint nextImage(Images images) {
  return (uint(findLSB(images.left.z)) * kImagesAlongAxis + uint(findLSB(images.left.y))) * kImagesAlongAxis + uint(findLSB(images.left.x));
}

// Goes on to the next image; whether there is one.
bool advance(inout Images images) {
  images.left.x &= images.left.x - 1u;
  bool carryY = images.left.x == 0u;
  if (carryY) images.left = uvec3(images.near.x, images.left.y & (images.left.y - 1u), images.left.z);
  bool carryZ = carryY && images.left.y == 0u;
  if (carryZ) images.left = uvec3(images.left.x, images.near.y, images.left.z & (images.left.z - 1u));
  return images.left.z != 0u;
}
#endif
