// Runs rill-view in a window on a virtual display.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {

inline constexpr const char* kDam = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}]
})";

class ViewWindowTest : public ::testing::Test {
 protected:
  void SetUp() override { scene = folder.write("dam.json", kDam).string(); }
  static std::string program() { return std::string(RILL_BINARY_DIR) + "/apps/view/rill-view"; }
  /// xvfb-run searches a free display from a number, and concurrent searches from one number may take the same display. With its own
  /// authority file it sometimes fails to remove it, which replaces the program's exit code.
  std::vector<std::string> onADisplay(const std::string& screen = "1280x720x24", const std::string& more = "") const {
    const std::string number = std::to_string(100 + ::getpid() % 20000), authority = folder.write("Xauthority", "").string();
    return {"/usr/bin/xvfb-run", "-a", "-n", number, "-f", authority, "-s", "-screen 0 " + screen + more};
  }
  std::vector<std::string> command(std::vector<std::string> arguments) const {
    std::vector<std::string> all = onADisplay();
    all.push_back(program());
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }
  Outcome view(std::vector<std::string> arguments) const { return Child(command(std::move(arguments)), folder.string()).wait(); }
  /// With Vulkan calls whose results are replaced, see layers/failing.cpp.
  Outcome viewFailing(const std::string& plan, std::vector<std::string> arguments) const {
    const Child::Environment failing{
        {"VK_ADD_LAYER_PATH", RILL_LAYERS_FOLDER}, {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"}, {"RILL_TEST_FAIL", plan}};
    return Child(command(std::move(arguments)), folder.string(), failing).wait();
  }
  /// The figure after `name` in a run's output.
  static std::string figure(const Outcome& outcome, const std::string& name) {
    std::istringstream words(outcome.out);
    for (std::string word, value; words >> word >> value;)
      if (word == name) return value;
    return {};
  }
  std::pair<int, int> sizeOf(const std::string& png) const {
    const std::string bytes = contentOf(folder / png);
    if (bytes.size() < 24 || bytes.substr(0, 8) != "\x89PNG\r\n\x1a\n") return {0, 0};
    const auto number = [&](size_t at) {
      int value = 0;
      for (size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
      return value;
    };
    return {number(16), number(20)};
  }

  TemporaryFolder folder;
  std::string scene;
};

}  // namespace rill::test
