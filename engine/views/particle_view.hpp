#pragma once
// Particles as shaded spheres in their tank, drawn by compute passes into a storage buffer.
#include <cstdint>
#include <memory>

#include "graph/shader_pass.hpp"
#include "render/particle_count.hpp"
#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"
#include "views/camera.hpp"
#include "views/color_map.hpp"
#include "views/scene_buffers.hpp"

namespace rill {

/// What a picture of the particles looks like.
struct ParticleViewDesc {
  uint32_t width = 1280;  ///< pixels, 1 .. 8192
  uint32_t height = 720;  ///< pixels, 1 .. 8192; width x height is at most 2^25
  ParticleColor color = ParticleColor::Speed;
  /// Particles have the exact color of the legend, without lighting or shadows; the surroundings are darker than any color of a map.
  bool unlit = false;
  double scale_max = 0;  ///< value at the color map's end (m/s, or fraction of rest density); 0: ParticleView::scaleMax(color)
};

/// Draws spheres of half a spacing's radius, the domain's floor, walls and edges, and the solids.
/// Bitwise deterministic per driver.
class ParticleView {
 public:
  /// Copies the domain, the solids and the light's frame to the device. `particles`, the start, defines the color scales and the origin.
  /// Scene and particles are not kept.
  static Expected<std::unique_ptr<ParticleView>> create(Device& device, const Scene& scene, const ParticleSet& particles);

  /// BadInput for a picture that is empty or too large, with the limits. Needs no device.
  static Expected<void> check(const ParticleViewDesc& desc);

  /// Declares the passes of one picture; `desc` must pass check(). The returned buffer holds width x height pixels, RGBA8 in sRGB with
  /// alpha 255, rows from the top. `time_s`: simulated time of the solids' poses, at 0 nothing is
  /// drawn asleep. Without particles the state's buffers are not used.
  BufferRef addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time_s) const;

  /// The value at a color map's end, fixed by the scene so that colors do not flicker: for speed, sqrt(2 g H) of the fall from the
  /// fluid's top at the start to the tank's floor, for compression ten times the solver's tolerance, each rounded to a round number.
  double scaleMax(ParticleColor color) const;

 private:
  /// The buffers of one frame, each in its current version.
  struct Frame {
    particle_view::ViewPush push;
    uint64_t pixels = 0;
    BufferRef scene, poses, edges, depth, winner, light, floor, tint, position, velocity, concentration, counters, survivors;
    BufferRef meshWords;         ///< of the fluid, if the view can draw its meshes
    CountedParticles particles;  ///< without any, empty
    BufferRef masks, occluders, tiles, shaded, rims, picture;
  };

  particle_view::ViewPush pushConstants(const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc,
                                        double time_s) const;
  void addSetup(Graph& graph, const FluidState& fluid, Frame& frame) const;
  void addSurfaces(Graph& graph, Frame& frame) const;
  void addLightMap(Graph& graph, Frame& frame) const;
  void addSolidMasks(Graph& graph, Frame& frame, bool light) const;
  void addVisibility(Graph& graph, Frame& frame) const;
  void addSplat(Graph& graph, Frame& frame, bool winners) const;
  void addTint(Graph& graph, Frame& frame) const;
  void addFloorShadow(Graph& graph, Frame& frame) const;
  void addClassify(Graph& graph, Frame& frame) const;
  void addShade(Graph& graph, Frame& frame) const;
  void addArguments(Graph& graph, Frame& frame) const;
  /// A pass of one dispatch over the frame's buffers.
  void add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& frame) const;

  const ParticleScene& scene() const { return buffers_.host; }
  uint64_t lightTexels() const { return uint64_t{scene().scene.counts.y} * scene().scene.counts.z; }
  bool hasFloor() const { return scene().scene.domain_min.w > 0 && (scene().scene.counts.w & 4u) != 0; }
  bool hasShadows(const Frame& frame) const { return frame.push.count > 0 || scene().scene.counts.x > 0; }

  /// Kernels that meet solids with rays. Those of `meshRays_` know the fields of meshes; without meshes they are null.
  struct RayKernels {
    const ComputePipeline *surfaces = nullptr, *lightSolids = nullptr, *shadeSolids = nullptr;
  };
  const RayKernels& rays(const Frame& frame) const { return frame.meshWords != BufferRef{} ? meshRays_ : rays_; }

  SceneBuffers buffers_;
  RayKernels rays_, meshRays_;
  const ComputePipeline *edges_ = nullptr, *solidTiles_ = nullptr, *lightTiles_ = nullptr, *floor_ = nullptr;
  const ComputePipeline *particleGroups_ = nullptr, *project_ = nullptr, *cull_ = nullptr, *arguments_ = nullptr, *splat_ = nullptr,
                        *splatLarge_ = nullptr;
  const ComputePipeline *floorShadow_ = nullptr, *tint_ = nullptr, *mixedTint_ = nullptr, *classify_ = nullptr, *shadeFluid_ = nullptr,
                        *shadeFloor_ = nullptr, *shadeShadowedFloor_ = nullptr;
  const ComputePipeline *shadeSky_ = nullptr, *resolve_ = nullptr, *drawEdges_ = nullptr;
};

}  // namespace rill
