// What the panels show, in pixels.
#include <array>
#include <set>

#include "support/picture.hpp"
#include "view_window/view_window.hpp"

namespace rill::test {
namespace {

// Labels end where the panel's content does: columns of background follow.
TEST_F(ViewWindowTest, LabelsOfParametersFitIntoThePanel) {
  folder.write("hands.txt",
               "1 set solver.artificial_viscosity=0.3\n1 set fluid.contact_angle=80\n3 screenshot top.png\n4 move 200 500\n"
               "4 wheel -50\n5 move 640 300\n9 screenshot end.png\n10 resize 800 720\n16 screenshot narrow.png\n17 view particles\n");
  std::string text = kDam;
  scene = folder.write("dam.json", text.replace(text.find("0.1"), 3, "0.2")).string();
  const Outcome outcome = view({scene, "--view", "particles", "--script", "hands.txt"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  struct Shot {
    const char* name;
    uint32_t width, content, from;  // pixels: of the window, of the panel's content, below the header "Parameters"
  };
  for (const auto& [name, width, content, from] :
       {Shot{"top.png", 1280, 267, 410}, {"end.png", 1280, 267, 4}, {"narrow.png", 800, 247, 4}}) {
    const Picture shown = readPicture(folder / name);
    ASSERT_EQ(shown.width, width) << name;
    std::set<std::array<uint8_t, 3>> labels, margin;
    for (uint32_t y = from; y < 690; ++y)
      for (uint32_t x = 150; x < content + 4; ++x) {
        const uint8_t* rgb = &shown.rgb[3 * (size_t{y} * shown.width + x)];
        (x < content ? labels : margin).insert({rgb[0], rgb[1], rgb[2]});
      }
    EXPECT_EQ(margin.size(), 1u) << name;
    EXPECT_GT(labels.size(), 10u) << name;
  }
}

}  // namespace
}  // namespace rill::test
