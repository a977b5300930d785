#pragma once
// How much fluid is between points and the sun, for the light that shines through crests.
#include "render/particle_count.hpp"
#include "rill/device.hpp"
#include "rill/vectors.hpp"

namespace rill {

class CrestDepths {
 public:
  static Expected<CrestDepths> create(Device& device);

  /// Cells along the grid's sides, after which it repeats: as far as a square layer of `capacity` particles reaches, twice.
  static uint32_t side(uint32_t capacity);
  /// Two floats a cell, as shaders/render/crest_heights.comp writes them. `toSun`: unit vector.
  BufferRef addTo(Graph& graph, const FluidState& fluid, const Float4& toSun, const CountedParticles& particles) const;

 private:
  const ComputePipeline *depths_ = nullptr, *heights_ = nullptr;
};

}  // namespace rill
