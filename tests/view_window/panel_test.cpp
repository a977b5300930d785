// What the panels show, in pixels.
#include <array>
#include <set>

#include "support/picture.hpp"
#include "view_window/view_window.hpp"

namespace rill::test {
namespace {

// The panel ends with three columns of background: a label that is cut off reaches into them.
TEST_F(ViewWindowTest, LabelsOfParametersFitIntoThePanel) {
  folder.write("hands.txt",
               "1 set solver.artificial_viscosity=0.3\n1 set fluid.contact_angle=80\n3 screenshot top.png\n4 move 200 500\n"
               "4 wheel -50\n5 move 640 300\n9 screenshot end.png\n10 view particles\n");
  std::string text = kDam;
  scene = folder.write("dam.json", text.replace(text.find("0.1"), 3, "0.2")).string();
  const Outcome outcome = view({scene, "--view", "particles", "--script", "hands.txt"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const auto& [name, from] : {std::pair("top.png", 410u), {"end.png", 4u}}) {  // below the header "Parameters"
    const Picture shown = readPicture(folder / name);
    ASSERT_EQ(shown.width, 1280u) << name;
    std::set<std::array<uint8_t, 3>> labels, margin;
    for (uint32_t y = from; y < 690; ++y)
      for (uint32_t x = 150; x < 271; ++x) {
        const uint8_t* rgb = &shown.rgb[3 * (size_t{y} * shown.width + x)];
        (x < 268 ? labels : margin).insert({rgb[0], rgb[1], rgb[2]});
      }
    EXPECT_EQ(margin.size(), 1u) << name;
    EXPECT_GT(labels.size(), 10u) << name;
  }
}

}  // namespace
}  // namespace rill::test
