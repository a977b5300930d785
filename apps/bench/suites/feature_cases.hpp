#pragma once
// What the suite "features" compares: each feature, the base scene, and scenes whose passes are listed.
#include <optional>
#include <string_view>
#include <vector>

#include "rill/scene_io.hpp"

namespace rill::bench {

using Overrides = std::vector<Override>;

/// A feature to compare with the base scene. Time steps are fixed, so that all runs do the same work otherwise.
struct Feature {
  std::string_view name;
  Overrides on;
  Overrides off = {};               ///< disables it explicitly, in place of the base scene's defaults
  bool passTimes = false;           ///< the feature is timing of passes
  bool measuresFigures = false;     ///< the feature is measuring figures every frame
  std::optional<Solid> solid = {};  ///< in the scene when it is on
};

std::vector<Feature> features();

/// Changes of the scene dam10k that make it the base.
const Overrides& baseChanges();

/// A scene whose passes are listed.
struct PassScene {
  std::string_view name, scene;
  Overrides overrides = {};
};

std::vector<PassScene> passScenes();

}  // namespace rill::bench
