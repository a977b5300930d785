#include "bench/bilateral.hpp"

#include "bench/shaders.hpp"
#include "core/impl_of.hpp"
#include "gpu/device_impl.hpp"
#include "gpu/shader_constants.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"

namespace rill::bench {
namespace {

struct BilateralPush {
  surface::SurfacePush view;
  float range = 0;
};
static_assert(sizeof(BilateralPush) <= 128);

}  // namespace

Expected<Bilateral> Bilateral::create(Device& device) {
  Bilateral filter;
  const struct {
    const ComputePipeline** pipeline;
    uint32_t columns, rows;
  } all[] = {{&filter.columns_, 1, 0}, {&filter.rows_, 0, 1}, {&filter.both_, 1, 1}};
  implOf(device).shaders.add(benchShaders());
  for (const auto& variant : all) {
    auto pipeline = shaderPipeline(device, "bilateral", {{"kColumns", variant.columns}, {"kRows", variant.rows}});
    if (!pipeline) return pipeline.error();
    *variant.pipeline = *pipeline;
  }
  return filter;
}

DepthFilter Bilateral::filter(const BilateralSettings& settings) const {
  return [*this, settings](Graph& graph, BufferRef depth, const surface::SurfacePush& view) {
    BilateralPush push{view, static_cast<float>(settings.range)};
    push.view.smoothing = static_cast<float>(settings.sigma);
    const uint64_t columns = divideUp(view.width, view.step) + 2 * view.margin, rows = divideUp(view.height, view.step) + 2 * view.margin;
    const auto pass = [&](const ComputePipeline* pipeline) {
      BufferRef to = graph.create("bilateral", {columns * rows * 4});
      addDispatch(graph, "bilateral", pipeline, divideUp(columns, 8) * divideUp(rows, 8), push, {{"before", depth}, {"after", to}});
      depth = to;
    };
    if (settings.separable) {
      pass(columns_);
      pass(rows_);
    } else {
      pass(both_);
    }
    return depth;
  };
}

}  // namespace rill::bench
