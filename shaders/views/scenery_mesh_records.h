// Records of the meshes that are drawn as triangles, shared with C++.
#ifndef RILL_SCENERY_MESH_RECORDS_H
#define RILL_SCENERY_MESH_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// In the frame of the solid.
struct MeshTriangle {
  float corners[9];        // m
  uint normals[3];         // of the corners: octahedral, two signed numbers of 16 bits (Cigolle et al. 2014)
  float red, green, blue;  // base color, linear
};

// The mesh of a solid.
struct MeshPart {
  uint solid;     // its number in the scene
  uint first;     // triangle
  uint twoSided;  // 1: shaded from both sides
  uint colored;   // 1: the triangles have colors
};

RILL_RECORDS_END
#endif
