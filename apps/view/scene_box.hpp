#pragma once
// Where the pointer can add things to a scene.
#include <algorithm>

#include "view/session.hpp"

namespace rill::view {

struct SceneBox {
  Double3 low{}, high{};  ///< m
  double longest() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }
  /// The nearest place that is at least `gap` from all sides; the center along axes where it is narrower.
  Double3 clamped(Double3 place, double gap) const {
    for (size_t a = 0; a < 3; ++a) {
      const double room = std::min(gap, 0.5 * (high[a] - low[a]));
      place[a] = std::clamp(place[a], low[a] + room, high[a] - room);
    }
    return place;
  }
};

/// The domain, or the bounds of the fluid at the start, extended by their longest side.
SceneBox sceneBox(const Session& session);

}  // namespace rill::view
