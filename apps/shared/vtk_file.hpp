#pragma once
// XML files of VTK, as ParaView reads them.
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rill/offline.hpp"

namespace rill::apps {

/// A mesh as PolyData, with the arrays Normals and velocity (m/s) at points.
std::vector<std::byte> encodeVtp(const offline::SurfaceTriangles& mesh, double time_s);
/// Particles as an UnstructuredGrid of vertex cells, with the arrays velocity (m/s), density (kg/m^3), id and, in a scene with
/// several fluids, fluid.
std::vector<std::byte> encodeVtu(const offline::Particles& particles, double time_s);
/// Diffuse particles likewise, with the arrays velocity, age (s), random (below 2^24) and class (0 spray, 1 foam, 2 bubble).
std::vector<std::byte> encodeWhitewaterVtu(const offline::DiffuseParticles& particles, double time_s);
/// A .pvd file, which lists the files of a series with their times (s).
std::string encodePvd(std::span<const std::pair<double, std::string>> files);

}  // namespace rill::apps
