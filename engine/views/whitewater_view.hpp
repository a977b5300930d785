#pragma once
// Draws foam, spray and bubbles into a picture: soft dots whose light does not depend on their order.
#include "render/environment.hpp"
#include "render/surface_records.h"
#include "rill/fluid_renderer.hpp"
#include "rill/whitewater.hpp"
#include "views/whitewater_view_records.h"

namespace rill {

/// How whitewater is seen.
struct WhitewaterExposure {
  double size = 0;            ///< radius of a particle, m
  double seconds = 0;         ///< in which spray draws streaks; 0: dots
  Double3 turn = {0, 0, 0};   ///< angular velocity of the camera, rad/s
  Double3 about = {0, 0, 0};  ///< a point that it turns about, m
};

class WhitewaterView {
 public:
  static constexpr uint64_t kPixelBytes = kWhiteLayers * 4;  ///< of the largest buffer of a picture

  /// `environment`: the sky is one of FluidRenderer::setEnvironment(). The device must have the shaders of engine/views.
  static Expected<WhitewaterView> create(Device& device, const TargetFormats& formats, bool environment);

  /// What the picture is drawn from.
  struct Input {
    WhitewaterState white;
    Double3 origin;    ///< of its positions
    BufferRef scene;   ///< the depths of the target, before the fluid was drawn
    BufferRef pixels;  ///< of the fluid's surface
    BufferRef look;    ///< of addLook()
  };
  /// Optical depth of each pixel: kWhiteLayers words, in 1 / kWhiteOpacity.
  BufferRef addDots(Graph& graph, const Input& input, const surface::SurfacePush& view, const WhitewaterExposure& exposure) const;
  /// Draws over the fluid. `environment`: its texels, if any.
  SceneTargets addTo(Graph& graph, const Input& input, SceneTargets targets, const surface::SurfacePush& view, BufferRef environment,
                     const WhitewaterExposure& exposure) const;

 private:
  const ComputePipeline* splat_ = nullptr;
  const GraphicsPipeline* blend_ = nullptr;
};

}  // namespace rill
