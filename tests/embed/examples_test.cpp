// The code in the guide and in the headers' top comments compiles.
#include <gtest/gtest.h>

#include <sstream>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

namespace fs = std::filesystem;

const fs::path kHeaders = fs::path(RILL_SOURCE_DIR) / "engine/include/rill";

struct Code {
  std::string includes, statements;
  size_t lines = 0;
  void add(const std::string& line) {
    (line.starts_with("#include") ? includes : statements) += line + "\n";
    ++lines;
  }
};

/// The C++ code blocks of a Markdown file, concatenated.
Code codeOfGuide(const fs::path& file) {
  Code code;
  std::istringstream text(contentOf(file));
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```"))
      inside = line == "```cpp";
    else if (inside)
      code.add(line);
  }
  return code;
}

/// The lines of a header's top comment that are indented by three spaces.
Code codeOfHeader(const fs::path& file) {
  Code code;
  std::istringstream text(contentOf(file));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("//   "))
      code.add(line.substr(5));
    else if (!line.starts_with("//") && line != "#pragma once")
      break;
  }
  return code;
}

void expectCompiles(const std::string& first, const Code& code) {
  const TemporaryFolder folder;
  const std::string source =
      first + code.includes + "#include \"embed/example_prelude.hpp\"\nint example() {\n" + code.statements + "return 0;\n}\n";
  const std::string file = folder.write("example.cpp", source).string();
  const Outcome outcome = Child({RILL_CXX, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Wno-unused", "-I",
                                 kHeaders.parent_path().string(), "-I", std::string(RILL_SOURCE_DIR) + "/tests", file})
                              .wait();
  EXPECT_EQ(outcome.code, 0) << source << outcome.err;
}

TEST(Examples, GuideCompiles) {
  const Code code = codeOfGuide(fs::path(RILL_SOURCE_DIR) / "apps/embed/README.md");
  EXPECT_GT(code.lines, 40u);
  expectCompiles("", code);
}

TEST(Examples, WaterExampleIsUnderSixtyLines) {
  std::istringstream text(contentOf(fs::path(RILL_SOURCE_DIR) / "apps/embed/water.cpp"));
  size_t lines = 0, ofRill = 0;
  for (std::string line; std::getline(text, line);) {
    const size_t first = line.find_first_not_of(" }");
    if (first == std::string::npos || line.compare(first, 2, "//") == 0) continue;
    ++lines;
    // Lines of the host engine (device, images, frames, clear) do not count.
    ofRill += line.find("host::") == std::string::npos && line.find("engine.") == std::string::npos;
  }
  EXPECT_GT(lines, 30u);
  EXPECT_LT(ofRill, 60u);
}

class HeaderExample : public ::testing::TestWithParam<std::string> {};

TEST_P(HeaderExample, Compiles) {
  const Code code = codeOfHeader(kHeaders / (GetParam() + ".hpp"));
  EXPECT_GE(code.lines, 1u) << "the header's top comment has no example";
  EXPECT_LE(code.lines, 12u);
  expectCompiles("#include <rill/" + GetParam() + ".hpp>\n", code);
}

/// All public headers except export.hpp, which only defines a macro.
std::vector<std::string> headers() {
  std::vector<std::string> names;
  for (const std::string& name : TemporaryFolder::namesIn(kHeaders))
    if (name != "export.hpp") names.push_back(name.substr(0, name.size() - 4));
  return names;
}

INSTANTIATE_TEST_SUITE_P(Public, HeaderExample, ::testing::ValuesIn(headers()), [](const auto& one) { return one.param; });

}  // namespace
}  // namespace rill::test
