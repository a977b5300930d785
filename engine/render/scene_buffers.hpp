#pragma once
// What of a scene is drawn beside the fluid, on the device.
#include "gpu/resources.hpp"
#include "render/particle_scene.hpp"
#include "rill/graph.hpp"

namespace rill {

struct SceneBuffers {
  static Expected<SceneBuffers> create(Device& device, ParticleScene host);

  BufferRef importScene(Graph& graph) const;
  /// PoseRecords of the solids (there are some) at the push's time, seen with its camera.
  BufferRef addPoses(Graph& graph, BufferRef scene, const particle_view::ViewPush& push) const;

  ParticleScene host;
  Buffer scene, solids, keyframes;
  const ComputePipeline* poses = nullptr;
};

}  // namespace rill
