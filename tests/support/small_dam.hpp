#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {

/// A small dam break scene in a temporary folder, in which run() starts rill-capture.
class SmallDam : public ::testing::Test {
 protected:
  using Json = nlohmann::json;

  Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), scene);
    return capture(arguments, folder.string());
  }
  Json stats(const std::string& name) const { return Json::parse(contentOf(folder / name)); }

  TemporaryFolder folder;
  std::string scene = folder
                          .write("dam.json", R"({
    "rill": "0.1", "title": "A small dam break", "duration": 0.5,
    "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]},
    "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}],
    "probes": [{"name": "H1", "level": [0.25, 0.15]}, {"name": "front", "front": "+x"}]
  })")
                          .string();
};

/// Expects a PNG signature at the start and an IEND chunk at the end.
inline void expectCompletePng(const std::filesystem::path& file) {
  const std::string bytes = contentOf(file);
  ASSERT_GT(bytes.size(), 40u) << file;
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n") << file;
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND") << file;
}

}  // namespace rill::test
