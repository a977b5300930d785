#pragma once
#include <array>

#include "rill/graph.hpp"
#include "rill/offline.hpp"
#include "rill/surface_mesher.hpp"

namespace rill::offline {

/// Read-backs of a mesh.
struct MeshTickets {
  Ticket positions, normals, velocities, indices, counts;
};

/// What a complete mesh needs, and the mesh; empty where it had no room.
struct MeshReadout {
  SurfaceTriangles triangles;
  SurfaceMesherDesc needed;  ///< its limits alone
};

MeshTickets meshReadout(Graph& graph, const SurfaceMesh& mesh);
/// The frame must have completed. `origin`: of the fluid's state, m.
MeshReadout collect(const Graph& graph, const MeshTickets& tickets, const Double3& origin);

bool fits(const SurfaceMesherDesc& needed, const SurfaceMesherDesc& limits);
/// Limits with room for what is needed and a quarter more.
SurfaceMesherDesc roomFor(const SurfaceMesherDesc& needed, const SurfaceMesherDesc& limits);

}  // namespace rill::offline
