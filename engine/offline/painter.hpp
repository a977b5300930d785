#pragma once
// Rendering of a simulation: the views and their passes.
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "offline/film.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/offline.hpp"
#include "views/film_sum.hpp"
#include "views/finish.hpp"
#include "views/legend.hpp"
#include "views/motion.hpp"
#include "views/particle_view.hpp"
#include "views/scenery.hpp"
#include "views/whitewater_view.hpp"

namespace rill::offline {

/// Read-backs of a picture.
struct PictureTickets {
  Ticket picture;
  std::optional<Ticket> counters = {};  ///< of the surface renderer, if it was used
};

/// Number of times that shader loops of the picture reached their limit. The frame must have completed.
uint64_t boundHits(const Graph& graph, const PictureTickets& tickets);

/// Copies `count` numbers of a read-back picture. Failed if there are fewer.
template <class T>
Expected<void> readPixels(const Graph& graph, const PictureTickets& tickets, std::string_view view, size_t count, std::vector<T>& pixels) {
  const auto bytes = graph.data(tickets.picture);
  if (bytes.size() < count * sizeof(T))
    return Error{ErrorKind::Failed, "drawing the view \"" + std::string(view) + "\": the read-back is incomplete"};
  pixels.resize(count);
  std::memcpy(pixels.data(), bytes.data(), count * sizeof(T));
  return {};
}

/// RGBA8 as displayed, or half floats in linear light (of the view final).
enum class PixelKind { Display, Linear };

/// Whitewater of a picture, which the view "final" draws.
struct DrawnWhitewater {
  WhitewaterState state = {};  ///< of the same graph; room 0: none
  double size = 0;             ///< radius of its particles, m
};

/// Renders the views of a simulation.
class Painter {
 public:
  /// `scene` and `start` must outlive it. `options` as checkOptions() allows.
  Painter(const Scene& scene, const ParticleSet& start, const Options& options = {})
      : scene_(scene), start_(start), orbit_degPerS_(options.orbit_degPerS), exposure_stops_(options.exposure_stops), film_(options.film) {}

  /// BadInput for values of pictures that Options does not allow.
  static Expected<void> checkOptions(const Options& options);

  /// Brightens the view final by as many stops as checkOptions() allows.
  void expose(double stops) { exposure_stops_ = stops; }

  static std::span<const std::string_view> views();
  /// BadInput for an unknown view or an unsupported size. Needs no device.
  static Expected<void> check(std::string_view view, uint32_t width, uint32_t height);
  /// Creates the device resources of a view. Errors as check(); BadInput for an unknown look or an invalid environment map.
  Expected<void> prepare(Device& device, std::string_view view, uint32_t width, uint32_t height);
  /// Adds the passes of a picture seen from `eye`; prepare() must have succeeded. The result is RGBA of `kind`, top row first.
  BufferRef addTo(Graph& graph, const FluidState& fluid, std::string_view view, const CameraView& eye, uint32_t width, uint32_t height,
                  double time_s, PixelKind kind = PixelKind::Display, const DrawnWhitewater& white = {});
  /// The same from the scene's camera, with read-backs.
  PictureTickets declare(Graph& graph, const FluidState& fluid, std::string_view view, uint32_t width, uint32_t height, double time_s,
                         PixelKind kind = PixelKind::Display, const DrawnWhitewater& white = {});
  /// Pictures whose mean a picture of this view is; 1: declare() draws it.
  uint32_t samples(std::string_view view) const;
  /// Adds the passes that draw sample `k` of a picture of the view final and add it to the sum of the samples before. Without `picture`.
  PictureTickets declareSample(Graph& graph, const FluidState& fluid, const DrawnWhitewater& white, uint32_t width, uint32_t height,
                               double time_s, uint32_t k);
  /// The mean of all samples, with its read-back.
  PictureTickets declareMean(Graph& graph, PixelKind kind) const;
  /// Another number each time that the sum of samples was lost to another size.
  uint64_t sumGeneration() const { return sum_ ? sum_->generation() : 0; }
  /// The color scale of a view; empty for views without one, or before prepare().
  std::optional<LegendDesc> legend(std::string_view view, double time_s) const;
  /// Draws the legend of a view into a finished picture, on the host.
  void finish(Image& image, std::string_view view, double time_s) const;

 private:
  /// The scene's camera, rotated about its target for `time_s`.
  CameraView camera(uint32_t width, uint32_t height, double time_s) const;
  Error environmentError(const Error& error) const;
  Expected<void> prepareFilm(Device& device, uint32_t width, uint32_t height);
  WhitewaterExposure exposure(double size) const;
  ImageRef addLight(Graph& graph, const FluidState& fluid, const FluidView& view, double time_s, const DrawnWhitewater& white);

  const Scene& scene_;
  const ParticleSet& start_;
  double orbit_degPerS_, exposure_stops_;
  Film film_;
  std::unique_ptr<ParticleView> particles_;
  std::optional<FluidRenderer> fluid_;
  std::unique_ptr<Scenery> scenery_;
  Finish finish_;
  std::optional<WhitewaterView> whitewater_;  ///< with Look::whitewater
  FluidLook look_;
  std::optional<FilmSum> sum_;    ///< with more than one sample
  std::optional<Motion> motion_;  ///< with Film::shutter_s
};

}  // namespace rill::offline
