#pragma once
#include <string>
#include <vector>

#include "bench/bilateral.hpp"

namespace rill::bench {

/// A surface method with settings.
struct SurfaceVariant {
  std::string family;   ///< the method
  std::string setting;  ///< the changed setting; empty: default settings
  SurfaceMethod method = SurfaceMethod::Auto;
  SurfaceSettings settings = {};
  bool isDefault() const { return setting.empty(); }
  std::string name() const { return isDefault() ? family : family + " " + setting; }
};

/// The engine's methods and the bilateral baseline, each with default settings and with one setting varied at a time. The first is
/// SurfaceMethod::Auto.
std::vector<SurfaceVariant> surfaceVariants(const Bilateral& bilateral, bool quick);

}  // namespace rill::bench
