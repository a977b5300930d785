#pragma once
// The figures of a device that the model of traffic/cost_model.hpp takes: measured, as no vendor states all of them.
#include "bench/traffic/cost_model.hpp"
#include "bench/workbench.hpp"

namespace rill::bench {

/// Bandwidth from copies of large buffers, latencies from dispatches of one workgroup, with and without a barrier between them.
struct DeviceSpeed {
  double copied_GBps = 0;  ///< read and written
  double dispatch_us = 0;
  double barrier_us = 0;  ///< in addition to the dispatch
  /// A card for predictions. Its bandwidth is such that kernels reach what copies did.
  Card card(std::string_view name) const { return {name, copied_GBps / kReachedBandwidth, dispatch_us, barrier_us, "measured"}; }
};

/// Takes about a second on a slow device.
Expected<DeviceSpeed> measureDeviceSpeed(Workbench& workbench);

}  // namespace rill::bench
