// What walls do to a fluid follows their normals: turned with gravity and fluid they do the same.
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

constexpr double kSide = 0.05;

Solid slab(const glm::dvec3& low, const glm::dvec3& high, const glm::dquat& by) {
  const glm::dvec3 middle = by * ((low + high) / 2.0), half = (high - low) / 2.0;
  const glm::dvec3 min = middle - half, max = middle + half;
  Solid solid{.shape = BoxShape{{min.x, min.y, min.z}, {max.x, max.y, max.z}}};
  solid.rotation = {by.x, by.y, by.z, by.w};
  return solid;
}

/// Largest distance in spacings, after some substeps, between fluid in a corner of three slabs and the same turned.
double apart(const glm::dquat& by, double smoothingRatio) {
  const auto run = [&](const glm::dquat& turn) {
    ReferenceSettings s;
    s.spacing = kSide;
    s.smoothingRatio = smoothingRatio;
    s.gravity = turn * glm::dvec3(0, -9.81, 0);
    s.solids = {slab({-0.5, -0.5, -0.5}, {2, 0, 2}, turn), slab({-0.5, 0, -0.5}, {0, 2, 2}, turn), slab({0, 0, -0.5}, {2, 2, 0}, turn)};
    std::vector<glm::dvec3> x = lattice(4, 4, 4, kSide);
    for (glm::dvec3& p : x) p = turn * p;
    ReferenceSolver solver(s, x);
    solver.begin(1e-3);
    for (int step = 0; step < 40; ++step) solver.substep(1e-3, 1e-3);
    return solver.state.position;
  };
  const auto level = run({1, 0, 0, 0}), turned = run(by);
  double most = 0;
  for (size_t i = 0; i < level.size(); ++i) most = std::max(most, glm::length(glm::conjugate(by) * turned[i] - level[i]) / kSide);
  return most;
}

TEST(TiltedWalls, CornerEqualsAxisAlignedCorner) {
  const glm::dquat turns[] = {glm::angleAxis(0.785, glm::dvec3(0, 0, 1)), glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, -1.5)))};
  for (const glm::dquat& by : turns) {
    EXPECT_LT(apart(by, 2), 1e-9);
    EXPECT_LT(apart(by, 3), 1e-9) << "where the bound on the coverage is met, too";
  }
}

}  // namespace
}  // namespace rill::reference
