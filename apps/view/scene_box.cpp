#include "view/scene_box.hpp"

namespace rill::view {

SceneBox sceneBox(const Session& session) {
  SceneBox room{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  const auto& domain = session.scene().domain;
  const Bounds& fluid = session.runner().firstBounds();
  if (!domain && fluid.empty()) return room;
  for (size_t a = 0; a < 3; ++a) {
    room.low[a] = domain ? domain->min[a] : fluid.min[a];
    room.high[a] = domain ? domain->max[a] : fluid.max[a];
  }
  if (domain) return room;
  const double around = room.longest();
  for (size_t a = 0; a < 3; ++a) {
    room.low[a] -= around;
    room.high[a] += around;
  }
  return room;
}

}  // namespace rill::view
