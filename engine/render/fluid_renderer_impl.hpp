#pragma once
// Implementation of rill::FluidRenderer.
#include "core/impl_of.hpp"
#include "render/crests.hpp"
#include "render/environment.hpp"
#include "render/look_record.hpp"
#include "render/mean_normals.hpp"
#include "render/surface.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill {

inline constexpr uint32_t kThicknessStep = 4;  ///< pixels per side of a sample of the thickness

struct DataPush {
  surface::SurfacePush view;
  float full = 1;
};
static_assert(sizeof(DataPush) <= 128);

class FluidRendererImpl {
 public:
  Expected<void> create(Device& device, const TargetFormats& formats);
  surface::SurfacePush camera(const FluidState& fluid, const FluidView& view) const;
  Expected<void> setEnvironment(const EnvironmentPicture& picture);
  Expected<void> setFluids(std::span<const FluidBody> fluids);
  /// `ownTargets`: of the graph's own, in the default formats; what is drawn over the fluid then needs the surface's pixels without fluid,
  /// too. `texels`: of the environment, if any.
  SceneTargets addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view, const FluidLook& look,
                     bool ownTargets, BufferRef texels = {});
  BufferRef addData(Graph& graph, const FluidState& fluid, const FluidView& view, SurfaceData data, float full, SurfaceMethod method);

  DeviceImpl* device = nullptr;
  TargetFormats formats;
  std::unique_ptr<Environment> environment;  ///< null: the built-in sky
  std::vector<FluidBody> bodies;             ///< empty: one fluid, that of the look
  SurfaceStage surface;
  MeanNormals meanNormals;
  SurfaceBuffers last;  ///< of the frame being declared
  /// Of its scene, before the fluid is drawn: colors as halves, and depths of the target.
  struct SceneCopy {
    BufferRef color, depth;
  };
  SceneCopy lastScene;
  const ComputePipeline *scene = nullptr, *data[3] = {};
  CrestDepths crests;
  /// Plain, of an opaque fluid, and with light through crests.
  enum class Shade { Plain, Opaque, Crests };
  static constexpr size_t kShades = 3;
  const GraphicsPipeline* shade[kShades] = {};  ///< by Shade

 private:
  Expected<void> makeShade();
  SceneCopy copyScene(Graph& graph, const SceneTargets& targets, bool ownTargets) const;
};

}  // namespace rill
