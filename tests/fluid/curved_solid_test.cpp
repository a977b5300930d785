// Particles in contact with curved solids gain no speed along them.
#include <cmath>

#include "fluid/rig.hpp"

namespace rill::test {
namespace curved_solid_test {

constexpr double kFrame = 1.0 / 60;
constexpr glm::dvec3 kCenter = {0.14, 0.03, 0.14};
constexpr double kRadius = 0.03;

/// A tank of five layers at rest on the floor, with a ball there.
Trial tankWithBall() {
  Trial t = trial();
  t.scene.fluid = {.spacing = 0.02};
  t.scene.solver = SolverSettings{};
  setWalls(t, {0.28, 0.3, 0.28});
  t.step = kFrame;
  t.scene.solids = {ball(kCenter, kRadius)};
  t.x.clear();
  addOutsideSolids(t, block({14, 5, 14}, t.d()));
  return t;
}

/// Around the vertical line through the ball's center.
glm::dvec3 around(const Float3& x) { return glm::normalize(glm::dvec3(x.z - kCenter.z, 0, kCenter.x - x.x)); }

/// Whether a particle is in the wedge between floor and ball, which fluid presses it into.
bool inWedge(const Float3& x, double d) {
  const double apart = glm::length(glm::dvec3(x.x, x.y, x.z) - kCenter) - kRadius;
  return x.y < 0.55 * d && apart < 0.75 * d;
}

class CurvedSolidTest : public FluidTest {
 protected:
  /// Mean speed around the ball in the wedge, m/s.
  static double circling(const FluidSnapshot& s, double d) {
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < s.position.size(); ++i) {
      const Float3 x{s.position[i].x, s.position[i].y, s.position[i].z};
      if (!inWedge(x, d)) continue;
      sum += glm::dot(glm::dvec3(s.velocity[i].x, s.velocity[i].y, s.velocity[i].z), around(x));
      ++count;
    }
    EXPECT_GT(count, 5);
    return sum / count;
  }
};

TEST_F(CurvedSolidTest, RingUnderBallSlowsDown) {
  const Trial t = tankWithBall();
  auto run = start(t);
  while (run->progress().time_s < 2.5) run->advance(kFrame, 42);
  FluidSnapshot s = run->saved();
  for (size_t i = 0; i < s.position.size(); ++i) {
    const Float3 x{s.position[i].x, s.position[i].y, s.position[i].z};
    if (!inWedge(x, t.d())) continue;
    const glm::dvec3 v = 0.4 * around(x);
    s.velocity[i].x = static_cast<float>(v.x);
    s.velocity[i].y = 0;
    s.velocity[i].z = static_cast<float>(v.z);
  }
  EXPECT_NEAR(circling(s, t.d()), 0.4, 1e-6);
  auto turning = start(t, &s);
  for (int frame = 0; frame < 90; ++frame) turning->advance(kFrame, 42);
  EXPECT_LT(std::abs(circling(turning->saved(), t.d())), 0.1);
}

}  // namespace curved_solid_test
}  // namespace rill::test
