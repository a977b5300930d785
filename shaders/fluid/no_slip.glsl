// How solids hold viscous fluid: what fluid in their place would add to its force. See docs/notes/slip.md.
// Needs what fluid/solid_density.glsl needs, nearSolidsAt() and solidAt().
#ifndef RILL_NO_SLIP_GLSL
#define RILL_NO_SLIP_GLSL
#include "fluid/fluids.glsl"
#include "fluid/images.glsl"
#include "fluid/near_solids.glsl"
#include "fluid/solid_density.glsl"
#include "shared/loops.glsl"

// A particle's velocity in the image with these signs, and the other way round.
vec3 imageVelocity(vec3 signs, vec3 v) { return NO_SLIP_WALLS ? signs.x * signs.y * signs.z * signs * v : signs * v; }

// How the solids near particle i hold it, but for the solids' share: its viscosity over its mass.
float mobility(uint i, uint fluid) {
  return inverseMassOf(fluid) * (SHEAR_VISCOSITY && i < control.solved ? priorVelocityAt(i).w : viscosityOf(fluid));
}

// The coefficient of a solid at x, an image of a particle; 0 of a solid that slips.
float adhesion(SolidRecord s, vec3 x, float mobility) {
  if (s.noSlip == 0u) return 0.0;
  vec3 normal, gradient = solidSample(s, x).xyz;
  if (gradient == vec3(0.0)) return 0.0;
  gradient *= shareOfImage(s, x);
  float distance = surfaceDistance(s.shape, localPoint(s.pose, x), normal);
  float rate = mobility * params.viscosityRate;
  return rate * control.step * length(gradient) * line(params.noSlipTable, params.tableNodes, distance).x;
}

// Sums over solids, and their images, of a particle.
struct Adhesion {
  float all;
  vec3 pull;  // of the coefficients times the solids' velocities
};

// Of bodies, or of the other solids.
Adhesion adhesionAt(NearSolids near, vec3 x, float mobility, bool ofBodies) {
  Adhesion sum = Adhesion(0.0, vec3(0.0));
  Images images = imagesNear(x, params.support);
  bool more = true;
  LOOP_WHILE (more) {
    vec3 signs, image = imageOf(nextImage(images), x, signs);
    for (uint m = 0u, k; nextSolid(near, m, k); ++m) {
      SolidRecord s = solidAt(k);
      if ((s.body != kNoBody) != ofBodies) continue;
      float a = adhesion(s, image, mobility);
      sum.all += a;
      sum.pull += a * imageVelocity(signs, velocityAt(s.pose, image));
    }
    more = advance(images);
  } LOOP_END(more);
  return sum;
}
#endif
