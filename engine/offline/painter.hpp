#pragma once
// The pictures of a simulation: which views there are, and the passes of each.
#include <memory>
#include <optional>
#include <string_view>

#include "rill/fluid_renderer.hpp"
#include "rill/offline.hpp"
#include "views/finish.hpp"
#include "views/legend.hpp"
#include "views/particle_view.hpp"
#include "views/scenery.hpp"

namespace rill::offline {

/// What comes back of a picture.
struct PictureTickets {
  Ticket picture;
  std::optional<Ticket> counters;  ///< of the surface, where one was made
};

/// Times that loops of the picture's shaders ran into their bound, once it has arrived.
uint64_t boundHits(const Graph& graph, const PictureTickets& tickets);

class Painter {
 public:
  /// Scene and particles outlive it.
  Painter(const Scene& scene, const ParticleSet& start, double orbit_deg_per_s)
      : scene_(scene), start_(start), orbit_deg_per_s_(orbit_deg_per_s) {}

  static std::span<const std::string_view> views();
  /// BadInput for a view that there is not, or a size that it cannot be drawn in. Needs no device.
  static Expected<void> check(std::string_view view, uint32_t width, uint32_t height);
  /// What check() says, BadInput for a look that is unknown; makes on the device what it needs.
  Expected<void> prepare(Device& device, std::string_view view, uint32_t width, uint32_t height);
  /// Declares the passes of a picture that prepare() allowed, seen from `eye`: width x height pixels, RGBA8 in sRGB, rows from the top.
  BufferRef addTo(Graph& graph, const FluidState& fluid, std::string_view view, const CameraView& eye, uint32_t width, uint32_t height,
                  double time_s);
  /// The same from the scene's camera, read back.
  PictureTickets declare(Graph& graph, const FluidState& fluid, std::string_view view, uint32_t width, uint32_t height, double time_s);
  /// The scale of what a view colors particles by; none for the other views, or before prepare().
  std::optional<LegendDesc> legend(std::string_view view, double time_s) const;
  /// What is drawn on the finished picture by the host.
  void finish(Image& image, std::string_view view, double time_s) const;

 private:
  /// The scene's, gone around its target for so long.
  CameraView camera(uint32_t width, uint32_t height, double time_s) const;
  Error aboutEnvironment(const Error& error) const;

  const Scene& scene_;
  const ParticleSet& start_;
  double orbit_deg_per_s_;
  std::unique_ptr<ParticleView> particles_;
  std::unique_ptr<FluidRenderer> fluid_;
  std::unique_ptr<Scenery> scenery_;
  Finish finish_;
  FluidLook look_;
};

}  // namespace rill::offline
