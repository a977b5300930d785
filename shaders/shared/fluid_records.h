// What the fluid solver's C++ and shaders share.
#ifndef RILL_FLUID_RECORDS_H
#define RILL_FLUID_RECORDS_H
#include "shared/body_records.h"
#include "shared/dispatch_commands.h"
#include "shared/interop.h"
#include "shared/measure_records.h"
#include "shared/neighbor_list.h"
#include "shared/push_records.h"
#include "shared/solid_loads.h"
#include "shared/solid_records.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kFluidGroup = 64u;        // invocations a workgroup of every per-particle pass
RILL_CONST uint kCellsPerReach = 2u;       // grid cells in x as long as one in y or z
RILL_CONST uint kSettleSubsteps = 512u;    // at most, before the first substep in time
RILL_CONST uint kMaxInitialPressureIterations = 1024u;    // iterations of the initial pressure, at most, after settling
// a layer: substeps in the mean error at rest, and in the mean of the steps that it asks for
RILL_CONST float kErrorSubsteps = 10.0f;
RILL_CONST float kMaxNoiseDamping = 0.5f;     // coefficient of noise damping, at most: no wave is turned around below 0.69
RILL_CONST float kMomentum = 0.3f;            // part of a multiplier's change in a flow that is added to the next
RILL_CONST float kMomentumCompression = 4.0e-4f;  // compression that a change of a multiplier ended where momentum halves
RILL_CONST float kTravelAtRest = 0.4f;        // share of travelLimit in a fluid at rest
RILL_CONST float kSparedFlow = 0.1f;          // mean speed of neighbors over the root of gravity times spacing where noise damping halves
// share of the kernel inside solids that the tangential scale makes up for, at most. See
// docs/notes/walls-and-solids.md
RILL_CONST float kMaxSolidCoverage = 0.4f;
RILL_CONST uint kWindow = 32u;            // candidates that a grid walk looks at together, a bit of a mask each
// Candidates that the particles of a cluster look at together, at most, in whole windows; more are
// counted as a bound hit. Lavapipe ends a shader after 65,535 steps of its loops: a window takes
// about 20 where a cluster is 4, so that 1,024 windows leave room for the loops around them.
RILL_CONST uint kWalkBound = 32768u;
RILL_CONST float kInactivePosition = 1.0e9f;        // m: position of inactive particles and of the dummy neighbor that pads the list
RILL_CONST float kInactiveLimit = 5.0e8f;           // m: from this coordinate on a particle is inactive
RILL_CONST uint kMaxIds = 0x7F000000u;          // ids are below: they travel among floats (number.glsl)
RILL_CONST float kNoWall = 1.0e9f;        // m, a coordinate
RILL_CONST float kMultiplierScale = 1024.0f;  // multipliers travel as halves in units of 1 / (restGradient * this)

// Constant over a run; a uniform block.
struct FluidParams {
  uint capacity;          // entries of the arrays; the dummy neighbor is the next
  uint listCapacity;      // entries that the list holds a particle, a multiple of 4; 0: no list
  uint chunkParticles;    // particles a list buffer, a multiple of kListBlock
  uint solidCount;
  uint bodyCount;         // solids that are rigid bodies
  uint contactPoints;     // of all bodies
  uint pressureProbes;
  uint emitterCount, drainCount;
  uint outflowSide;       // likewise a bit; a wall up to
  float outflowLevel;     // m; kNoWall: no outflow
  uint openRemoves;       // sides, as bits of SideMask, through which particles leave for good
  float pressureDensity;  // kg/m^3, of the densest fluid, that makes a pressure of a multiplier over the square of the step
  float bodySpeed;        // m/s, the fastest point of a body at the start
  float separationSpeed;  // m/s, at which bodies that overlap come apart, at most
  float spacing;          // m
  float support;          // m, the kernel's support radius h
  float inverseSupport;   // 1/m
  float valueScale;       // of the kernel's polynomial
  float liquidExcess;     // by how much of it a liquid's sum is scaled more than the lattice's
  float inverseMeltingTime;  // 1/s, 1 over the time in which a fill becomes a liquid; 0: it does not
  float gradientScale;    // of its gradient's polynomial, negative, 1/m^2 (see kernel.glsl)
  float inverseRestGradient;  // 1 / sum |grad K|^2 of the rest lattice, m^2
  float regularization;   // epsilon times sum |grad K|^2 of the rest lattice, 1/m^2
  float relaxationAtRest, relaxationInMotion;  // omega of a fluid at rest, and of one that moves at motionSpeed (see gains.glsl)
  float warmGainInMotion;      // kappa of a fluid that moves; at rest see stability.glsl
  float maxWarmGainAtRest;     // at most, and
  float layerWarmGainAtRest;   // this over the square of the column's layers
  float layerHead;             // m^2/s^2, gravity times the spacing
  float motionShare;           // motionSpeed over the speed of falling through the column
  float stableStep;            // m, over the square root of the head: the longest stable step
  float toleratedStep;         // m, likewise: the first step, half of what the tolerance allows
  float columnGravityX, columnGravityY, columnGravityZ;  // m/s^2, the strongest; 0: the head does not follow the fluid along this axis
  float columnLimitX, columnLimitY, columnLimitZ;        // m, the largest height of a column
  float warmRelease;      // times kappa where density is below rest density
  float reach;            // m, the longest of all supports plus skin: the list holds what was nearer when it was built
  float nearReach;        // m, the kernel's support plus skin; less than `reach` with surface tension
  float travelLimit;      // m that the fastest particle may move before the list is rebuilt, in motion
  float cfl;              // spacings a substep
  float maxStep;          // s, as the scene asks for; see stability.glsl
  float tolerance;        // mean compression aimed for; 0: none
  uint maxSubsteps;       // an advance
  uint iterations;        // Jacobi iterations a substep, at most
  float lowX, lowY, lowZ;     // m, walls; -kNoWall without a wall
  float highX, highY, highZ;  // m; kNoWall without a wall
  float margin;           // m, how near a center may come to a wall or a solid: half a spacing
  uint gridSizeX, gridSizeY, gridSizeZ;  // cells a dimension
  float inverseCell;      // 1/m, in y and z
  float tableStep;        // m between nodes of the tables
  uint tableNodes;        // of the half-space's table, which comes first
  uint noSlipTable;       // entries before the table of engine/sph/no_slip.hpp, of the same nodes; 0: no solid needs it
  float viscosityRate;    // of the force of pairs a second of step, 1/s: see engine/sph/viscosity.hpp
  uint viscositySteps;    // of the solve for viscosity, at most
  float noiseDampingRate;      // coefficient of noise damping a second of block, in a fluid at rest, 1/s
  float tensionRate;      // 1/s^2, of the force of a sample of the surface on a particle: see engine/sph/surface_tension.hpp
  float tensionWall;      // m/s^2, the same where the sample's weight changes by 1 in a spacing
  float wettingCosine;    // of the contact angle
  float deepNeighbors;    // within `reach`: a particle away from any surface has at least so many
  float vorticity;        // dimensionless
  float drag;             // 1/s
  // artificial pressure, 1/s^2: times the square of the step it is a multiplier over 1 / D of the
  // rest lattice; see engine/sph/artificial_pressure.hpp
  float tensileRate;
  float tensileLimit;     // and at most this
  float tensilePower;     // n
  float tensileInverse;   // 1 / K(delta q)
  float tensileLeast;     // K / K(delta q) of neighbors at rest
  float particleMass;     // kg; of the densest of several fluids
  uint gravityChanges;    // entries of the schedule
  float farLimit;         // m from the origin beyond which a particle becomes inactive
  float nearLimit;        // m from a solid's surface within which a particle is listed as near
  float solidSpeed;       // m/s, the fastest solid that keyframes move
  float minSpeedGain, maxSpeedGain;  // m/s: what a correction may add to a speed in a substep is held between them
  float speedLimit;       // m/s, of any particle
  float momentum;         // in a flow; 0 with several iterations
  float warmLimit;        // m^2/s^2: the warm start is at most this times the step squared
  float boundLowX, boundLowY, boundLowZ;     // m, the domain, open sides too: particles beyond it count as outside
  float boundHighX, boundHighY, boundHighZ;
  // iterations that find the pressure of the start (see engine/sph/start_pressure.hpp); 0: it
  // starts without
  uint initialPressureIterations;
  float initialPressureStep;        // s, the step that it is found for
  float initialPressureMomentum;    // of a multiplier's last change, what is added to the next
  float initialPressureErrorLimit;       // mean compression of the start up to which it is looked for
  uint fullNeighbors;    // within the support: a particle with as many is inside the fluid
  uint commandCount;     // dispatches that the device switches on and off
  float loadLever;       // m, unit length of the moments in the sums of solids
  float solidSpeedInCfl; // share of the speed of solids that the step follows: 1 where their walls may be thin
  uint sleeps;            // 1: fluid at rest takes no substeps; see docs/notes/sleep.md
  uint wakes;             // times in which something moves that is known beforehand; behind the gravity schedule
  float sleepLength;      // m, the longest wave that the fluid can have, over 2
  float kinematicViscosity;  // m^2/s; the largest of several fluids
  uint regionsX, regionsY, regionsZ;  // that fall asleep on their own, a dimension; 0: none do
  // Of several fluids: 1 over a particle's mass, and viscosity, over those of the densest and of the most viscous one.
  float inverseMass0, inverseMass1, inverseMass2, inverseMass3, inverseMass4, inverseMass5, inverseMass6, inverseMass7;
  float viscosity0, viscosity1, viscosity2, viscosity3, viscosity4, viscosity5, viscosity6, viscosity7;
  // Of the fluids that diffuse: their indices (kNoFluid: none), rates over the sum of engine/sph/diffusion.hpp, 1/s, and the largest rate.
  uint diffusing0, diffusing1, diffusing2, diffusing3;
  float diffusionRate0, diffusionRate1, diffusionRate2, diffusionRate3;
  float maxDiffusionRate;
  uint diffusionStages;   // of a step of diffusion, at most: 1 or even
  // Surface tension of each fluid over the largest.
  float tension0, tension1, tension2, tension3, tension4, tension5, tension6, tension7;
  // m_ab of engine/sph/interface_tension.hpp, a row for each a, two of them a word.
  uint cover0A, cover0B, cover0C, cover0D;
  uint cover1A, cover1B, cover1C, cover1D;
  uint cover2A, cover2B, cover2C, cover2D;
  uint cover3A, cover3B, cover3C, cover3D;
  uint cover4A, cover4B, cover4C, cover4D;
  uint cover5A, cover5B, cover5C, cover5D;
  uint cover6A, cover6B, cover6C, cover6D;
  uint cover7A, cover7B, cover7C, cover7D;
  // Where shear changes viscosities (engine/sph/shear_viscosity.hpp), of each fluid: yield stress, 1/s, and consistency, s^(n-1), over the
  // largest viscosity; flow index less 1.
  float yield0, yield1, yield2, yield3, yield4, yield5, yield6, yield7;
  float consistency0, consistency1, consistency2, consistency3, consistency4, consistency5, consistency6, consistency7;
  float thinning0, thinning1, thinning2, thinning3, thinning4, thinning5, thinning6, thinning7;
  float shearMoment;      // sum of weights times q^4 of the rest lattice
  float shearBound;       // of the eigenvalues of the solve for viscosity, by which a particle's is bounded
};
RILL_CONST uint kNoFluid = 0xFFFFFFFFu;

// Phases of the solver; the two before time begins need no step in time.
RILL_CONST uint kPhaseAdvancing = 0u;
RILL_CONST uint kPhaseSettling = 1u;          // particles that overlap at the start part without gaining speed
RILL_CONST uint kPhaseInitialPressure = 2u;   // the hydrostatic pressure is solved for; nothing moves

// States of the neighbor list.
RILL_CONST uint kListValid = 0u;
RILL_CONST uint kListDue = 1u;                // it must be rebuilt before the next substep
RILL_CONST uint kListNone = 2u;               // there has been none yet

// States of the fluid; see shaders/fluid/sleep.glsl.
RILL_CONST uint kAwake = 0u;
RILL_CONST uint kFallingAsleep = 1u;          // from the advance on that has begun
RILL_CONST uint kAsleep = 2u;

// Decided on the device, substep by substep; read as a uniform block by the passes, written by
// control.glsl and begin.comp.
struct FluidControl {
  uint count;          // particles: the first entries of the arrays, inactive ones among them. First, for hosts that read it alone
  float step;          // s, of the substep that control.glsl has accounted for last; 0 before time begins
  float nextStep;      // s, of the one whose prediction is at hand or is about to be made
  float warmStep;      // s, the step that the stored multipliers are expressed for
  float timeLeft;      // s of the advance
  float timeHigh;      // simulated time, s, as the sum of two floats
  float timeLow;
  float timeDropped;   // s, of the advance
  float travel;        // m that the fastest particle moved since the list was built
  float speed;         // m/s, the fastest particle
  float flowSpeed;     // m/s, which tells flow from rest: that speed, or kFlowTimes the root mean square if that is less
  float error;         // mean compression of the last prediction
  float gravityX, gravityY, gravityZ;  // m/s^2, for the prediction of the next substep
  uint listState;      // kListValid, kListDue or kListNone
  uint substeps;       // of the advance
  uint iterations;     // of the advance
  uint builds;         // list builds of the advance
  uint gravityIndex;   // next entry of the schedule
  float desiredStep;   // s, what cfl and tolerance ask for, before it is fitted to the advance; in fluid at rest a mean over many steps
  uint running;        // the next density pass runs
  uint again;          // so does the next iteration
  float relaxation, nextRelaxation;  // omega of this substep, and of the next, whose density pass comes before control.glsl
  float warmGain, nextWarmGain;      // kappa, likewise
  float errorRate;     // mean compression over the step's square, 1/s^2; in fluid at rest a mean over many steps
  float restFraction;      // 1: at rest, 0: at motionSpeed or faster
  float noiseDamping;       // coefficient of noise damping after this substep; 0: its passes do not run
  uint coherenceKnown;      // 1: they have run in this block, so that it is known what of the particles' motion is flow
  float head;          // m^2/s^2, gravity times the height of the column that the fluid has stood in so far
  float artificialPressure;       // artificial pressure of this substep, over 1 / D of the rest lattice
  float blockTime;     // s since the last substep that was the first of its block
  uint phase, nextPhase;  // of the substep that control.glsl has accounted for last, and of the next, as with step and nextStep
  uint phaseLeft;      // substeps of the next phase left, at most; 0 while time advances
  float solidSpeed;    // m/s, the fastest solid of the advance, but for bodies
  float bodySpeed;     // m/s, the fastest point of a body
  uint pulls;          // springs of the host that pull bodies in the advance
  float emitterSpeed;  // m/s, of the fastest emitter of the advance
  float emissionWait;  // s until a layer is so late that the list is rebuilt for it; kNever without emitters
  // Since the start, what prepares it too: for the host, which takes differences. The noise damping
  // pass runs in the first substeps of blocks.
  uint executedSubsteps, executedIterations, executedBuilds, executedNoiseDampings;
  uint sleep;          // kAwake, kFallingAsleep or kAsleep
  float restShare;     // share of the time at rest after which the fluid may fall asleep; 0 in motion
  float timeAsleep;    // s of the advance
  uint executedFallsAsleep;  // since the start, as executedSubsteps
  uint solved;         // particles that substeps are over, the first of `count`; the others are in regions asleep
  float sleepStep;     // s, the step that the multipliers of the others are expressed for
  float regionTime;    // s since regions were looked at
  uint wakesAll;       // 1: gravity has changed since
  uint regionsDue;     // 1: they are to be looked at before the next substep
  uint acts;           // 1: an emitter, a drain or something else known beforehand acts
  float diffusion;     // s that diffusion after this substep is for; 0: its passes do not run
  float diffusionTime; // s since it ran last
  uint executedDiffusions;  // since the start, as executedSubsteps
};

// Sums of the passes of one substep; integers, so that their order does not matter.
struct FluidSums {
  uint errorLow, errorHigh;  // 64-bit sum of compression in units of kErrorUnit
  uint errorMax;             // bits of the largest compression
  uint speedMax;             // bits of the largest speed
  uint nonFinite;            // particles that became inactive since the start
  uint overflow;             // particles with more entries than the list holds, at the last build
  uint boundHits;            // loops cut at their bound since the start
  uint nearSolids;           // particles near a solid, at the last build
  uint nearMouths;           // particles near an emitter's mouth, likewise
  uint bodySpeed;            // bits of the largest speed of a body's points
  // of the active particles inside the domain, at the last build: how many, and of their places
  // above its lower bounds, in spacings over kColumnUnits, the least, the largest and the 64-bit sum
  uint columnCountX, columnCountY, columnCountZ;
  uint columnLowX, columnLowY, columnLowZ;
  uint columnHighX, columnHighY, columnHighZ;
  uint columnSumLowX, columnSumLowY, columnSumLowZ;
  uint columnSumHighX, columnSumHighY, columnSumHighZ;
  uint asleep;               // particles in regions that sleep, at the last build
  uint viscosityBound;       // bits of a bound of the eigenvalues of the last solve for viscosity
  uint viscositySteps;       // of it, and what they follow from (shared/viscosity_steps.h)
  float viscosityCenter, viscosityHalfWidth, viscosityDecay;
  uint viscosityBoundHits;   // solves since the start that needed more than FluidParams::viscositySteps
  uint motionLow, motionHigh;  // 64-bit sum of squared speeds over gravity times spacing, in kMotionUnit
  uint diffusionRow;         // bits of the largest sum of a particle's weights in the last step of diffusion
  uint diffusionStages;      // of it
  float diffusionStep;       // s, the time that each is for
  uint diffusionBoundHits;   // steps since the start that needed more than FluidParams::diffusionStages
  uint viscosityCapped;      // particles whose viscosity by shear was more than the last solve reaches
  uint inReach;              // particles in reach of solids (fluid/solid_reach.glsl), as they are counted
  uint reached;              // the same of the substep whose correction has begun
  uint stoppedLow, stoppedHigh;  // 64-bit sum: of the motion above, what solids stopped in the same substep
  uint fast;                 // particles faster than any at rest, less those that solids stopped in the same substep
};
RILL_CONST float kRestMaxSpeed = 0.15f;  // of the fastest particle at rest, over the speed of a fall through a spacing
RILL_CONST float kMotionUnit = 1.0f / 67108864.0f;
RILL_CONST float kMaxMotion = 32.0f;  // what one particle adds, at most
RILL_CONST float kFlowTimes = 4.0f;   // the fastest particle of a flow is about so many times as fast as the root mean square
RILL_CONST float kColumnUnits = 16.0f;
RILL_CONST uint kMaxColumnPlace = (1u << 18) - 1u;
RILL_CONST float kErrorUnit = 1.0f / 16777216.0f;

RILL_RECORDS_END
#endif
