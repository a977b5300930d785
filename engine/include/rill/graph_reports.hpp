#pragma once
// What a render graph tells of a frame: its passes, their times, where transients lie.
//
//   for (const rill::Timing& pass : graph.timings()) std::printf("%6.3f ms  %s\n", pass.ms, std::string(pass.name).c_str());
//   for (const rill::PassReport& pass : graph.report())
//     if (!pass.reason.empty()) std::printf("skipped: %s\n", std::string(pass.reason).c_str());
#include <cstdint>
#include <string_view>

namespace rill {

/// Time that a pass took on the device, from the end of the pass before it, so that all add up to the frame's. Passes of one name are added
/// up.
struct Timing {
  std::string_view name;
  double ms = 0;
  uint32_t runs = 0;  ///< passes of that name
};

/// A pass that was declared, or that a module left out with a reason (Graph::skipped).
struct PassReport {
  std::string_view name;
  uint32_t runs = 0;
  bool culled = false;
  std::string_view reason;  ///< why it was culled or skipped; empty where it ran
};

/// A piece of device memory that transients share.
struct TransientHeap {
  bool images = false;      ///< holds images, else buffers
  uint32_t transients = 0;  ///< that lie in it
  uint64_t bytes = 0;       ///< that it takes
  uint64_t separate = 0;    ///< that they would take without aliasing, one after another
};

/// Where a transient lies.
struct TransientReport {
  std::string_view name;
  bool image = false;
  uint32_t heap = 0;               ///< of its kind
  uint64_t offset = 0, bytes = 0;  ///< in it
  uint32_t first = 0, last = 0;    ///< passes, in the order in which they run, between which it lives
};

}  // namespace rill
