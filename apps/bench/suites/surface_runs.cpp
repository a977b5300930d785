#include "bench/suites/surface_runs.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "render/fluid_renderer_impl.hpp"

namespace rill::bench {

Expected<Points> SurfaceRuns::upload(std::span<const Float4> positions, double spacing) {
  auto buffer = workbench_.upload("positions", positions);
  if (!buffer) return buffer.error();
  return Points{std::move(*buffer), static_cast<uint32_t>(positions.size()), spacing};
}
Expected<Points> SurfaceRuns::upload(const Shape& shape, const Jitter& jitter, uint32_t seed) {
  std::vector<Float4> positions;
  for (const Float3& p : shape.particles(jitter, seed)) positions.push_back({p.x, p.y, -p.z, 0});
  return upload(positions, 1);
}

SurfaceBuffers SurfaceRuns::declare(Graph& graph, const Points& points, const SurfaceVariant& variant, const FluidView& view,
                                    bool complete) {
  FluidState fluid;
  fluid.position = importWhole(graph, "positions", points.positions);
  fluid.capacity = points.count;
  fluid.spacing = static_cast<float>(points.spacing);
  surface::SurfacePush camera = implOf(renderer_).camera(fluid, view);
  camera.step = sampleStep(camera, fluid.spacing, view.focus_m, variant.settings.samples);
  return implOf(renderer_).surface.addTo(graph, fluid, camera, variant.method, complete, view.focus_m, variant.settings);
}

Expected<RenderedSurface> SurfaceRuns::draw(const Points& points, const SurfaceVariant& variant, const FluidView& view, double* ms) {
  auto pixels = workbench_.make("pixels", uint64_t{view.width} * view.height * 8);
  if (!pixels) return pixels.error();
  const auto executed = workbench_.run([&](Graph& graph) {
    const SurfaceBuffers found = declare(graph, points, variant, view, true);
    BufferRef kept = importWhole(graph, "pixels", *pixels);
    graph.pass("keep", [&](Pass& pass) {
      pass.read(found.pixels, Use::CopySource);
      kept = pass.write(kept, Use::CopyTarget, true);
      return [=, from = found.pixels, bytes = pixels->size()](Commands& commands) { commands.copy(from, kept, bytes); };
    });
  });
  if (!executed) return executed.error();
  if (ms) *ms = executed->run_ms;
  const auto words = workbench_.download<uint32_t>(*pixels);
  if (!words) return words.error();
  RenderedSurface drawn;
  drawn.depth.resize(words->size() / 2);
  drawn.normal.resize(drawn.depth.size());
  for (size_t i = 0; i < drawn.depth.size(); ++i) {
    const SurfacePixel pixel = unpackPixel(&(*words)[2 * i]);
    drawn.depth[i] = pixel.depth;
    drawn.normal[i] = pixel.normal;
  }
  return drawn;
}

void SurfaceRuns::declareForTiming(Graph& graph, const Points& points, const SurfaceVariant& variant, const FluidView& view) {
  const SurfaceBuffers found = declare(graph, points, variant, view, false);
  graph.pass("consume", [&](Pass& pass) {
    pass.read(found.pixels, Use::CopySource);
    pass.sideEffect();
    return [](Commands&) {};
  });
}

Expected<std::vector<double>> SurfaceRuns::time(const Points& points, const SurfaceVariant& variant, const FluidView& view) {
  auto taken = sampleGraph(
      workbench_, samples_, [&](Graph& graph) { declareForTiming(graph, points, variant, view); }, WarmUp::Done);
  if (!taken) return taken.error();
  return std::move(taken->run_ms);
}

Expected<std::vector<double>> SurfaceRuns::timeSmoothing(const Points& points, const SurfaceVariant& variant, const FluidView& view) {
  static constexpr std::array kBefore{"particle count", "surface clear", "surface occlude",
                                      "surface cull",   "surface splat", "surface tiles"};
  std::vector<double> taken;
  workbench_.timePasses(true);
  for (uint32_t k = 0; k < samples_; ++k) {
    const auto ran = workbench_.run([&](Graph& graph) { declareForTiming(graph, points, variant, view); });
    if (!ran) return ran.error();
    double ms = 0;
    for (const Timing& timing : workbench_.passTimes())
      if (std::ranges::find(kBefore, timing.name) == kBefore.end()) ms += timing.ms;
    taken.push_back(ms);
  }
  workbench_.timePasses(false);
  return taken;
}

}  // namespace rill::bench
