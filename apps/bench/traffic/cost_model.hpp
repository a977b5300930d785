#pragma once
// How long a GPU takes for what the solver gives it to do, from two figures: bytes over the bandwidth of its memory, and a fixed time for
// each dispatch and each barrier. See docs/notes/traffic.md for what this leaves out.
#include <span>
#include <string_view>

namespace rill::bench {

/// Work for a device, of a substep or of a frame.
struct DeviceWork {
  double bytes = 0;       ///< read from and written to device memory
  double dispatches = 0;  ///< recorded, those without workgroups included
  double barriers = 0;

  DeviceWork operator+(const DeviceWork& other) const {
    return {bytes + other.bytes, dispatches + other.dispatches, barriers + other.barriers};
  }
  DeviceWork operator*(double factor) const { return {bytes * factor, dispatches * factor, barriers * factor}; }
};

struct Card {
  std::string_view name;
  double bandwidth_GBps = 0;  ///< peak of the device memory, GB/s (1e9 bytes), by the vendor
  double dispatch_us = 0;     ///< to start a dispatch that waits for nothing
  double barrier_us = 0;      ///< to drain the device and make its writes visible
  std::string_view source;    ///< of the bandwidth
};

/// Cards of several classes. Bandwidths are the vendors'; no vendor states latencies, so those are assumptions, good to a factor of two.
std::span<const Card> cards();

/// The card whose name is part of a device's name as its driver reports it; null if none is.
const Card* cardOf(std::string_view deviceName);

/// Share of the peak bandwidth that kernels reach that only stream; 0 to 1.
constexpr double kReachedBandwidth = 0.8;

/// Seconds for `work`, at best: the device computes nothing that takes longer than its memory, and gathers hit its caches.
constexpr double predictedSeconds(const Card& card, const DeviceWork& work) {
  return work.bytes / (kReachedBandwidth * card.bandwidth_GBps * 1e9) +
         1e-6 * (work.dispatches * card.dispatch_us + work.barriers * card.barrier_us);
}

}  // namespace rill::bench
