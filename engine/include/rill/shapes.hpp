#pragma once
// Shapes of solids and fills in a scene (rill/scene.hpp). SI units.
//
//   const rill::BoxShape crate{{0.4, 0, 0.4}, {0.6, 0.2, 0.6}};
//   const rill::SphereShape ball{.center = {1, 0.5, 0.5}, .radius = 0.1};
//   rill::MeshShape bunny{.file = "/models/bunny.stl", .scale = 0.001};  // a file in millimeters
#include <cstdint>
#include <filesystem>
#include <memory>
#include <variant>

#include "rill/mesh.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// An axis-aligned box.
struct BoxShape {
  Double3 min = {0, 0, 0}, max = {1, 1, 1};  ///< corners, m; max above min on every axis
};
/// A sphere.
struct SphereShape {
  Double3 center = {0, 0, 0};  ///< m
  double radius = 1;           ///< m, > 0
};

/// The axis of a mesh file that points up.
enum class UpAxis : uint8_t { Y, Z };

/// A triangle mesh. Its frame is that of the file after `up` and `scale`; its center is the origin of this frame.
struct MeshShape {
  std::filesystem::path file = {};  ///< OBJ, STL, PLY, glTF or GLB; an absolute path once the scene is loaded; empty: `mesh` is the host's
  double scale = 1;                 ///< m per unit of the file, > 0
  UpAxis up = UpAxis::Y;
  bool two_sided = false;                 ///< a sheet: a shell that reaches half a spacing to each side
  std::shared_ptr<const Mesh> mesh = {};  ///< in m; read from `file` by loadScene(), or the host's
};

/// The shape of a solid.
using Shape = std::variant<BoxShape, SphereShape, MeshShape>;

}  // namespace rill
