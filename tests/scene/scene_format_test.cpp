// docs/scene-format.md: its tables are those of the field table, and its examples are scenes.
#include "support.hpp"

namespace rill::test {
namespace {

constexpr std::string_view kKeysBegin = "<!-- keys: begin (generated) -->\n", kKeysEnd = "<!-- keys: end -->\n";

std::string sceneFormatPage() {
  std::ifstream in(RILL_SOURCE_DIR "/docs/scene-format.md", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SceneFormat, TablesMatchTheFieldTable) {
  const std::string text = sceneFormatPage(), tables = "\n" + sceneKeyTables() + "\n";
  const size_t begin = text.find(kKeysBegin), end = text.find(kKeysEnd);
  ASSERT_NE(begin, std::string::npos) << "docs/scene-format.md lacks the line " << kKeysBegin;
  ASSERT_LT(begin, end) << "docs/scene-format.md lacks the line " << kKeysEnd;
  ASSERT_NE(end, std::string::npos) << "docs/scene-format.md lacks the line " << kKeysEnd;
  const size_t first = begin + kKeysBegin.size();
  const std::filesystem::path fresh = std::filesystem::path(RILL_BINARY_DIR) / "scene-format.md";
  std::ofstream(fresh, std::ios::binary) << text.substr(0, first) << tables << text.substr(end);
  EXPECT_TRUE(text.substr(first, end - first) == tables) << "the field table has changed: cp " << fresh.string() << " docs/";
}

TEST(SceneFormat, ExamplesAreAccepted) {
  const std::string text = sceneFormatPage(), fence = "```jsonc\n";
  size_t examples = 0;
  for (size_t begin = text.find(fence); begin != std::string::npos; begin = text.find(fence, begin + 1)) {
    const size_t first = begin + fence.size(), end = text.find("```", first);
    ASSERT_NE(end, std::string::npos);
    const std::string example = text.substr(first, end - first);
    const auto scene = parseScene(example, "docs/scene-format.md", std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes", {});
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message) << "\n" << example;
    ++examples;
  }
  EXPECT_GE(examples, 2U);
}

}  // namespace
}  // namespace rill::test
