#include "bench/experiments/wave_starts.hpp"

#include <cmath>

namespace rill::bench {

Cloud standingWave(const StandingWave& wave, double spacing, int thickness) {
  Cloud cloud;
  cloud.spacing = spacing;
  for (int i = 0; (i + 0.5) * spacing < wave.length_m; ++i)
    for (int j = 0; (j + 0.5) * spacing < wave.depth_m; ++j)
      for (int l = 0; l < thickness; ++l) {
        const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing, speed = wave.frequency() * wave.amplitude_m;
        const Double3 shape = wave.shape(x, y);
        cloud.position.push_back({x, y, (l + 0.5) * spacing});
        cloud.velocity.push_back({speed * shape.x, speed * shape.y, 0});
      }
  return cloud;
}

Cloud solitaryWave(const SolitaryWave& wave, double length_m, double crest_m, double spacing, int thickness) {
  Cloud cloud;
  cloud.spacing = spacing;
  for (int i = 0; (i + 0.5) * spacing < length_m; ++i)
    for (int l = 0; l < thickness; ++l) {
      const double x = (i + 0.5) * spacing, threshold = (l + 0.5) / thickness;
      const double layers = std::floor((wave.depth_m + wave.elevation(x - crest_m)) / spacing + threshold + 1e-9);
      for (int j = 0; j < layers; ++j) {
        const double y = (j + 0.5) * spacing;
        cloud.position.push_back({x, y, (l + 0.5) * spacing});
        cloud.velocity.push_back({wave.velocity(x - crest_m), y * wave.stretching(x - crest_m), 0});
      }
    }
  return cloud;
}

}  // namespace rill::bench
