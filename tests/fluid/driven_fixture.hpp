#pragma once
// Scenes with solids that the host moves.
#include <cmath>
#include <glm/geometric.hpp>

#include "core/vector_math.hpp"
#include "fluid/rig.hpp"
#include "shape/records.hpp"

namespace rill::test {
namespace driven_test {

inline constexpr double kFrame = 1.0 / 60;

inline Solid driven(Solid solid, double fastest) {
  solid.driven = fastest;
  return solid;
}

inline SolidTarget target(uint32_t solid, double x, double y, double z) { return {solid, {x, y, z}}; }

/// By an angle about an axis of unit length.
inline Quaternion rotation(double angle, const Double3& axis) {
  const double sine = std::sin(angle / 2);
  return {sine * axis.x, sine * axis.y, sine * axis.z, std::cos(angle / 2)};
}

/// Of the rotation between two unit quaternions, rad.
inline double angleBetween(const Quaternion& a, const Quaternion& b) { return length(turnBetween(a, b)); }

inline constexpr Double3 kAxis = {0.6, 0, 0.8};
inline constexpr glm::dvec3 kPaddle = {0.375, 0.3, 0.375}, kPaddleHalf = {0.2, 0.1, 0.05};

class DrivenTest : public FluidTest {
 protected:
  /// Particles in a tank, and a ball beside them.
  static Trial tank() {
    Trial t = trial();
    setWalls(t, {1, 0.5, 0.375});
    t.x = block({8, 6, 6}, t.d(), {}, 0.05);
    t.scene.solids = {driven(ball({0.75, 0.2, 0.1875}, 0.1), 5)};
    return t;
  }
  /// Particles in a tank around a paddle with friction, which is turned at the start.
  static Trial paddle() {
    Trial t = trial();
    setWalls(t, {0.75, 0.75, 0.75});
    t.scene.solids = {driven(slab(kPaddle - kPaddleHalf, kPaddle + kPaddleHalf), 20)};
    t.scene.solids[0].rotation = rotation(0.3, {0, 1, 0});
    t.scene.solids[0].friction = 0.3;
    addOutsideSolids(t, block({10, 7, 10}, t.d(), {0.0625, 0, 0.0625}, 0.05));
    return t;
  }
  /// The paddle at the end of the n-th of some advances.
  static SolidTarget paddleTarget(int n, double turn) {
    return {0, {kPaddle.x, kPaddle.y + 0.01 * n, kPaddle.z}, turned(rotation(0.3, {0, 1, 0}), n * turn, kAxis)};
  }
  /// What the device says of the solids.
  std::vector<SolidRecord> solidsOf(Fluid& fluid) {
    Graph graph;
    const FluidState state = fluid.present(graph);
    const Ticket ticket = graph.readback(state.solids);
    runGraph(graph);
    return read<SolidRecord>(graph, ticket);
  }
};

}  // namespace driven_test
}  // namespace rill::test
