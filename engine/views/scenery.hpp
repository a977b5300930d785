#pragma once
// What stands around the fluid: sky, floor, solids, the domain's edges or a glass tank, outlines of mouths and drains, drawn as graphics
// passes with shadows of solids and fluid. scenery_create.cpp: pipelines; scenery_light.cpp: sun, shadows, caustics; scenery.cpp: drawing.
#include <algorithm>
#include <memory>
#include <vector>

#include "graph/shader_pass.hpp"
#include "render/caustics.hpp"
#include "render/environment.hpp"
#include "render/surface.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"
#include "views/camera.hpp"
#include "views/glass_tank.hpp"
#include "views/scene_buffers.hpp"
#include "views/scene_meshes.hpp"

namespace rill {

class Scenery {
 public:
  /// Scene and particles are not kept; `environment` outlives it, null: the sky of Rill's own. Look::caustics of the scene counts.
  static Expected<std::unique_ptr<Scenery>> create(Device& device, const Scene& scene, const ParticleSet& particles,
                                                   const TargetFormats& formats, const Environment* environment = nullptr);

  /// Draws all of the targets anew; depth as fluidView() has it. `time_s`: where the solids are. Shadows are those that `look` casts.
  /// `texels`: of the environment, where there is one.
  SceneTargets addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view, const FluidLook& look,
                     double time_s, BufferRef texels = {}) const;
  /// Once the fluid has been drawn: what lies before it, which is glass, or edges and outlines. `pixels`: SurfaceBuffers::pixels of the
  /// whole picture; null if no fluid was drawn.
  SceneTargets addOverFluid(Graph& graph, SceneTargets targets, const FluidView& view, const FluidLook& look, double time_s,
                            BufferRef pixels, BufferRef texels = {}) const;

  Float3 toSun() const;
  /// The light map's frame.
  SunView sunView() const;

 private:
  static constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;
  static constexpr uint32_t kSolidVertices = 36;

  bool hasGround() const { return hasDomain() && (buffers_.host.scene.counts.w & 4u) != 0; }  // a floor that is closed
  bool hasDomain() const { return buffers_.host.scene.domain_min.w > 0; }
  bool hasEdges() const { return hasDomain() && buffers_.host.scene.domain_max.w > 0; }  // a tank has no grid
  bool hasMeshes() const { return !meshes_.empty(); }

  uint32_t fluidCount() const { return std::max(static_cast<uint32_t>(fluids_.size()), 1u); }

  // scenery_create.cpp
  Expected<void> makePipelines(Device& device, const TargetFormats& formats);

  // scenery_light.cpp
  surface::SurfacePush lightPush(const FluidState& fluid, const Double3& origin) const;
  ImageRef addSolidShadows(Graph& graph, BufferRef poses, const SceneMeshes::Refs& meshes, const surface::SurfacePush& light) const;
  BufferRef addCaustics(Graph& graph, const FluidState& fluid, const FluidLook& look, BufferRef thickness, double unit, ImageRef lightDepth,
                        BufferRef record) const;

  // scenery.cpp
  void addLines(Graph& graph, std::string_view name, SceneTargets& targets, const GraphicsPipeline* pipeline,
                const surface::SurfacePush& camera, double time_s, BufferRef pixels = {}) const;
  /// What is lit by the sun.
  struct Drawing {
    const GraphicsPipeline *ground = nullptr, *solid = nullptr, *mesh = nullptr;
  };
  void addSolids(Graph& graph, SceneTargets& targets, const surface::SurfacePush& camera, const Drawing& drawing,
                 std::span<const Named> lit) const;

  const Environment* environment_ = nullptr;
  std::vector<FluidBody> fluids_;  ///< of a scene with several; otherwise empty
  SceneBuffers buffers_;
  SceneMeshes meshes_;
  std::optional<GlassTank> tank_;  ///< with look.stage tank, unless all sides are open
  bool hasRayCast_ = false;        ///< there are solids that are not drawn as triangles
  SurfaceStage stage_;
  std::optional<Caustics> caustics_;  ///< where the scene has them and something to fall on
  Drawing plain_, refracted_;         ///< `refracted_`: with caustics
  const GraphicsPipeline *solidLight_ = nullptr, *edges_ = nullptr, *edgesOverFluid_ = nullptr;
  const GraphicsPipeline *lines_ = nullptr, *linesOverFluid_ = nullptr;
  const GraphicsPipeline* meshLight_ = nullptr;
};

}  // namespace rill
