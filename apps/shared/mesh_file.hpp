#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "rill/offline.hpp"

namespace rill::apps {

enum class MeshFormat : uint8_t { Ply, Obj, Glb, Vtp };

/// Of its name: ply, obj, glb or vtp.
std::optional<MeshFormat> meshFormat(std::string_view name);
/// Of files: "mesh.ply" and so on.
const char* meshExtension(MeshFormat format);

/// A mesh as a file, in the scene's axes (y up) and m.
/// ply: binary little-endian, floats x y z nx ny nz vx vy vz a vertex, and the time in seconds in a comment. obj: text, without velocities.
/// glb: glTF 2.0 with the attribute _VELOCITY. vtp: VTK's PolyData with the arrays Normals and velocity.
/// TooLarge for a mesh that the format cannot hold.
Expected<std::vector<std::byte>> encodeMesh(const offline::SurfaceTriangles& mesh, double time_s, MeshFormat format);

}  // namespace rill::apps
