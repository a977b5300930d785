#include "view/script.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "view/keys.hpp"
#include "view/layout.hpp"
#include "view/options.hpp"

namespace rill::view {
namespace {

TEST(Script, ParsesCommands) {
  const auto lines = parseScript(
      "# a drag\n"
      "0 move 100 50.5\n\n"
      "1 press right   # took hold\n"
      "2 key f1\r\n"
      "2 set fluid.viscosity=0.1\n"
      "7 resize 800 600\n"
      "7 screenshot a.png",
      "test");
  ASSERT_TRUE(lines) << lines.error().message;
  ASSERT_EQ(lines->size(), 7u) << "a key is pressed and released";
  EXPECT_EQ((*lines)[0].input.y, 50.5);
  EXPECT_EQ((*lines)[1].frame, 1u);
  EXPECT_EQ((*lines)[1].input.code, GLFW_MOUSE_BUTTON_RIGHT);
  EXPECT_TRUE((*lines)[1].input.down);
  EXPECT_EQ((*lines)[2].input.code, GLFW_KEY_F1);
  EXPECT_TRUE((*lines)[2].input.down);
  EXPECT_FALSE((*lines)[3].input.down);
  EXPECT_EQ((*lines)[4].change.key, "fluid.viscosity");
  EXPECT_EQ((*lines)[5].width, 800u);
  EXPECT_EQ((*lines)[6].name, "a.png");
}

TEST(Script, HoldsKeys) {
  const auto lines = parseScript("0 hold T\n9 lift T\n", "test");
  ASSERT_TRUE(lines) << lines.error().message;
  ASSERT_EQ(lines->size(), 2u);
  for (const ScriptLine& line : *lines) EXPECT_EQ(line.input.code, GLFW_KEY_T);
  EXPECT_TRUE((*lines)[0].input.down);
  EXPECT_FALSE((*lines)[1].input.down);
}

TEST(Script, ErrorsNameLineAndExpectation) {
  const struct {
    const char* text;
    const char* says;
  } rows[] = {{"0 move nan 1\n", "expected \"move X Y\""},
              {"0 wheel inf\n", "expected \"wheel STEPS\""},
              {"0 move 1\n", "test:1: move: expected \"move X Y\""},
              {"0 key P\nx key P\n", "test:2: the line does not begin with a number; expected that of a frame"},
              {"3 key P\n2 key P\n", "test:2: frame 2 comes after frame 3"},
              {"0 prss left\n", "did you mean \"press\"?"},
              {"0 press up\n", "expected \"press left|middle|right\""},
              {"0 key Q7\n", "unknown key \"Q7\""},
              {"0 set fluid.viscosity\n", "="},
              {"0 resize 0 10\n", "expected \"resize WIDTH HEIGHT\""},
              {"5\n", "no command"}};
  for (const auto& row : rows) {
    const auto lines = parseScript(row.text, "test");
    ASSERT_FALSE(lines) << row.text;
    EXPECT_EQ(lines.error().kind, ErrorKind::BadInput);
    EXPECT_NE(lines.error().message.find(row.says), std::string::npos) << lines.error().message;
  }
}

TEST(Keys, BindingsAreUniqueAndDocumented) {
  std::ifstream file(RILL_SOURCE_DIR "/docs/viewer.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  const std::string help = keyHelp();
  for (const KeyBinding& binding : keyBindings()) {
    EXPECT_EQ(keyNamed(binding.name), binding.key);
    size_t same = 0;
    for (const KeyBinding& other : keyBindings()) same += other.key == binding.key || other.action == binding.action;
    EXPECT_EQ(same, 1u) << binding.name;
    EXPECT_NE(help.find(std::string(binding.about)), std::string::npos);
    EXPECT_NE(readme.find("| `" + std::string(binding.name) + "` | " + std::string(binding.about) + " |"), std::string::npos)
        << binding.name;
  }
  for (const MouseUse& use : mouseUses())
    EXPECT_NE(readme.find("| " + std::string(use.how) + " | " + std::string(use.about) + " |"), std::string::npos) << use.how;
}

TEST(Layout, AreasDoNotOverlap) {
  for (const uint32_t width : {16u, 320u, 800u, 1280u, 3840u})
    for (const uint32_t height : {16u, 200u, 720u, 2160u})
      for (const float scale : {1.0f, 2.0f}) {
        const Layout all = layOut(width, height, scale, true);
        const Area areas[] = {all.left, all.right, all.status, all.picture};
        uint64_t covered = 0;
        for (const Area& a : areas) {
          EXPECT_GT(a.width, 0u);
          EXPECT_GT(a.height, 0u);
          EXPECT_LE(a.x + a.width, width);
          EXPECT_LE(a.y + a.height, height);
          covered += uint64_t{a.width} * a.height;
          for (const Area& b : areas) {
            const bool apart = a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
            EXPECT_TRUE(apart || &a == &b);
          }
        }
        EXPECT_EQ(covered, uint64_t{width} * height) << "the whole window is covered";
        const Area alone = layOut(width, height, scale, false).picture;
        EXPECT_EQ(alone, (Area{0, 0, width, height}));
      }
}

TEST(ViewOptions, RejectsInvalidOptions) {
  const auto parse = [](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "rill-view");
    return parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
  };
  const struct {
    std::vector<const char*> arguments;
    const char* says;
  } rows[] = {{{"--view", "finl"}, "did you mean \"final\"?"},
              {{"--size", "1280"}, "WIDTHxHEIGHT"},
              {{"--size", "10x10"}, "from 64"},
              {{"--frames", "0"}, "from 1"},
              {{"--scale", "0.1"}, "0.5 to 4"},
              {{"--scale", "nan"}, "0.5 to 4"},
              {{"--set", "x"}, "="},
              {{"--frmaes", "3"}, "--frames"},
              {{"--screenshot", ""}, "name of a file"},
              {{"--device", ""}, "index"},
              {{"a", "b"}, "unexpected argument"}};
  for (const auto& row : rows) {
    const auto line = parse(row.arguments);
    ASSERT_FALSE(line) << row.arguments[0];
    EXPECT_EQ(line.error().kind, ErrorKind::BadInput);
    EXPECT_NE(line.error().message.find(row.says), std::string::npos) << line.error().message;
  }
  const auto good = parse({"drop", "--size", "800x600", "--set", "fluid.viscosity=1", "--set", "solver.cfl=0.2", "--script", "x"});
  ASSERT_TRUE(good) << good.error().message;
  EXPECT_EQ(good->options->scene, "drop");
  EXPECT_EQ(good->options->overrides.size(), 2u);
  EXPECT_TRUE(good->options->lockstep) << "a script counts frames";
  const auto help = parse({"--help"});
  ASSERT_TRUE(help);
  for (const char* word : {"--lockstep", "F1", "screenshot FILE"}) EXPECT_NE(help->text.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace rill::view
