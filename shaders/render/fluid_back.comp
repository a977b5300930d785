#version 460
// Where the fluid ends along each sample's ray: its mean depth and half of its thickness behind it, which is exact without gaps. A plane is
// fitted to that over some spacings: its depth, its slopes, and how well it fits.
#extension GL_GOOGLE_include_directive : require
#define RILL_PUSH_MORE uint surface_grid;  // of the surface: pixels per sample, and samples of the margin times 65536
#include "render/surface.glsl"
#include "render/fluid_depths.glsl"
#include "render/fluid_back.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(constant_id = 0) const uint FLUIDS = 1u;
READ_UINT(0, thickness)
#define SCENE_DEPTH 1
#include "render/scene_depth.glsl"
READ_UINT2(2, samples)  // of the surface: depth, normal
layout(std430, set = 0, binding = 3) writeonly buffer Back { uvec2 back[]; };

const int kTaps = 2;             // to each side
const float kReach = 2.0;        // spacings to the farthest
const float kLeast = 0.5;        // spacings: thinner fluid has no back
const vec2 kMisfit = vec2(0.5, 1.0);  // root mean square, spacings
const vec2 kGap = vec2(0.5, 2.0);     // to the scene, spacings
const vec2 kWhole = vec2(0.5, 1.5);   // between where it begins and half of its thickness in front of its mean depth, spacings: a gap
const vec2 kShare = vec2(0.4, 0.7);   // of the taps that have fluid

struct Tap {
  float z, size;  // depth of the back, thickness; m
  float depths;   // of the thickness, m
};

// Depth where the fluid begins, of the nearest sample of the surface.
float beginsAt(vec2 pixel) {
  const uint side = surface_grid & 0xFFFFu, margin = surface_grid >> 16;
  const uvec2 grid = (uvec2(view.width, view.height) + side - 1u) / side + 2u * margin, at = min(uvec2(pixel) / side + margin, grid - 1u);
  return uintBitsToFloat(samplesAt(at.y * grid.x + at.x).x);
}
Tap tapAt(ivec2 at, uvec2 grid) {
  const uint cells = grid.x * grid.y, cell = uint(at.y) * grid.x + uint(at.x);
  uint counts = 0u;
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) counts += thicknessAt(fluid * cells + cell);
  const float size = float(counts) * view.unit;
  const float middle = meanDepth(float(thicknessAt(depthGrid(FLUIDS) * cells + cell)), float(counts), view.spacing);
  const vec3 along = rayAlong(axisOf(samplePixel(at)));
  const float depths = size * inversesqrt(dot(along, along));
  return Tap(middle + 0.5 * depths, size, depths);
}

void main() {
  const uint index = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  const uvec2 grid = sampleGrid();
  if (index >= grid.x * grid.y) return;
  const ivec2 p = ivec2(index % grid.x, index / grid.x);
  const Tap own = tapAt(p, grid);
  const int taps = own.size > 0.0 ? kTaps : -kTaps - 1;  // none without fluid
  const float side = max(metersAPixel(own.z) * float(view.step), 1e-4 * view.spacing);
  const int stride = int(max(kReach * view.spacing / (float(kTaps) * side) + 0.5, 1.0));
  const float change = 3.0 * max(view.spacing, side * float(stride));
  float weights = 0.0, all = 0.0, zz = 0.0;
  vec3 first = vec3(0.0), second = vec3(0.0);  // sums of x, y, z; of xx, yy, xy
  vec2 zs = vec2(0.0);                         // of xz, yz
  RILL_LOOP for (int y = -kTaps; y <= taps; ++y)
    RILL_LOOP for (int x = -kTaps; x <= taps; ++x) {
      const vec2 off = vec2(x, y);
      const float inside = max(1.0 - dot(off, off) / float((kTaps + 1) * (kTaps + 1)), 0.0);
      all += inside;
      const ivec2 at = p + stride * ivec2(x, y);
      if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(grid)))) continue;
      const Tap tap = tapAt(at, grid);
      const float off_z = (tap.z - own.z) / view.spacing, apart = (tap.z - own.z) / change;
      const float w = inside * clamp(tap.size / (kLeast * view.spacing), 0.0, 1.0) * max(1.0 - apart * apart, 0.0);
      weights += w;
      first += w * vec3(off, off_z);
      second += w * vec3(off * off, off.x * off.y);
      zs += w * off * off_z;
      zz += w * off_z * off_z;
    }
  const float inverse = 1.0 / max(weights, 1e-6);
  first *= inverse;
  second = second * inverse - vec3(first.xy * first.xy, first.x * first.y);
  zs = zs * inverse - first.xy * first.z;
  zz = zz * inverse - first.z * first.z;
  const float determinant = second.x * second.y - second.z * second.z;
  vec2 slope = determinant > 0.01 ? vec2(second.y * zs.x - second.z * zs.y, second.x * zs.y - second.z * zs.x) / determinant : vec2(0.0);
  const float misfit = sqrt(max(zz - dot(slope, zs), 0.0));
  const float z = own.z + (first.z - dot(slope, first.xy)) * view.spacing;
  slope *= view.spacing / (float(stride) * float(view.step));  // m per pixel
  const uvec2 pixel = min(uvec2(samplePixel(p)), uvec2(view.width, view.height) - 1u);
  const float gap = sceneDepth(pixel) - z;
  const float begins = beginsAt(samplePixel(p)), hidden = abs(own.z - own.depths - begins);
  const bool summed = (begins + own.size) * own.size < kMaxDepthSum * view.spacing * view.spacing;  // without an overflow
  const float fits = (1.0 - smoothstep(kMisfit.x, kMisfit.y, misfit)) * smoothstep(kShare.x, kShare.y, weights / max(all, 1e-6));
  const float free = smoothstep(kGap.x, kGap.y, gap / view.spacing) * (1.0 - smoothstep(kWhole.x, kWhole.y, hidden / view.spacing));
  const float trust = determinant > 0.01 && summed ? fits * free : 0.0;
  // The plane in view space: differences along both axes of the picture.
  const vec2 axis = axisOf(samplePixel(p));
  const vec3 along = rayAlong(axis), widths = vec3(vec2(view.scale[0], view.scale[1]) * 2.0 / pictureSize() * widening(z), 0.0);
  const vec3 normal = cross(vec3(widths.x, 0.0, 0.0) + slope.x * along, vec3(0.0, widths.y, 0.0) + slope.y * along);
  back[index] = taps > 0 ? packBack(z, normal, trust) : noBack();
}
