#pragma once
// The pictures that a picture with film effects is the mean of: which point of a pixel, of the shutter's time and of the lens each shows.
#include "rill/offline.hpp"
#include "views/camera.hpp"

namespace rill::offline {

/// BadInput for values that Film does not allow.
Expected<void> checkFilm(const Film& film);

/// Pictures that are averaged; 1: no effect.
uint32_t sampleCount(const Film& film);

/// Sample k of a mean of `count`, which has its middle at zero. Deterministic and of low discrepancy in each of its three parts, which do
/// not depend on each other.
struct FilmSample {
  double x = 0, y = 0;          ///< within a pixel, about -0.5 to 0.5
  double time = 0;              ///< of the time that the shutter is open, -0.5 to 0.5
  double lensX = 0, lensY = 0;  ///< within the unit disc
};
FilmSample filmSample(uint32_t k, uint32_t count);

/// Radius of the lens's opening, m, for a sensor 24 mm high. `fov_y_deg`: of the picture; `focus_m`: distance that is sharp.
double lensRadius(double aperture, double fov_y_deg, double focus_m);

/// How a sample moves the camera.
CameraOffset cameraOffset(const Film& film, const FilmSample& sample, const CameraView& camera);

}  // namespace rill::offline
