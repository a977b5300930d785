// README's key table and example scene match the field table and the reader.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "rill/scene_io.hpp"

namespace rill::test {
namespace {

std::string readme() {
  std::ostringstream text;
  text << std::ifstream(RILL_SOURCE_DIR "/README.md").rdbuf();
  return text.str();
}

TEST(Readme, HasNoPlaceholders) { EXPECT_EQ(readme().find('@'), std::string::npos); }

TEST(Readme, ExampleSceneIsValid) {
  const std::string text = readme();
  const size_t begin = text.find("```json\n"), end = text.find("```", begin + 8);
  ASSERT_NE(end, std::string::npos);
  const auto scene = parseScene(text.substr(begin + 8, end - begin - 8), "README.md", RILL_SOURCE_DIR, {});
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
}

}  // namespace
}  // namespace rill::test
