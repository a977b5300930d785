#pragma once
// Reports of a render graph about a frame: passes, their GPU times, placement of transients.
//
//   for (const rill::Timing& pass : graph.timings()) std::printf("%6.3f ms  %s\n", pass.ms, std::string(pass.name).c_str());
//   for (const rill::PassReport& pass : graph.report())
//     if (!pass.reason.empty()) std::printf("skipped: %s\n", std::string(pass.reason).c_str());
#include <cstdint>
#include <string_view>

namespace rill {

/// GPU time from the end of the previous pass to the end of this one, so the sum is the frame's time.
/// Passes of the same name are added up.
struct Timing {
  std::string_view name;
  double ms = 0;
  uint32_t runs = 0;  ///< executed passes of that name
};

/// A pass that was declared, or that a module left out with a reason (Graph::skipped).
struct PassReport {
  std::string_view name;
  uint32_t runs = 0;
  bool culled = false;
  std::string_view reason;  ///< why it was culled or skipped; empty if it was executed
};

/// A block of device memory that transients share.
struct TransientHeap {
  bool images = false;      ///< holds images; false: buffers
  uint32_t transients = 0;  ///< number of transients placed in it
  uint64_t bytes = 0;       ///< size
  uint64_t separate = 0;    ///< bytes that the transients would take without aliasing
};

/// Placement and lifetime of a transient.
struct TransientReport {
  std::string_view name;
  bool image = false;
  uint32_t heap = 0;               ///< index among the heaps of its kind (images or buffers)
  uint64_t offset = 0, bytes = 0;  ///< within the heap
  uint32_t first = 0, last = 0;    ///< first and last pass that uses it, in execution order
};

}  // namespace rill
