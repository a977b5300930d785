#pragma once
// Particles as shaded spheres in their tank, drawn by compute passes into a storage buffer.
#include <cstdint>
#include <memory>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"
#include "views/camera.hpp"
#include "views/colour_map.hpp"

namespace rill {

/// What a picture of the particles looks like.
struct ParticleViewDesc {
  uint32_t width = 1280;  ///< pixels, 1 .. 8192
  uint32_t height = 720;  ///< pixels, 1 .. 8192; width x height is at most 2^25
  ParticleColour colour = ParticleColour::Speed;
  /// A particle's pixels have the map's colour of its value, to be read off the legend: nothing is lit or casts a shadow, and what is
  /// around the particles is darker than any colour of a map.
  bool unlit = false;
  double scale_max = 0;  ///< value at the colour map's end (m/s, or fraction of rest density); 0: ParticleView::scaleMax(colour)
};

class ParticleViewImpl;

/// Draws spheres of half a spacing's radius, the domain's floor, walls and edges, and the solids.
/// Nothing depends on the order of execution: two runs on one driver give the same bytes.
class ParticleView {
 public:
  /// Copies the domain, the solids and the light's frame to the device. `particles` is the start: it fixes the colour scales, and its
  /// origin. Scene and particles are not kept.
  static Expected<std::unique_ptr<ParticleView>> create(Device& device, const Scene& scene, const ParticleSet& particles);
  ~ParticleView();

  /// BadInput for a picture that is empty or too large, with the limits. Needs no device.
  static Expected<void> check(const ParticleViewDesc& desc);

  /// Declares the passes of one picture, `desc` being one that check() allows. The buffer that it returns holds width x height pixels,
  /// RGBA8 in sRGB with alpha 255, rows from the top.
  /// `time_s`: simulated time, where the solids are. With no particles, the state's buffers are not looked at.
  BufferRef addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time_s);

  /// The value at a colour map's end, fixed by the scene so that colours do not flicker: for speed, sqrt(2 g H) of the fall from the
  /// fluid's top at the start to the tank's floor, for compression ten times the solver's tolerance, each rounded to a handsome number.
  double scaleMax(ParticleColour colour) const;

 private:
  explicit ParticleView(std::unique_ptr<ParticleViewImpl>);
  std::unique_ptr<ParticleViewImpl> impl_;
};

}  // namespace rill
