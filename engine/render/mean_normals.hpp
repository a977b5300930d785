#pragma once
// The mean normal of the surface around each sample, by which light is refracted, and its coherence, which tells level fluid from
// whitewater.
#include "gpu/resources.hpp"
#include "render/surface_buffers.hpp"

namespace rill {

class MeanNormals {
 public:
  static Expected<MeanNormals> create(Device& device);

  /// A packed vector (unpackMean() of the shaders) for each sample with fluid, in view space; undefined for others. Its direction is the
  /// mean normal over two spacings to each side of the sample's own surface. Its length is the coherence, over all surfaces around:
  /// about 1 on an even surface, 0.5 at a straight silhouette, 0.1 on a single drop.
  BufferRef addTo(Graph& graph, const SurfaceBuffers& surface) const;

 private:
  const ComputePipeline *average_[2] = {}, *coherence_[2] = {};  ///< along rows, along columns
};

}  // namespace rill
