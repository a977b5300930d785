#pragma once
// What the particle view keeps of a scene, as records for the device.
#include <optional>
#include <vector>

#include "rill/particles.hpp"
#include "rill/scene.hpp"
#include "views/particle_records.h"

namespace rill {

struct ParticleScene {
  Double3 origin = {0, 0, 0};  ///< m; all records are relative to it
  particle_view::SceneRecord scene;
  std::vector<particle_view::SceneSolid> solids;
  std::vector<KeyframeRecord> keyframes;
  std::vector<particle_view::LineRecord> lines;  ///< outlines of mouths and drains
  double speed_max = 1;                          ///< m/s at the speed map's end
  double compression_max = 0.01;                 ///< fraction at the compression map's end
};

/// `toSun`: direction to the light, of any length and not zero; empty: from the front, left and above.
ParticleScene particleScene(const Scene& scene, const ParticleSet& particles, const std::optional<Double3>& toSun = {});

/// The nearest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten; 1 where `value` is not positive.
double roundNicely(double value);

}  // namespace rill
