#include "render/mean_faces.hpp"

#include "graph/step.hpp"

namespace rill {

Expected<MeanFaces> MeanFaces::create(Device& device) {
  using enum BindingKind;
  static constexpr BindingKind kBindings[] = {Storage, Storage, Storage, Storage, Storage};
  MeanFaces out;
  for (uint32_t vertical = 0; vertical < 2; ++vertical) {
    const struct {
      const ComputePipeline*& pipeline;
      const char* shader;
    } all[] = {{out.faces_[vertical], "render/surface_faces"}, {out.torn_[vertical], "render/surface_torn"}};
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

BufferRef MeanFaces::addTo(Graph& graph, const SurfaceBuffers& surface) const {
  const StepGroups blocks(surface.arguments, surface::kSampleBlockArguments);
  BufferRef before = surface.samples;  // the first step has none: bound, never read
  const auto add = [&](const char* name, const ComputePipeline* pipeline) {
    BufferRef after = graph.create("surface faces", {sampleCount(surface.push) * 4});
    addStep(graph, name, pipeline, {reads(surface.samples), reads(before), fresh(after), reads(surface.counters), reads(surface.blocks)},
            blocks, surface.push);
    before = after;
  };
  for (const ComputePipeline* pipeline : faces_) add("surface faces", pipeline);
  for (const ComputePipeline* pipeline : torn_) add("surface torn", pipeline);
  return before;
}

}  // namespace rill
