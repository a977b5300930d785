#pragma once
// A bilateral filter of the sphere depth: the baseline of the engine's smoothing methods.
#include "render/surface.hpp"

namespace rill::bench {

struct BilateralSettings {
  double sigma = 1.3;     ///< spatial standard deviation, spacings
  double range = 1;       ///< standard deviation over depth, spacings
  bool separable = true;  ///< columns, then rows (an approximation); else one 2D filter
};

class Bilateral {
 public:
  static Expected<Bilateral> create(Device& device);

  /// A filter for SurfaceSettings::filter; valid as long as the device.
  DepthFilter filter(const BilateralSettings& settings) const;

 private:
  const ComputePipeline *columns_ = nullptr, *rows_ = nullptr, *both_ = nullptr;
};

}  // namespace rill::bench
