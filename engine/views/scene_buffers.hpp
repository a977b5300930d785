#pragma once
// What of a scene is drawn beside the fluid, on the device.
#include "gpu/resources.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "views/particle_scene.hpp"

namespace rill {

/// Makes the shaders of engine/views known to the device: the engine's own library is without them.
void bringViewShaders(Device& device);

struct SceneBuffers {
  static Expected<SceneBuffers> create(Device& device, ParticleScene host);

  BufferRef importScene(Graph& graph) const;
  BufferRef importLines(Graph& graph) const;
  BufferRef importKeyframes(Graph& graph) const;
  /// PlacedSolids (there are some) at the push's time, seen with its camera; of driven ones as `fluid` has them.
  BufferRef addPoses(Graph& graph, const FluidState& fluid, BufferRef scene, const particle_view::ViewPush& push) const;

  ParticleScene host;
  Buffer scene, solids, keyframes, lines;
  const ComputePipeline *poses = nullptr, *drivenPoses = nullptr;
};

}  // namespace rill
