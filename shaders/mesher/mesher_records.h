// Constants of the surface mesher and what its passes share. Lengths are in spacings.
#ifndef RILL_MESHER_RECORDS_H
#define RILL_MESHER_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// The field: engine/reference/surface_mesh.hpp. Chosen by volume and smoothness of lattices, with and without jitter.
RILL_CONST float kMeshFitRadius = 2.0f;      // particles within it shape a particle's ellipsoid
RILL_CONST float kMeshStretch = 1.75f;       // of the ellipsoids of a plane surface, along it
RILL_CONST float kMeshFlat = 0.35f;          // ratio of variances across and along, up to which the stretch is whole
RILL_CONST float kMeshRound = 0.8f;          // the same ratio, at and above which an ellipsoid is a ball
RILL_CONST float kMeshAlong = 0.2f;          // variance, in squared spacings, from which there are particles along an axis
RILL_CONST float kMeshSheetSum = 0.66f;      // sum of kernels at a particle below which its amplitude is raised: drops, threads, rims
RILL_CONST float kMeshPower = 1.5f;          // by this power of the ratio
RILL_CONST float kMeshMaxAmplitude = 2.6f;   // of a particle alone: its drop has the volume of the spacing's cube
RILL_CONST float kMeshRim = 0.7f;            // more amplitude at the rim of a sheet: a spacing of offset of the neighbors' mean along it,
RILL_CONST float kMeshRimOffset = 0.15f;     // beyond this one
RILL_CONST float kMeshDeepOffset = 0.15f;    // a particle whose neighbors' mean is farther away is near the surface,
RILL_CONST float kMeshDeepWeight = 12.0f;    // or one with a smaller sum of weights
RILL_CONST float kMeshReach = 2.625f;        // 1.5 kMeshStretch: largest radius of an ellipsoid's support
RILL_CONST float kMeshEdgeMargin = 0.001f;   // vertices keep this part of an edge from its ends
RILL_CONST uint kMeshSweeps = 4u;            // of the iteration for eigenvectors
RILL_CONST uint kMeshMaxVisits = 4096u;      // particles that one sum looks at
RILL_CONST uint kMeshMaxListed = 96u;        // of the list of a bin
RILL_CONST uint kMeshListedPerParticle = 96u;  // entries of all lists that have room: water in motion has 40, a thin sheet 90
RILL_CONST uint kMeshMaxNearBins = 1u << 25; // with lists: the number of their entries fits in a word

// The grid: bins of whole cells, at least a spacing wide; blocks of 4 x 4 x 4 bins.
RILL_CONST uint kMeshGroup = 64u;        // invocations of a workgroup
RILL_CONST uint kMeshBlockBins = 64u;    // bins of a block
RILL_CONST uint kMeshNeighbors = 27u;    // blocks around a block, itself among them: 9 x + 3 y + z, each 0 to 2
RILL_CONST uint kMeshNone = 0xffffffffu; // no block, no key
RILL_CONST uint kMeshHalfX = 1024u;      // blocks on each side of the origin along x and z
RILL_CONST uint kMeshHalfY = 512u;       // along y

// States of a bin.
RILL_CONST uint kMeshOutside = 0u;  // its corners are outside the fluid
RILL_CONST uint kMeshNear = 1u;     // near the surface: the field is summed at its corners
RILL_CONST uint kMeshInside = 2u;

// Words of the counts: a VkDrawIndexedIndirectCommand, then what a host reads.
RILL_CONST uint kMeshIndexCount = 0u;
RILL_CONST uint kMeshInstances = 1u;
RILL_CONST uint kMeshVertices = 5u;         // of the mesh
RILL_CONST uint kMeshVerticesNeeded = 6u;   // and what there has to be room for
RILL_CONST uint kMeshTrianglesNeeded = 7u;
RILL_CONST uint kMeshBlocksNeeded = 8u;
RILL_CONST uint kMeshOccupied = 9u;   // blocks with particles
RILL_CONST uint kMeshTooFar = 10u;    // particles outside the grid
RILL_CONST uint kMeshBoundHits = 11u; // sums that kMeshMaxVisits has cut off
RILL_CONST uint kMeshNearBins = 12u;  // not for hosts: bins near the surface,
RILL_CONST uint kMeshListed = 13u;    // and entries of their lists
RILL_CONST uint kMeshCountWords = 14u;

// Dispatch arguments, three words each.
RILL_CONST uint kMeshNeighborGroups = 0u;
RILL_CONST uint kMeshBinGroups = 3u;
RILL_CONST uint kMeshNearGroups = 6u;
RILL_CONST uint kMeshRowGroups = 9u;
RILL_CONST uint kMeshVertexGroups = 12u;
RILL_CONST uint kMeshOutputGroups = 15u;  // rows, if all of the mesh has room
RILL_CONST uint kMeshCornerGroups = 18u;  // of bins near the surface
RILL_CONST uint kMeshArgumentWords = 21u;

struct MeshPush {
  float spacing;  // m
  float cell;     // spacings
  uint capacity;  // keys that a pass is over: particles that the mesher has room for, or keys of blocks
  uint particles; // of the state at most
  uint max_blocks;
  uint max_vertices;
  uint max_triangles;
  uint max_listed;
  uint list;      // of mesh compact: the word of the counts
  uint velocities;  // 0: there are none
};

RILL_RECORDS_END
#endif
