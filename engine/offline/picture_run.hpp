#pragma once
// Draws pictures on a device: in one frame, or with film effects in one for each sample and one for their mean.
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "offline/painter.hpp"
#include "rill/graph.hpp"

namespace rill::offline {

class PictureRun {
 public:
  /// What is drawn, as buffers of a graph.
  struct Content {
    FluidState fluid;
    DrawnWhitewater white = {};
  };
  /// Where it comes from.
  struct Source {
    double time_s = 0;                                                                      ///< of solids and camera
    std::function<Content(Graph&)> content;                                                 ///< adds it to a graph
    std::function<Expected<void>(Graph&, const std::function<void(Graph&)>& declare)> run;  ///< resets, declares, runs, waits
  };

  /// Draws a view that the painter has prepared: RGBA into `rgba`, from the top.
  template <class T>
  Expected<void> draw(Painter& painter, const Source& source, std::string_view view, uint32_t width, uint32_t height, PixelKind kind,
                      std::vector<T>& rgba) {
    auto drawn = run(painter, source, view, width, height, kind);
    if (!drawn) return drawn.error();
    return readPixels(*drawn->first, drawn->second, view, 4 * size_t{width} * height, rgba);
  }

  void contentChanged() { summed_.reset(); }         ///< the samples of the last picture are no longer those of the next one
  uint64_t boundHits() const { return boundHits_; }  ///< of the last picture, 0 where its samples were those of the one before
  const Graph& graph() const { return graph_; }      ///< of the last picture, or sample
  const Graph& meanGraph() const { return meanGraph_; }
  void enableTimings(bool enable);

 private:
  using Drawn = std::pair<const Graph*, PictureTickets>;
  Expected<Drawn> run(Painter& painter, const Source& source, std::string_view view, uint32_t width, uint32_t height, PixelKind kind);

  Graph graph_, meanGraph_;
  std::optional<uint64_t> summed_;  ///< Painter::sumGeneration() in which the samples of the last picture were summed
  uint64_t boundHits_ = 0;
};

}  // namespace rill::offline
