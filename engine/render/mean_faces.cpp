#include "render/mean_faces.hpp"

#include "render/compute_step.hpp"

namespace rill {

Expected<MeanFaces> MeanFaces::create(Device& device) {
  using enum BindingKind;
  static constexpr BindingKind kBindings[] = {Storage, Storage, Storage, Storage};
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
  BufferRef faces[2];
  for (BufferRef& buffer : faces) buffer = graph.create("surface faces", {surface.sampleCount * 8});
  graph.pass("surface faces clear", [&](Pass& pass) {
    for (BufferRef& buffer : faces) buffer = pass.write(buffer, Use::CopyTarget, true);
    return [first = faces[0], second = faces[1]](Commands& commands) {
      commands.fill(first, surface::kInfiniteBits);
      commands.fill(second, surface::kInfiniteBits);
    };
  });
  const StepGroups blocks(surface.arguments, surface::kSampleBlockArguments);
  BufferRef from = surface.samples;
  for (int k = 0; k < 2; ++k) {
    addStep(graph, "surface faces", along_[k], {reads(from), writes(faces[k]), reads(surface.counters), reads(surface.blocks)}, blocks,
            surface.push);
    from = faces[k];
  }
  return from;
}

}  // namespace rill
