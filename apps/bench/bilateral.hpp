#pragma once
// A bilateral filter over the spheres' depth: what the engine's methods are held against.
#include "render/surface.hpp"

namespace rill::bench {

struct BilateralSettings {
  double sigma = 1.3;     ///< across the picture: standard deviation, spacings
  double range = 1;       ///< in depth: standard deviation, spacings
  bool separable = true;  ///< columns, then rows, which is no longer the same filter; else both at once
};

class Bilateral {
 public:
  static Expected<Bilateral> create(Device& device);

  /// A filter for SurfaceSettings::filter; alive as long as the device.
  DepthFilter filter(const BilateralSettings& settings) const;

 private:
  const ComputePipeline *columns_ = nullptr, *rows_ = nullptr, *both_ = nullptr;
};

}  // namespace rill::bench
