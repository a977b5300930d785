#include "render/curvature_flow.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"
#include "shared/no_depth.h"

namespace rill {
namespace {

using namespace surface;

constexpr double kCoarsest = 0.7;    // spacings: maximal width of a sample
constexpr uint32_t kFineSteps = 4;   // on each finer level
constexpr uint32_t kMaxSteps = 128;  // on the coarsest level

/// One level of the pyramid.
struct Level {
  SurfacePush push;
  uint32_t steps = 0;  ///< for the total time
  BufferRef start, to[2];
};

}  // namespace

Expected<CurvatureFlow> CurvatureFlow::create(Device& device, bool texels) {
  CurvatureFlow out;
  ModulePipelines pipelines(device);
  for (uint32_t level = 0; level <= kMaxLevels; ++level) {
    const NamedConstant step{"kStep", std::bit_cast<uint32_t>(kFlowStable)}, block{"kBlock", kSampleBlock >> level};
    out.flow_[level] = pipelines.make("render/surface_flow", texels, {step, block});
    if (level > 0) out.down_[level] = pipelines.make("render/surface_flow_down", texels, {step, block});
    if (level < kMaxLevels) out.up_[level] = pipelines.make("render/surface_flow_up", texels, {step, block});
  }
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef CurvatureFlow::addTo(Graph& graph, BufferRef depth, const SurfaceBuffers& surface, double side, double time,
                               uint32_t maxLevels) const {
  const double spacing = double{surface.push.spacing};
  uint32_t coarsest = 0;
  while (coarsest < std::min(maxLevels, kMaxLevels) && side * (2 << coarsest) <= kCoarsest * spacing) ++coarsest;
  Level levels[kMaxLevels + 1];
  for (uint32_t l = 0; l <= coarsest; ++l) {
    Level& level = levels[l];
    level.push = surface.push;
    level.push.step <<= l;
    level.push.margin >>= l;
    const double area = std::pow(side * (1 << l), 2);
    const double wanted = time * spacing * spacing;
    level.steps = std::clamp(static_cast<uint32_t>(std::ceil(wanted / (kFlowStable * area))), 1u, kMaxSteps);
    level.push.smoothing = static_cast<float>(wanted);
    const uint64_t bytes = sampleCount(level.push) * 4;
    level.start = l == 0 ? depth : graph.create("surface flow coarse", {bytes});
    for (BufferRef& buffer : level.to) buffer = graph.create("surface flow", {bytes});
  }
  Fill32 fills[3 * (kMaxLevels + 1)];
  size_t count = 0;
  for (uint32_t l = 0; l <= coarsest; ++l) {
    if (l > 0) fills[count++] = {&levels[l].start, kNoDepthBits};
    for (BufferRef& buffer : levels[l].to) fills[count++] = {&buffer, kNoDepthBits};
  }
  addFill(graph, "surface flow clear", std::span(fills).first(count));
  const DispatchSize blocks(surface.arguments, kSampleBlockArguments * 4);
  const Named counters{"counters", surface.counters}, list{"blocks", surface.blocks};
  for (uint32_t l = 1; l <= coarsest; ++l)
    addDispatch(graph, "surface flow down", down_[l], blocks, levels[l].push,
                {{"finer", levels[l - 1].start}, {"coarse", levels[l].start}, counters, list});
  BufferRef from;
  for (uint32_t l = coarsest + 1; l-- > 0;) {
    Level& level = levels[l];
    uint32_t target = 0;
    if (l == coarsest) {
      from = level.start;
    } else {
      addDispatch(graph, "surface flow up", up_[l], blocks, level.push,
                  {{"before", level.start}, {"started", levels[l + 1].start}, {"flowed", from}, {"after", level.to[0]}, counters, list});
      from = level.to[0];
      target = 1;
    }
    for (uint32_t k = 0; k < (l == coarsest ? level.steps : std::min(level.steps, kFineSteps)); ++k) {
      BufferRef& to = level.to[target++ % 2];
      addDispatch(graph, "surface flow", flow_[l], blocks, FlowPush{level.push, k}, {{"before", from}, {"after", to}, counters, list});
      from = to;
    }
  }
  return from;
}

}  // namespace rill
