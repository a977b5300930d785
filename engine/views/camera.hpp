#pragma once
// Cameras of pictures.
#include "rill/fluid_renderer.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// A perspective camera with y up. If it looks along y, the picture's up is -z.
struct CameraView {
  Double3 eye = {0, 0, 1};     ///< m
  Double3 target = {0, 0, 0};  ///< m
  double fov_y_deg = 40;       ///< vertical field of view
};

/// A small change of a camera: pictures with different ones are averaged.
struct CameraOffset {
  double x_px = 0, y_px = 0;     ///< of the points that pixels show, right and down, pixels
  double right_m = 0, up_m = 0;  ///< of the eye within its lens, m; what is at `focus_m` stays where it is in the picture
  double focus_m = 1;            ///< along the view direction, m, above 0
};

/// Unit vectors of a camera's picture, right-handed: right x up points to the viewer.
struct CameraBasis {
  Double3 right = {1, 0, 0};
  Double3 up = {0, 1, 0};
  Double3 forward = {0, 0, -1};
};
CameraBasis cameraBasis(const CameraView& camera);

/// A camera that shows the whole box with a small margin, from the front and slightly above, with the longer horizontal side across.
/// `min` and `max` in m (a box without size is widened to 1 m), `aspect`: the picture's width over its height.
CameraView frameCamera(const Double3& min, const Double3& max, double aspect);

/// The scene's camera. By default it frames the domain or, without a domain, the fluid and solids at the start.
CameraView sceneCamera(const Scene& scene, const ParticleSet& particles, double aspect);

/// A camera as a FluidView: reversed depth without a far plane. `origin` is the eye, so that a scene far from zero loses nothing.
FluidView fluidView(const CameraView& camera, uint32_t width, uint32_t height, double spacing, const CameraOffset& offset = {});

}  // namespace rill
