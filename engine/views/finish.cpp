#include "views/finish.hpp"

#include "gpu/device_impl.hpp"
#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"
#include "views/antialias_record.h"

namespace rill {

using namespace antialias;

Expected<Finish> Finish::create(Device& device) {
  Finish out;
  out.device_ = &implOf(device);
  ModulePipelines pipelines(device);
  out.tone_ = pipelines.make("views/tonemap");
  for (const bool texels : {false, true}) out.antialias_[texels] = pipelines.make("views/antialias", texels);
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef Finish::addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height) const {
  const uint64_t pixels = uint64_t{width} * height;
  BufferRef aliased = graph.create("picture aliased", {pixels * 4}), picture = graph.create("picture", {pixels * 4});
  addDispatch(graph, "picture tone", tone_, divideUp(pixels, 64), NoPush{}, {{"hdr", color}, {"aliased", aliased}});
  const bool texels = usesTexelReads(*device_->device, pixels);
  const Groups tiles{static_cast<uint32_t>(divideUp(width, kAntialiasGroup)), static_cast<uint32_t>(divideUp(height, kAntialiasGroup)), 1};
  addDispatch(graph, "picture edges", antialias_[texels], tiles, AntialiasPush{width, height},
              {{"aliased", aliased}, {"picture", picture}});
  return picture;
}

}  // namespace rill
