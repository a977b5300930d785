// The sum over neighbors of a pass with one invocation a particle. Before it includes this the shader declares `push`, `vec3 here`,
// `vec4 own`, `uint head` and `uint fluid`, and defines COMPANION(j) and what else fluid/neighbors.glsl needs.
#ifndef RILL_GATHER_GLSL
#define RILL_GATHER_GLSL
#include "fluid/neighbors.glsl"

// Visits the neighbors of the invocation's particle i, of which `own` is the companion and `head` the head of its list; false where it has
// none. One that sleeps visits none.
bool gather(out uint i) {
  uint local = clusterInvocation();
  i = push.first + local;
  bool inRange = i < min(push.last, control.solved);
  if (!inRange) i = params.capacity;
  uvec4 particle = particleAt(i);
  here = uintBitsToFloat(particle.xyz);
  fluid = fluidOfWork(particle);
  own = COMPANION(i);
  head = headOf(i, inRange);
  bool moves = inRange && !sleeps(head);
  visitNeighbors(i, moves ? head : 0u, local, moves);
  return inRange;
}
#endif
