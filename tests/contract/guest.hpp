#pragma once
// Rill as a host uses it: a small fluid and what draws it, on a lent device, a graph a frame.
#include <cstddef>
#include <memory>
#include <vector>

#include "contract/host.hpp"
#include "rill/fluid.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"

namespace rill::test {

class Guest {
 public:
  /// One that does not draw is open in a third of the time.
  static Expected<std::unique_ptr<Guest>> open(Host& host, const HostDevice& lent, bool draws = true);
  ~Guest();

  /// What a frame is for. An abandoned one is recorded and thrown away, one thrown away is yet to be abandoned.
  enum class Fate { Submitted, Abandoned, ThrownAway };
  /// A step of the fluid and its picture. The clock then says that the frame has completed, unless `told` is false.
  Expected<void> frame(Fate fate = Fate::Submitted, bool told = true);
  /// Positions, velocities and picture of the last submitted frame, once the clock has told of it.
  std::vector<std::byte> bits();

  Device& device() { return *device_; }
  FrameClock clock;
  bool draws = true;  ///< the next frame

 private:
  explicit Guest(Host& host) : host_(host) {}
  ImageRef picture(const FluidState& state);
  Ticket readPixels(ImageRef color);

  Host& host_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Fluid> fluid_;
  std::unique_ptr<FluidRenderer> renderer_;
  Graph graph_;
  std::vector<Ticket> tickets_;
};

}  // namespace rill::test
