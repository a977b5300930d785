// The field of a mesh on the device: signed distances and density factors at the nodes of a grid that is fine near the surface
// (engine/sph/mesh_field.hpp). Words of 32 bits: a header, the distances at the corners of all blocks, for each block
// where its nodes begin, and the nodes. Offsets count from the header.
#ifndef RILL_MESH_FIELD_H
#define RILL_MESH_FIELD_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kFieldCells = 4u, kFieldNodes = 5u;  // cells and nodes along a block
// Words of the header; lengths are floats in m, the low corner and the edge of a block among them.
RILL_CONST uint kFieldBlocks = 0u, kFieldLow = 3u, kFieldEdge = 6u, kFieldCorners = 7u, kFieldFine = 8u, kFieldRange = 9u;
RILL_CONST uint kFieldHeader = 10u;
RILL_CONST uint kFieldCoarse = 0u;  // where the nodes of a block begin that has none
// A node: the distance over the range and the factor's excess over 1 over kFieldFactorRange, as two signed numbers of 16 bits.
RILL_CONST float kFieldFactorRange = 3.0;

RILL_RECORDS_END
#endif
