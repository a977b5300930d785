#pragma once
// What is behind rill::ParticleView: its pipelines, and the passes of a frame in the order in which they run.
#include "gpu/resources.hpp"
#include "views/particle_view.hpp"
#include "views/scene_buffers.hpp"

namespace rill {

class ParticleViewImpl {
 public:
  Expected<void> create(Device& device, const Scene& scene, const ParticleSet& particles);
  BufferRef addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time);

  SceneBuffers buffers_;
  const ParticleScene& scene_ = buffers_.host;

 private:
  /// The buffers of one frame, each in its current version.
  struct Frame {
    particle_view::ViewPush push;
    uint64_t pixels = 0;
    BufferRef scene, poses, edges, depth, winner, light, floor, tint, position, velocity, counters, survivors;
    BufferRef tiles, shaded, rims, picture;
  };

  particle_view::ViewPush pushConstants(const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time) const;
  void addSetup(Graph& graph, const FluidState& fluid, Frame& frame) const;
  void addSurfaces(Graph& graph, Frame& frame) const;
  void addLightMap(Graph& graph, Frame& frame) const;
  BufferRef addSolidMasks(Graph& graph, const Frame& frame, bool light) const;
  void addVisibility(Graph& graph, Frame& frame) const;
  void addSplat(Graph& graph, Frame& frame, bool winners) const;
  void addTint(Graph& graph, Frame& frame) const;
  void addFloorShadow(Graph& graph, Frame& frame) const;
  void addClassify(Graph& graph, Frame& frame) const;
  void addShade(Graph& graph, Frame& frame) const;
  void addArguments(Graph& graph, Frame& frame) const;

  uint64_t lightTexels() const { return uint64_t{scene_.scene.counts.y} * scene_.scene.counts.z; }
  bool hasFloor() const { return scene_.scene.domain_min.w > 0 && (scene_.scene.counts.w & 4u) != 0; }
  bool hasShadows(const Frame& frame) const { return frame.push.count > 0 || scene_.scene.counts.x > 0; }

  const ComputePipeline *edges_ = nullptr, *solidTiles_ = nullptr, *lightTiles_ = nullptr, *surfaces_ = nullptr, *floor_ = nullptr;
  const ComputePipeline *lightSolids_ = nullptr, *project_ = nullptr, *cull_ = nullptr, *arguments_ = nullptr, *splat_ = nullptr,
                        *splatLarge_ = nullptr;
  const ComputePipeline *floorShadow_ = nullptr, *tint_ = nullptr, *classify_ = nullptr, *shadeFluid_ = nullptr, *shadeFloor_ = nullptr;
  const ComputePipeline *shadeSky_ = nullptr, *shadeSolids_ = nullptr, *resolve_ = nullptr, *drawEdges_ = nullptr;
};

}  // namespace rill
