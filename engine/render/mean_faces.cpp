#include "render/mean_faces.hpp"

#include "render/compute_step.hpp"

namespace rill {

Expected<MeanFaces> MeanFaces::create(Device& device) {
  using enum BindingKind;
  static constexpr BindingKind kBindings[] = {Storage, Storage, Storage, Storage, Storage};
  MeanFaces out;
  for (uint32_t vertical = 0; vertical < 2; ++vertical) {
    const uint32_t constants[] = {vertical};
    auto made = computePipeline(device, {.shader = "render/surface_faces",
                                         .bindings = kBindings,
                                         .pushConstantBytes = sizeof(surface::SurfacePush),
                                         .constants = constants});
    if (!made) return made.error();
    out.along_[vertical] = *made;
  }
  return out;
}

BufferRef MeanFaces::addTo(Graph& graph, const SurfaceBuffers& surface) const {
  BufferRef means[2];
  for (BufferRef& buffer : means) buffer = graph.create("surface faces", {sampleCount(surface.push) * 4});
  const StepGroups blocks(surface.arguments, surface::kSampleBlockArguments);
  BufferRef before = surface.samples;  // the first dimension has none: bound, never read
  for (int k = 0; k < 2; ++k) {
    addStep(graph, "surface faces", along_[k],
            {reads(surface.samples), reads(before), fresh(means[k]), reads(surface.counters), reads(surface.blocks)}, blocks, surface.push);
    before = means[k];
  }
  return before;
}

}  // namespace rill
