// Specialization constants of the fluid's shaders. C++ gives them by name (engine/fluid/pipelines.cpp); each number is used once.
#ifndef RILL_FLUID_CONSTANTS_GLSL
#define RILL_FLUID_CONSTANTS_GLSL
layout(constant_id = 0) const uint KERNEL = 0;         // 0: Wendland C2; 1: poly6 with the spiky gradient
layout(constant_id = 1) const uint CLUSTER = 8;        // particles that walk the grid together: 4, 8, 16 or 32, at most a subgroup
layout(constant_id = 2) const uint LIST_CAPACITY = 0;  // entries a particle of the neighbor list; 0: no list
layout(constant_id = 3) const bool WALKS = false;      // the variant that can walk the grid, for particles whose list overflowed
layout(constant_id = 4) const bool WALLS = false;      // the domain has a wall
layout(constant_id = 5) const bool WARM = true;        // multipliers and accelerations of the warm start are kept
layout(constant_id = 6) const bool MULTIPLIERS = false;  // the multipliers of a substep are kept: for the next iteration, or for probes
layout(constant_id = 7) const bool SOLIDS = false;     // there are solids
layout(constant_id = 8) const bool FORCES = false;     // viscosity or another force changes velocities in every substep
layout(constant_id = 9) const bool ARTIFICIAL_PRESSURE = false;
layout(constant_id = 10) const bool NEAR_SOLIDS = false;  // over the particles near solids; else over all
layout(constant_id = 11) const bool THIN = true;       // opposite walls can both be near a particle
layout(constant_id = 12) const bool REBUILDS = false;  // the list is built after the sort
layout(constant_id = 14) const uint TENSILE_POWER = 0; // n of artificial pressure if that is whole, else 0
layout(constant_id = 15) const bool MESHES = false;    // some solids are meshes
layout(constant_id = 16) const bool CULL_SOLIDS = false;  // many solids: each workgroup finds those near it
layout(constant_id = 17) const bool LOADS = false;     // loads on solids are measured
layout(constant_id = 18) const bool BODIES = false;    // some solids are rigid bodies
layout(constant_id = 19) const bool FIRM_SOLIDS = true;  // some solids are no bodies: those push predictions, too
layout(constant_id = 20) const bool NO_SLIP_WALLS = false;   // fluid sticks to the domain's walls
layout(constant_id = 21) const bool NO_SLIP_SOLIDS = false;  // fluid sticks to some solids
layout(constant_id = 22) const bool REMOVES = false;   // particles come and go: at a rebuild, inactive ones are taken out
layout(constant_id = 23) const bool OUTFLOW = false;   // a side is a wall up to a level only
layout(constant_id = 24) const bool REGIONS = false;   // regions of fluid at rest sleep on their own
layout(constant_id = 25) const bool FLUIDS = false;    // there are several fluids
layout(constant_id = 26) const bool DIFFUSES = false;  // some of them diffuse
layout(constant_id = 27) const bool INTERFACES = false;  // some have tension between them
layout(constant_id = 28) const bool SHEAR_VISCOSITY = false;  // shear changes the viscosity of a fluid
layout(constant_id = 29) const bool TENSION = false;   // the surface has tension: lists have a segment of far neighbors
layout(constant_id = 30) const uint NEAR_QUADS = 1;    // size of an entry of nearSolids, in units of four words
layout(constant_id = 31) const bool MOUTHS = false;    // there are emitters
layout(constant_id = 32) const bool MOUTHS_MOVE = false;  // keyframes move some of their mouths
#define LIST_OVERSIZED_ID 13
#endif
