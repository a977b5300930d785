#pragma once
// Draws foam, spray and bubbles into a picture: soft dots whose light does not depend on their order.
#include "render/environment.hpp"
#include "render/look_records.h"
#include "render/surface_records.h"
#include "rill/fluid_renderer.hpp"
#include "rill/whitewater.hpp"
#include "views/whitewater_view_records.h"

namespace rill {

class WhitewaterView {
 public:
  static constexpr uint64_t kPixelBytes = kWhiteLayers * 4;  ///< of the largest buffer of a picture

  /// `environment`: the sky is one of FluidRenderer::setEnvironment(). The device must have the shaders of engine/views.
  static Expected<WhitewaterView> create(Device& device, const TargetFormats& formats, bool environment);

  /// Copies the depth of the scene, before the fluid is drawn.
  BufferRef addScene(Graph& graph, ImageRef depth, const surface::SurfacePush& view) const;
  /// Draws over the fluid. `scene`: of addScene(); `pixels`: of the fluid's surface; `environment`: its texels, if any; `size`: radius of
  /// a particle, m.
  SceneTargets addTo(Graph& graph, const WhitewaterState& white, SceneTargets targets, const surface::SurfacePush& view,
                     const look::LookRecord& look, BufferRef scene, BufferRef pixels, BufferRef environment, double size) const;

 private:
  const ComputePipeline *scene_ = nullptr, *splat_ = nullptr;
  const GraphicsPipeline* blend_ = nullptr;
};

}  // namespace rill
