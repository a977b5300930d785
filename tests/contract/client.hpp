#pragma once
// Uses Rill as a host application does: a small fluid and its renderer on a borrowed device, one graph per frame.
#include <cstddef>
#include <memory>
#include <vector>

#include "contract/host.hpp"
#include "rill/fluid.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"

namespace rill::test {

class Client {
 public:
  /// Without drawing, opening takes a third of the time.
  static Expected<std::unique_ptr<Client>> open(Host& host, const HostDevice& hostDevice, bool draws = true);
  ~Client();

  /// What happens to a recorded frame. Abandoned: not submitted, Device::abandon is called. Discarded: not
  /// submitted, the test calls Device::abandon later.
  enum class Submission { Submitted, Abandoned, Discarded };
  /// Runs a step of the fluid and renders it. Then advances clock.completed if `completes`.
  Expected<void> frame(Submission submission = Submission::Submitted, bool completes = true);
  /// Positions, velocities and pixels of the last submitted frame, if the clock reports it as completed.
  std::vector<std::byte> readback();

  /// Moves device, fluid, renderer and graph into other objects, and destroys the old ones.
  void moveHandles();

  Device& device() { return *device_; }
  FrameClock clock;
  bool draws = true;  ///< the next frame

 private:
  explicit Client(Host& host) : host_(host) {}
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
