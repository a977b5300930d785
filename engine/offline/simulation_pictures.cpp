// Pictures of a simulation.
#include "offline/simulation_impl.hpp"
#include "offline/whitewater_run.hpp"

namespace rill::offline {

PictureRun::Content Simulation::Impl::drawn(Graph& graph) {
  PictureRun::Content content{.fluid = fluid_->addTo(graph, {})};
  if (white_) content.white = {white_->addTo(graph, content.fluid, 0), drawnRadius(white_->desc())};
  return content;
}

template <class T>
Expected<double> Simulation::Impl::draw(std::string_view view, std::vector<T>& rgba, uint32_t width, uint32_t height, PixelKind kind) {
  if (auto ready = prepareRender(view, width, height); !ready) return ready.error();
  if (auto measured = measure(); !measured) return measured.error();
  const double now = measured_->time_s;  // on the device, which is behind time() if time was dropped
  const PictureRun::Source source{.time_s = now,
                                  .content = [&](Graph& graph) { return drawn(graph); },
                                  .run = [&](Graph& graph, const auto& declare) { return run(graph, declare); }};
  if (auto ok = pictures_.draw(painter_, source, view, width, height, kind, rgba); !ok) return ok.error();
  pictureBoundHits_ += pictures_.boundHits();
  return now;
}

Expected<Image> Simulation::Impl::render(std::string_view view, uint32_t width, uint32_t height) {
  Image image{width, height, {}};
  auto now = draw(view, image.rgba, width, height, PixelKind::Display);
  if (!now) return now.error();
  painter_.finish(image, view, *now);
  return image;
}

Expected<LinearImage> Simulation::Impl::renderLinear(uint32_t width, uint32_t height) {
  LinearImage image{width, height, {}};
  auto now = draw("final", image.rgba, width, height, PixelKind::Linear);
  if (!now) return now.error();
  return image;
}

}  // namespace rill::offline
