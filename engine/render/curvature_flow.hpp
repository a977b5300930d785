#pragma once
// Screen-space curvature flow (van der Laan, Green and Sainz 2009), from coarse to fine: long waves are smoothed where samples are few and
// steps are long.
#include "gpu/resources.hpp"
#include "render/surface_buffers.hpp"

namespace rill {

/// What a step of the flow is told.
struct FlowPush {
  surface::SurfacePush view;
  uint32_t iteration = 0;  ///< which of the steps it is
};
static_assert(sizeof(FlowPush) <= 128);

/// The flow's kernels, on every level that a pyramid may have.
class CurvatureFlow {
 public:
  static constexpr uint32_t kMaxLevels = 2;  ///< above the samples: a margin is a whole number of cells, of four samples

  static Expected<CurvatureFlow> create(Device& device);

  /// A smooth depth from that of the spheres, a float a sample. `side`: m that a sample is wide at the focus. `time`: spacings squared;
  /// blurs over about its root. As many steps are recorded as that takes at the focus: nearer to the eye, where samples are smaller, the
  /// stable ones fall short of it; farther away a sample takes fewer of them. `maxLevels`: of the pyramid above the samples. `texels`: it
  /// is read as texel buffers.
  BufferRef addTo(Graph& graph, BufferRef depth, const SurfaceBuffers& surface, double side, double time, uint32_t maxLevels,
                  bool texels) const;

 private:
  const ComputePipeline *flow_[kMaxLevels + 1][2] = {}, *down_[kMaxLevels + 1][2] = {}, *up_[kMaxLevels + 1][2] = {};
};

}  // namespace rill
