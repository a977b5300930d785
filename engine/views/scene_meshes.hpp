#pragma once
// The meshes among a scene's solids as triangles on the device, for graphics passes.
#include "gpu/resources.hpp"
#include "render/surface.hpp"
#include "rill/graph.hpp"
#include "rill/scene.hpp"

namespace rill {

class SceneMeshes {
 public:
  /// Solids with the same mesh share its triangles. The scene is not kept. BadInput where they are larger than a buffer of the device.
  static Expected<SceneMeshes> create(Device& device, const Scene& scene);

  bool empty() const { return vertices_.empty(); }
  struct Refs {
    BufferRef parts, triangles;
  };
  Refs addTo(Graph& graph) const;
  /// Draws all of them with a pipeline of views/scenery_mesh_vertex.
  void draw(Commands& commands, Kernel kernel, const surface::SurfacePush& push) const;

 private:
  std::vector<uint32_t> vertices_;  ///< of each part: how many to draw
  Buffer parts_, triangles_;
};

}  // namespace rill
