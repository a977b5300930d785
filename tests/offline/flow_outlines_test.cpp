// The lines that pictures show of mouths.
#include "views/flow_outlines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/flat_meshes.hpp"

namespace rill::test {
namespace {

TEST(FlowOutlines, ShowTheOutlineOfAMeshAboutItsOrigin) {
  Scene scene;
  MeshMouth mouth = mouthOf(joined(cornerMesh(0.25), moved(rectMesh(0.5, 0.5), 1, 0)));
  mouth.translation = {1, 2, 3};
  mouth.rotation = {0.5, 0.5, 0.5, 0.5};  // x to y, y to z, z to x
  scene.emitters = {{.mouth = mouth, .speed = 1, .motion = {{.at = 0}, {.at = 1, .translate = {1, 0, 0}}}}};
  std::vector<KeyframeRecord> keyframes;
  const auto lines = flowOutlines(scene, {1, 0, 0}, keyframes);
  ASSERT_EQ(lines.size(), 6 + 4 + 1u) << "edges inside are left out; the last line is the direction";
  ASSERT_EQ(keyframes.size(), 2u);
  std::set<std::pair<int, int>> corners;  // in quarters of a meter
  for (size_t k = 0; k < lines.size(); ++k) {
    const auto& line = lines[k];
    EXPECT_EQ(line.keyCount, 2u);
    EXPECT_EQ(line.centerX, 0);
    EXPECT_EQ(line.centerY, 2);
    EXPECT_EQ(line.centerZ, 3);
    EXPECT_NEAR(line.fromX, 0, 1e-6);
    if (k + 1 == lines.size()) continue;
    EXPECT_NEAR(line.toX, 0, 1e-6);
    corners.insert({int(std::lround(4 * line.fromY)), int(std::lround(4 * line.fromZ))});
  }
  EXPECT_GT(lines.back().toX, 0.1F) << "along the flow";
  const std::set<std::pair<int, int>> expected{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}, {4, 0}, {6, 0}, {6, 2}, {4, 2}};
  for (const auto& corner : corners) EXPECT_TRUE(expected.contains(corner)) << corner.first << ' ' << corner.second;
  EXPECT_GT(corners.size(), 5u);
}

}  // namespace
}  // namespace rill::test
