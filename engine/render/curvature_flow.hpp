#pragma once
// Screen-space curvature flow (van der Laan, Green and Sainz 2009) on a pyramid, from coarse to fine: the coarse levels smooth long waves
// with few samples and long steps.
#include "gpu/resources.hpp"
#include "render/surface_buffers.hpp"

namespace rill {

/// Push constants of a step of the flow.
struct FlowPush {
  surface::SurfacePush view;
  uint32_t iteration = 0;  ///< number of the step
};
static_assert(sizeof(FlowPush) <= 128);

class CurvatureFlow {
 public:
  static constexpr uint32_t kMaxLevels = 2;  ///< above the samples; limited by a margin that is a multiple of four samples

  /// `texels`: inputs are read as texel buffers.
  static Expected<CurvatureFlow> create(Device& device, bool texels);

  /// Smooths the spheres' depth, a float per sample. `side`: width of a sample at the focus, m. `time`: total time, squared spacings.
  /// The number of steps suffices at the focus: nearer fluid, with smaller samples, is smoothed less. `maxLevels`: of the pyramid above
  /// the samples.
  BufferRef addTo(Graph& graph, BufferRef depth, const SurfaceBuffers& surface, double side, double time, uint32_t maxLevels) const;

 private:
  const ComputePipeline *flow_[kMaxLevels + 1] = {}, *down_[kMaxLevels + 1] = {}, *up_[kMaxLevels + 1] = {};
};

}  // namespace rill
