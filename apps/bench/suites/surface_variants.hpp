#pragma once
#include <string>
#include <vector>

#include "bench/bilateral.hpp"

namespace rill::bench {

/// A method with its settings.
struct SurfaceWay {
  std::string family;   ///< the method
  std::string setting;  ///< what was changed of it; empty: the method as it is
  SurfaceMethod method = SurfaceMethod::Auto;
  SurfaceSettings settings = {};
  bool standard() const { return setting.empty(); }
  std::string name() const { return standard() ? family : family + " " + setting; }
};

/// The engine's methods and the baseline, each as it is and with its settings varied one by one; the method of SurfaceMethod::Auto first.
std::vector<SurfaceWay> surfaceWays(const Bilateral& bilateral, bool quick);

}  // namespace rill::bench
