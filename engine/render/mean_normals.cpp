#include "render/mean_normals.hpp"

#include "graph/step.hpp"

namespace rill {

Expected<MeanNormals> MeanNormals::create(Device& device) {
  using enum BindingKind;
  static constexpr BindingKind kBindings[] = {Storage, Storage, Storage, Storage, Storage};
  MeanNormals out;
  for (uint32_t vertical = 0; vertical < 2; ++vertical) {
    const struct {
      const ComputePipeline*& pipeline;
      const char* shader;
    } all[] = {{out.average_[vertical], "render/surface_mean_normals"}, {out.coherence_[vertical], "render/surface_coherence"}};
    const uint32_t constants[] = {vertical};
    for (const auto& row : all) {
      auto made = computePipeline(
          device, {.shader = row.shader, .bindings = kBindings, .pushConstantBytes = sizeof(surface::SurfacePush), .constants = constants});
      if (!made) return made.error();
      row.pipeline = *made;
    }
  }
  return out;
}

BufferRef MeanNormals::addTo(Graph& graph, const SurfaceBuffers& surface) const {
  const StepGroups blocks(surface.arguments, surface::kSampleBlockArguments);
  BufferRef before = surface.samples;  // bound for the first step, not read
  const auto add = [&](const char* name, const ComputePipeline* pipeline) {
    BufferRef after = graph.create("surface mean normals", {sampleCount(surface.push) * 4});
    addStep(graph, name, pipeline, {reads(surface.samples), reads(before), fresh(after), reads(surface.counters), reads(surface.blocks)},
            blocks, surface.push);
    before = after;
  };
  for (const ComputePipeline* pipeline : average_) add("surface mean normals", pipeline);
  for (const ComputePipeline* pipeline : coherence_) add("surface coherence", pipeline);
  return before;
}

}  // namespace rill
