#pragma once
// Waves in a cloud of particles and in curves over time. Sums over particles and smooth windows in place of single particles, whose
// noise is as large as a wave of half a spacing.
#include "bench/experiments/curves.hpp"
#include "bench/experiments/measures.hpp"

namespace rill::bench {

/// Amplitude of cos(k x) in the surface of a tank from x = 0, m: 2 h mean(cos(k x)) over the particles. Exact for a fluid of uniform
/// density over a level floor, at any amplitude.
double modalAmplitude(const Cloud& cloud, double waveNumber, double depth_m);

/// offset + e^(-decay t) (cosine cos(frequency t) + sine sin(frequency t)).
struct DampedCosine {
  double frequency = 0;  ///< rad/s
  double decay = 0;      ///< 1/s
  double offset = 0, cosine = 0, sine = 0;
  double residual = 0;  ///< root mean square of what the fit leaves, over that of the curve about its offset
  double period() const;
  double keptPerPeriod() const;  ///< share of the amplitude
};
/// Least squares. Searches frequencies within a factor of 0.6 to 1.5 of `expected_radPerS`. NaN with fewer than eight samples.
DampedCosine fitDampedCosine(const Curve& curve, double expected_radPerS);

/// Mean over [from, to] with the weight of a Hann window, which an oscillation with two periods or more in it does not shift.
double windowMean(const Curve& curve, double from, double to);

/// Height of the surface over x, from the volume of the particles in a Hann window of full width `window_m`.
struct SurfaceWindow {
  double from_m = 0, to_m = 0, step_m = 0;  ///< where to evaluate
  double window_m = 0, width_m = 0;         ///< width_m: the tank's, along z
};
Curve smoothSurface(const Cloud& cloud, const SurfaceWindow& window);

/// Follows a crest from one instant to the next: it looks for the highest point within `reach_m` of where the crest was.
class CrestFollower {
 public:
  /// `reach_m`: above the distance that the crest moves between two instants. The crest is refined by a parabola over half of it to each
  /// side.
  CrestFollower(double start_m, double reach_m) : at_(start_m), reach_(reach_m) {}
  /// `surface`: height over x at equal steps.
  void follow(const Curve& surface, double time);
  const Curve& positions() const { return positions_; }  ///< x over time
  const Curve& heights() const { return heights_; }      ///< over time

 private:
  double at_, reach_;
  Curve positions_, heights_;
};

}  // namespace rill::bench
