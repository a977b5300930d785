// The neighbor list near walls: the images of neighbors against all pairs.
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "fluid/rig.hpp"
#include "shared/neighbor_list.h"

namespace rill::test {
namespace images_test {

/// Image n of x in a box from 0 to `size`, as in shaders/fluid/images.glsl.
glm::dvec3 imageOf(uint32_t n, glm::dvec3 x, glm::dvec3 size) {
  for (int a = 0; a < 3; ++a, n /= 3) x[a] = n % 3 == 0 ? x[a] : n % 3 == 1 ? -x[a] : 2 * size[a] - x[a];
  return x;
}

/// A full box.
Trial box(double smoothingRatio, glm::dvec3& size) {
  Trial t = trial();
  t.scene.fluid.smoothing_ratio = smoothingRatio;
  size = glm::dvec3(7, 6, 5.5) * t.d();
  setWalls(t, size);
  t.x = block({7, 6, 5}, t.d(), {0, 0, 0.5 * t.d()}, 0.1);
  for (glm::dvec3& x : t.x) x = glm::clamp(x, glm::dvec3(t.d() / 2), size - t.d() / 2);
  return t;
}

class ImagesTest : public FluidTest {
 protected:
  void expectAllListed(double smoothingRatio) {
    SCOPED_TRACE(smoothingRatio);
    glm::dvec3 size;
    const Trial t = box(smoothingRatio, size);
    auto run = start(t);
    run->substeps(1);
    const FluidSnapshot s = run->saved();
    ASSERT_EQ(s.neighborCount.size(), t.x.size());
    const double support = smoothingRatio * t.d(), reach = support + kListSkin * t.d(), moved = 0.1 * t.d();  // since the list was built
    size_t at = 0, images = 0;
    for (size_t i = 0; i < s.position.size(); ++i) {
      std::set<std::pair<uint32_t, uint32_t>> listed;
      uint32_t image = 0;
      ASSERT_LE(s.neighborCount[i], s.listCapacity) << "corners have room";
      for (uint32_t k = 0; k < s.neighborCount[i]; ++k, ++at) {
        const uint32_t entry = s.neighbors[at];
        if (entry >= kImageOfNeighbors)
          image = entry - kImageOfNeighbors;
        else
          EXPECT_TRUE(listed.insert({image, entry}).second) << "twice";
      }
      const auto place = [&](size_t k) { return glm::dvec3(s.position[k].x, s.position[k].y, s.position[k].z); };
      for (uint32_t n = 0; n < kSegmentImages; ++n)
        for (uint32_t j = 0; j < s.position.size(); ++j) {
          if (n == 0 && j == i) continue;
          const double distance = glm::length(imageOf(n, place(i), size) - place(j));
          const bool isListed = listed.contains({n, j});
          EXPECT_TRUE(isListed || distance >= support - moved) << i << ": image " << n << " of " << j;
          EXPECT_TRUE(!isListed || distance <= reach + moved) << i << ": image " << n << " of " << j;
          images += n > 0 && distance < support;
        }
    }
    EXPECT_GT(images, t.x.size() / 2);
  }
};

// Of each pair within the support, and none beyond the skin. In corners too: at a short support there are few neighbors and eight segments.
TEST_F(ImagesTest, ListHoldsAllThatAreNear) {
  for (const double ratio : {1.2, 2.0, 2.3, 2.7}) expectAllListed(ratio);
}

TEST_F(ImagesTest, DensityCountsThem) {
  glm::dvec3 size;
  const Trial t = box(2.3, size);
  auto run = start(t);
  (void)run->stats();
  const Snapshot& s = run->measured();
  const SmoothingKernel kernel(t.scene.solver.kernel, 2.3 * t.d(), t.d());
  for (size_t i = 0; i < s.x.size(); ++i) {
    double density = 0;
    for (uint32_t n = 0; n < kSegmentImages; ++n)
      for (const glm::dvec3& other : s.x) density += kernel.value(glm::length(s.x[i] - imageOf(n, other, size)));
    EXPECT_NEAR(s.density[i], density, 1e-5);
  }
}

}  // namespace images_test
}  // namespace rill::test
