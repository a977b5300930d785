#include "offline/picture_run.hpp"

namespace rill::offline {

void PictureRun::enableTimings(bool enable) {
  graph_.enableTimings(enable);
  meanGraph_.enableTimings(enable);
}

Expected<PictureRun::Drawn> PictureRun::run(Painter& painter, const Source& source, std::string_view view, uint32_t width, uint32_t height,
                                            PixelKind kind) {
  PictureTickets tickets;
  boundHits_ = 0;
  const uint32_t samples = painter.samples(view);
  if (samples == 1) {
    auto ran = source.run(graph_, [&](Graph& graph) {
      const Content content = source.content(graph);
      tickets = painter.declare(graph, content.fluid, view, width, height, source.time_s, kind, content.white);
    });
    if (!ran) return ran.error();
    boundHits_ = offline::boundHits(graph_, tickets);
    return Drawn{&graph_, tickets};
  }
  if (summed_ != painter.sumGeneration()) {
    summed_.reset();
    // A frame each: the memory of one, and no submission that takes longer than a picture.
    for (uint32_t k = 0; k < samples; ++k) {
      auto ran = source.run(graph_, [&](Graph& graph) {
        const Content content = source.content(graph);
        tickets = painter.declareSample(graph, content.fluid, content.white, width, height, source.time_s, k);
      });
      if (!ran) return ran.error();
      boundHits_ += offline::boundHits(graph_, tickets);
    }
    summed_ = painter.sumGeneration();
  }
  auto ran = source.run(meanGraph_, [&](Graph& graph) { tickets = painter.declareMean(graph, kind); });
  if (!ran) return ran.error();
  return Drawn{&meanGraph_, tickets};
}

}  // namespace rill::offline
