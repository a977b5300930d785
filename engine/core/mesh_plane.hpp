#pragma once
#include "rill/mesh.hpp"

namespace rill {

/// The plane of a mesh's triangles.
struct MeshPlane {
  Double3 center = {0, 0, 0};        ///< m, centroid of the triangles
  Double3 normal = {0, 0, 0};        ///< mean of theirs, weighted by area, unit length; zero if they have none
  double total = 0;                  ///< m^2, of the triangles; 0 if no more than rounding
  double area = 0;                   ///< m^2, of the triangles in the plane; those that face against the normal count against it
  double size = 0;                   ///< m, diagonal of the box along the axes that holds the triangles
  double offPlane = 0;               ///< m, largest distance of a corner from the plane
  Double3 farthest = {0, 0, 0};      ///< that corner, m
  double against = 0;                ///< m^2, of triangles that face against the normal
  Double3 firstAgainst = {0, 0, 0};  ///< m, middle of the first of them
};
/// `data`: with indices in range.
MeshPlane planeOf(const MeshData& data);

}  // namespace rill
