// Which particles a solid may push or touch in a substep: those whose prediction is within this distance of its surface. A particle goes at
// most twice as far from its place as cfl allows (correct.comp), and so three times as far from its prediction.
#ifndef RILL_SOLID_REACH_GLSL
#define RILL_SOLID_REACH_GLSL

// m from a solid within which it has friction.
float contactReach() { return 1.1 * params.margin; }

// m, of bodies; of others, the next prediction is pushed out, too.
float reachOfBodies() { return contactReach() + max(3.0 * params.cfl, 0.03) * params.spacing; }
float maxReach() { return reachOfBodies() + (params.cfl * params.spacing + 1.5 * control.solidSpeed * control.nextStep); }
float reachOf(SolidRecord s) { return s.body == kNoBody ? maxReach() : reachOfBodies(); }
#endif
