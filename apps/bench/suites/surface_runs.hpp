#pragma once
// Draws and times surfaces of particles that are given.
#include <cstdint>
#include <span>
#include <vector>

#include "bench/suites/surface_variants.hpp"
#include "bench/surface_errors.hpp"
#include "bench/surface_shapes.hpp"
#include "bench/workbench.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill::bench {

/// Particle positions on the device.
struct Points {
  Buffer positions;
  uint32_t count = 0;
  double spacing = 1;
};

class SurfaceRuns {
 public:
  /// `samples`: of each time. The workbench and the renderer must outlive it.
  SurfaceRuns(Workbench& workbench, FluidRenderer& renderer, uint32_t samples)
      : workbench_(workbench), renderer_(renderer), samples_(samples) {}

  Expected<Points> upload(std::span<const Float4> positions, double spacing);
  Expected<Points> upload(const Shape& shape, const Jitter& jitter, uint32_t seed);
  /// Renders and reads back a surface; `ms`: time from recording to completion.
  Expected<RenderedSurface> draw(const Points& points, const SurfaceVariant& variant, const FluidView& view, double* ms = nullptr);
  /// Times of all surface passes; call draw() first, so that the shaders are compiled.
  Expected<std::vector<double>> time(const Points& points, const SurfaceVariant& variant, const FluidView& view);
  /// Times of smoothing and normals: all passes after the sphere depth. Separate runs, since time stamps per pass slow the graph.
  Expected<std::vector<double>> timeSmoothing(const Points& points, const SurfaceVariant& variant, const FluidView& view);

 private:
  SurfaceBuffers declare(Graph& graph, const Points& points, const SurfaceVariant& variant, const FluidView& view, bool complete);
  void declareForTiming(Graph& graph, const Points& points, const SurfaceVariant& variant, const FluidView& view);

  Workbench& workbench_;
  FluidRenderer& renderer_;
  uint32_t samples_;
};

}  // namespace rill::bench
