#include "render/curvature_flow.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "graph/step.hpp"

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

Expected<CurvatureFlow> CurvatureFlow::create(Device& device) {
  using enum BindingKind;
  static constexpr BindingKind kStorage[] = {Storage, Storage, Storage, Storage, Storage, Storage};
  static constexpr BindingKind kOne[] = {TexelUint, Storage, Storage, Storage};
  static constexpr BindingKind kThree[] = {TexelUint, TexelUint, TexelUint, Storage, Storage, Storage};
  CurvatureFlow out;
  for (uint32_t level = 0; level <= kMaxLevels; ++level)
    for (const bool texels : {false, true}) {
      const struct {
        const ComputePipeline*& pipeline;
        std::string_view shader;
        std::span<const BindingKind> bindings;
        bool used = true;
      } all[] = {{out.flow_[level][texels], texels ? "render/surface_flow_texel" : "render/surface_flow",
                  texels ? std::span<const BindingKind>(kOne) : std::span(kStorage).first(4)},
                 {out.down_[level][texels], texels ? "render/surface_flow_down_texel" : "render/surface_flow_down",
                  texels ? std::span<const BindingKind>(kOne) : std::span(kStorage).first(4), level > 0},
                 {out.up_[level][texels], texels ? "render/surface_flow_up_texel" : "render/surface_flow_up",
                  texels ? std::span<const BindingKind>(kThree) : std::span<const BindingKind>(kStorage), level < kMaxLevels}};
      const uint32_t constants[] = {std::bit_cast<uint32_t>(kFlowStable), kSampleBlock >> level};
      for (const auto& row : all) {
        if (!row.used) continue;
        const size_t bytes = &row.pipeline == &out.flow_[level][texels] ? sizeof(FlowPush) : sizeof(SurfacePush);
        auto made = computePipeline(
            device,
            {.shader = row.shader, .bindings = row.bindings, .pushConstantBytes = static_cast<uint32_t>(bytes), .constants = constants});
        if (!made) return made.error();
        row.pipeline = *made;
      }
    }
  return out;
}

BufferRef CurvatureFlow::addTo(Graph& graph, BufferRef depth, const SurfaceBuffers& surface, double side, double time, uint32_t maxLevels,
                               bool texels) const {
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
    if (l > 0) fills[count++] = {&levels[l].start, kInfiniteBits};
    for (BufferRef& buffer : levels[l].to) fills[count++] = {&buffer, kInfiniteBits};
  }
  addFill(graph, "surface flow clear", std::span(fills).first(count));
  const StepGroups blocks(surface.arguments, kSampleBlockArguments);
  const auto array = [&](BufferRef buffer) { return texels ? rill::texels(buffer) : reads(buffer); };
  for (uint32_t l = 1; l <= coarsest; ++l)
    addStep(graph, "surface flow down", down_[l][texels],
            {array(levels[l - 1].start), writes(levels[l].start), reads(surface.counters), reads(surface.blocks)}, blocks, levels[l].push);
  BufferRef from;
  for (uint32_t l = coarsest + 1; l-- > 0;) {
    Level& level = levels[l];
    uint32_t target = 0;
    if (l == coarsest) {
      from = level.start;
    } else {
      addStep(graph, "surface flow up", up_[l][texels],
              {array(level.start), array(levels[l + 1].start), array(from), writes(level.to[0]), reads(surface.counters),
               reads(surface.blocks)},
              blocks, level.push);
      from = level.to[0];
      target = 1;
    }
    for (uint32_t k = 0; k < (l == coarsest ? level.steps : std::min(level.steps, kFineSteps)); ++k) {
      BufferRef& to = level.to[target++ % 2];
      addStep(graph, "surface flow", flow_[l][texels], {array(from), writes(to), reads(surface.counters), reads(surface.blocks)}, blocks,
              FlowPush{level.push, k});
      from = to;
    }
  }
  return from;
}

}  // namespace rill
