#include "views/finish.hpp"

#include <cmath>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"
#include "views/antialias_record.h"

namespace rill {

using namespace antialias;

Expected<Finish> Finish::create(Device& device) {
  Finish out;
  ModulePipelines pipelines(device);
  out.tone_ = pipelines.make("views/tonemap");
  out.antialias_ = pipelines.make("views/antialias", usesTexelReads(device));
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef Finish::addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height, double exposure_stops) const {
  const uint64_t pixels = uint64_t{width} * height;
  BufferRef aliased = graph.create("picture aliased", {pixels * 4}), picture = graph.create("picture", {pixels * 4});
  addDispatch(graph, "picture tone", tone_, divideUp(pixels, 64), static_cast<float>(std::exp2(exposure_stops)),
              {{"hdr", color}, {"aliased", aliased}});
  const Groups tiles{static_cast<uint32_t>(divideUp(width, kAntialiasGroup)), static_cast<uint32_t>(divideUp(height, kAntialiasGroup)), 1};
  addDispatch(graph, "picture edges", antialias_, tiles, AntialiasPush{width, height}, {{"aliased", aliased}, {"picture", picture}});
  return picture;
}

}  // namespace rill
