#version 460
// Thickness of the fluid along each sample's ray, in the grids of SurfaceStage::addThickness(): each particle spreads its volume over a
// disc. With NO_SCENE nothing occludes it. MIXED: particles give each fluid its share in them.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(constant_id = 0) const uint FLUIDS = 1u;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Thickness { uint thickness[]; };  // in view.unit
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 3) readonly buffer ParticleCount { uint particle_count; };
#ifdef MIXED
layout(std430, set = 0, binding = 4) readonly buffer Concentration { vec4 concentration[]; };
#include "shared/mixture.glsl"
#define SCENE_DEPTH 5
#else
#define SCENE_DEPTH 4
#endif
#ifndef NO_SCENE
#include "render/scene_depth.glsl"
#endif

bool behindScene(ivec2 at, float z) {
#ifdef NO_SCENE
  return false;
#else
  const uvec2 pixel = min(uvec2(samplePixel(at)), uvec2(view.width, view.height) - 1u);
  return z > sceneDepth(pixel);
#endif
}

#ifndef NO_SCENE
#include "render/fluid_depths.glsl"
// A length in counts at depth z.
void addDepth(uint cells, uint cell, float z, uint amount) {
  atomicAdd(thickness[depthGrid(FLUIDS) * cells + cell], amount * depthCounts(z, view.spacing));
}
#endif

#ifdef MIXED
const float kBegins = 0.1;  // share of a fluid in a particle from which on it counts as one of those where the fluid begins
float shares[FLUIDS];

void beginVisit(uint owner) {
  const uint i = groupIndex() * kSurfaceGroup + owner, own = min(uint(position[i].w + 0.5), FLUIDS - 1u);
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) shares[fluid] = shareOf(fluid, own, concentration[i]);
}
#else
uint first_sample = 0u;  // of the grid of the particle's fluid

void beginVisit(uint owner) {
  if (FLUIDS == 1u) return;
  const uint fluid = uint(position[groupIndex() * kSurfaceGroup + owner].w + 0.5);
  first_sample = min(fluid, FLUIDS - 1u) * sampleGrid().x * sampleGrid().y;
}
#endif

void add(ivec2 at, float z, float meters) {
  const ivec2 grid = ivec2(sampleGrid());
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, grid)) || behindScene(at, z)) return;
#ifdef MIXED
  const uint cells = uint(grid.x * grid.y), cell = uint(at.y * grid.x + at.x);
  uint sum = 0u;
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) {
    const uint part = uint(shares[fluid] * meters / view.unit + 0.5);
    if (part == 0u) continue;
    sum += part;
    atomicAdd(thickness[fluid * cells + cell], part);
#ifndef NO_SCENE
    if (shares[fluid] >= kBegins) atomicMax(thickness[(FLUIDS + fluid) * cells + cell], ~floatBitsToUint(z));
#endif
  }
#ifndef NO_SCENE
  addDepth(cells, cell, z, sum);
#endif
#else
  const uint amount = uint(meters / view.unit + 0.5);
  if (amount == 0u) return;
  const uint index = first_sample + uint(at.y * grid.x + at.x);
  atomicAdd(thickness[index], amount);
#ifndef NO_SCENE
  if (FLUIDS > 1u) atomicMax(thickness[FLUIDS * uint(grid.x * grid.y) + index], ~floatBitsToUint(z));  // 0: none
  addDepth(uint(grid.x * grid.y), uint(at.y * grid.x + at.x), z, amount);
#endif
#endif
}

// The integral of (1 - r^2 / R^2)^2 over the disc is pi R^2 / 3.
void visitSample(vec3 center, float radius, ivec2 at) {
  const float inside = 1.0 - raySquare(center, axisOf(samplePixel(at))) / (radius * radius);
  const float peak = view.spacing * view.spacing * view.spacing * 3.0 / (3.14159265 * radius * radius);
  if (inside > 0.0) add(at, center.z, peak * inside * inside);
}
void endVisit(uint owner) {}
#include "render/surface_visit.glsl"

// A disc too small to be sampled is distributed bilinearly.
void addSmall(vec3 center, float side) {
  const vec2 at = sampleOf(pixelOf(center));
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - vec2(base);
  const float all = view.spacing * view.spacing * view.spacing / (side * side);
  add(base, center.z, all * (1.0 - part.x) * (1.0 - part.y));
  add(base + ivec2(1, 0), center.z, all * part.x * (1.0 - part.y));
  add(base + ivec2(0, 1), center.z, all * (1.0 - part.x) * part.y);
  add(base + ivec2(1, 1), center.z, all * part.x * part.y);
}

void main() {
  const uint i = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  bool live = i < min(view.count, particle_count) && drawable(position[i].xyz);
  const vec3 center = live ? viewPoint(position[i].xyz) : vec3(0.0);
  // Includes particles within a sample of the picture.
  live = live && center.z > view.near_depth && shownWithin(center, view.radius, float(view.step));
  const float side = metersAPixel(center.z) * float(view.step);
  const bool small = view.radius < 1.5 * side;
  if (live && small) {
    beginVisit(gl_LocalInvocationIndex);
    addSmall(center, side);
  }
  visitSphere(live && !small, center, view.radius);
}
