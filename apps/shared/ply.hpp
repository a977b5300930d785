#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "rill/expected.hpp"
#include "rill/offline.hpp"

namespace rill::apps {

/// Particles as binary little-endian PLY: float x y z vx vy vz density, uint id and, in a scene with several fluids, uchar fluid a vertex;
/// the time in seconds is in a comment.
std::vector<std::byte> encodePly(const offline::Particles& particles, double time_s);

/// Writes that to a file, atomically. Io, with the name of the file.
Expected<void> writePly(const std::filesystem::path& file, const offline::Particles& particles, double time_s);

/// Diffuse particles likewise: float x y z vx vy vz age (s), uchar class (0 spray, 1 foam, 2 bubble).
std::vector<std::byte> encodeWhitewaterPly(const offline::DiffuseParticles& particles, double time_s);
/// Reads that, or any PLY with these properties; `age` may be missing. BadInput naming the file, what was found and what was expected.
Expected<offline::DiffuseParticles> readWhitewaterPly(const std::filesystem::path& file);

}  // namespace rill::apps
