#include "views/finish.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"
#include "views/finish_records.h"

namespace rill {

using namespace finish;

namespace {

Groups tilesOf(uint32_t width, uint32_t height) {
  return {static_cast<uint32_t>(divideUp(width, kPictureTile)), static_cast<uint32_t>(divideUp(height, kPictureTile)), 1};
}

}  // namespace

Expected<Finish> Finish::create(Device& device, bool storageReads) {
  Finish out;
  const bool texels = !storageReads && usesTexelReads(device);
  ModulePipelines pipelines(device);
  out.tone_ = pipelines.make("views/tonemap");
  out.search_ = pipelines.make("views/antialias_search", texels);
  out.antialias_ = pipelines.make("views/antialias", texels);
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef Finish::addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height, double exposure_stops) const {
  BufferRef aliased = graph.create("picture aliased", {uint64_t{width} * height * 4});
  addDispatch(graph, "picture tone", tone_, tilesOf(width, height), static_cast<float>(std::exp2(exposure_stops)),
              {{"hdr", color}, {"aliased", aliased}});
  return smoothed(graph, aliased, width, height);
}

BufferRef Finish::smoothed(Graph& graph, BufferRef aliased, uint32_t width, uint32_t height) const {
  const uint64_t bytes = uint64_t{width} * height * 4;
  BufferRef picture = graph.create("picture", {bytes}), edges = graph.create("picture edge pixels", {bytes});
  BufferRef counts = graph.create("picture edge counts", {4 * 4});
  graph.pass("picture copy", [&](Pass& pass) {
    pass.read(aliased, Use::CopySource);
    picture = pass.write(picture, Use::CopyTarget, true);
    counts = pass.write(counts, Use::CopyTarget, true);
    return [aliased, picture, counts, bytes](Commands& commands) {
      constexpr uint32_t kNoEdges[] = {0, kEdgeRows, 1, 0};
      commands.copy(aliased, picture, bytes);
      commands.update(counts, std::as_bytes(std::span(kNoEdges)));
    };
  });
  const AntialiasPush push{width, height};
  const Named named[] = {{"aliased", std::as_const(aliased)}, {"counts", counts}, {"edges", edges}, {"picture", picture}};
  addDispatch(graph, "picture edge search", search_, tilesOf(width, height), push, named);
  addDispatch(graph, "picture edges", antialias_, {counts, 0}, push, named);
  return picture;
}

}  // namespace rill
