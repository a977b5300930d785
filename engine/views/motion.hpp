#pragma once
// A frame's particles and bodies a moment earlier or later, at the velocities that they have: for motion blur.
#include "gpu/resources.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/whitewater.hpp"

namespace rill {

class Motion {
 public:
  /// The device must have the shaders of engine/views.
  static Expected<Motion> create(Device& device);

  /// `solids`: how many the fluid has; those that are driven, and bodies, move with it.
  FluidState addTo(Graph& graph, FluidState fluid, uint32_t solids, double seconds) const;
  WhitewaterState addTo(Graph& graph, WhitewaterState white, double seconds) const;

 private:
  BufferRef moved(Graph& graph, std::string_view name, BufferRef position, BufferRef velocity, uint32_t count, double seconds) const;

  const ComputePipeline *particles_ = nullptr, *solids_ = nullptr;
};

}  // namespace rill
