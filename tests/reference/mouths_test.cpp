// What fluid in a mouth displaces, against the sum over the particles that it becomes.
#include "reference/mouths.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "shared/flow_records.h"
#include "sph/kernel.hpp"

namespace rill::reference {
namespace mouths_test {

constexpr double kSpacing = 0.1;

/// A square of ten by ten particles that has let out half a layer: the next one fills its share.
EmitterSettings square(uint32_t shape) {
  EmitterSettings e{.velocity = {0, 0, kSpacing}, .rate = 1, .until = 10};
  e.halfAcross = e.halfUp = 5 * kSpacing;
  e.shape = shape;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) e.points.push_back(kSpacing * glm::dvec3(i - 4.5, j - 4.5, 0));
  return e;
}

TEST(ReferenceMouths, LayerDisplacesWhatItsParticlesWill) {
  const SmoothingKernel kernel(KernelChoice::Wendland, 2.3 * kSpacing, kSpacing);
  const auto halfSpaceAt = [&](double s) { return halfSpace(kernel, s); };
  constexpr double kAtHalf = 0.5;  // seconds, layers, and so the strength of what opened half a layer ago
  for (const uint32_t shape : {kRectMouth, kMeshMouth}) {
    const EmitterSettings e = square(shape);
    for (const glm::dvec3& x :
         {glm::dvec3(0.5, 0.5, 1), {2.5, -1.5, 1}, {4.5, 0.5, 1}, {4.5, 4.5, 1}, {0.5, 0.5, -1}, {0.5, 0.5, 2}, {5.5, 0.5, 0}}) {
      const glm::dvec3 at = kSpacing * x;
      double sum = 0;
      for (const glm::dvec3& point : e.points) sum += kernel.value(glm::length(at - point));
      const double displaced = densityOfMouth(e, kAtHalf, at, kSpacing, halfSpaceAt).value / kAtHalf;
      EXPECT_NEAR(displaced, sum, 0.02) << "shape " << shape << " at " << x.x << ' ' << x.y << ' ' << x.z << " spacings";
    }
  }
}

TEST(ReferenceMouths, GradientIsThatOfTheDensity) {
  const SmoothingKernel kernel(KernelChoice::Wendland, 2.3 * kSpacing, kSpacing);
  const auto halfSpaceAt = [&](double s) { return halfSpace(kernel, s); };
  for (const uint32_t shape : {kRectMouth, kMeshMouth}) {
    const EmitterSettings e = square(shape);
    for (const glm::dvec3& x : {glm::dvec3(0.13, 0.21, 0.12), {0.49, -0.17, 0.09}, {-0.52, 0.47, 0.05}})
      for (int a = 0; a < 3; ++a) {
        glm::dvec3 step(0);
        step[a] = 1e-5 * kSpacing;
        const double slope = (densityOfMouth(e, 0.4, x + step, kSpacing, halfSpaceAt).value -
                              densityOfMouth(e, 0.4, x - step, kSpacing, halfSpaceAt).value) /
                             (2 * step[a]);
        EXPECT_NEAR(densityOfMouth(e, 0.4, x, kSpacing, halfSpaceAt).gradient[static_cast<size_t>(a)], slope, 0.02 / kSpacing);
      }
  }
}

}  // namespace mouths_test
}  // namespace rill::reference
