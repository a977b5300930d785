#include "render/mean_normals.hpp"

#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"

namespace rill {

Expected<MeanNormals> MeanNormals::create(Device& device) {
  MeanNormals out;
  ModulePipelines pipelines(device);
  out.average_[0] = pipelines.make("render/surface_mean_normals");
  out.average_[1] = pipelines.make("render/surface_mean_normals_vertical");
  for (const bool vertical : {false, true})
    out.coherence_[vertical] = pipelines.make("render/surface_coherence", false, {{"VERTICAL", vertical}});
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef MeanNormals::addTo(Graph& graph, const SurfaceBuffers& surface) const {
  BufferRef before;
  const auto add = [&](const char* name, const ComputePipeline* pipeline) {
    BufferRef after = graph.create("surface mean normals", {sampleCount(surface.push) * 4});
    addDispatch(
        graph, name, pipeline, {surface.arguments, surface::kSampleBlockArguments * 4}, surface.push,
        {{"samples", surface.samples}, {"before", before}, {"after", after}, {"counters", surface.counters}, {"blocks", surface.blocks}});
    before = after;
  };
  for (const ComputePipeline* pipeline : average_) add("surface mean normals", pipeline);
  for (const ComputePipeline* pipeline : coherence_) add("surface coherence", pipeline);
  return before;
}

}  // namespace rill
