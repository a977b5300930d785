#pragma once
// Theory of waves between frictionless walls: SI units, y up, the floor at y = 0.

#include "rill/vectors.hpp"

namespace rill::bench {

/// A standing wave of small amplitude in a tank, cos(k x) with k = mode pi / length.
struct StandingWave {
  double length_m = 1, depth_m = 1;
  int mode = 1;            ///< half wavelengths in the tank
  double amplitude_m = 0;  ///< of the surface at the wall
  double gravity = 9.81;   ///< m/s^2

  double waveNumber() const;  ///< k, rad/m
  double frequency() const;   ///< linear theory, omega^2 = g k tanh(k h), rad/s
  double period() const;      ///< linear theory, s
  /// Displacement and velocity at a point are this times those of the surface at the wall x = 0: linear theory.
  Double3 shape(double x, double y) const;
  /// Relative change of the frequency at this amplitude: the second order of Tadjbakhsh and Keller 1960.
  double secondOrder() const;
};

/// Rate at which viscosity takes the amplitude of a wave of `frequency_radPerS` between frictionless walls, 1/s: 2 nu k^2 at any depth
/// (Lamb, Hydrodynamics, 6th edition, section 348), less a share of sqrt(nu k^2 / 2 omega), the next order of the equation of section 349
/// for deep water. `viscosity`: kinematic, m^2/s.
double viscousDecay(double viscosity, double waveNumber, double frequency_radPerS);

/// The solitary wave of Boussinesq and Rayleigh, which travels along +x.
struct SolitaryWave {
  double depth_m = 1, height_m = 0.3;
  double gravity = 9.81;  ///< m/s^2

  double speed() const;                               ///< sqrt(g (depth + height)), m/s
  double shape() const;                               ///< K of sech^2(K x), 1/m
  double elevation(double fromCrest_m) const;         ///< of the surface over the depth, m
  double crossSection(double from, double to) const;  ///< integral of the elevation between two distances from the crest, m^2
  double velocity(double fromCrest_m) const;          ///< along x, the same at all heights, m/s: no mass passes the moving profile
  double stretching(double fromCrest_m) const;        ///< dv/dy = -du/dx, 1/s
};

/// Distance that the center of mass of a tank moves when its surface takes the slope `slope`, m: hydrostatics.
double levelShift(double length_m, double depth_m, double slope);

}  // namespace rill::bench
