#pragma once
// A scene whose simulation the viewer runs, without a window.
#include <filesystem>
#include <span>

#include "rill/offline.hpp"
#include "support/gpu_test.hpp"
#include "support/temporary_folder.hpp"
#include "view/runner.hpp"

namespace rill::view {
namespace runner_test {

inline constexpr const char* kDam = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}]
})";

class ViewRunnerTest : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    file = folder.write("dam.json", kDam);
  }
  Scene scene(std::span<const Override> changes = {}) const {
    auto read = loadScene(file, changes);
    EXPECT_TRUE(read);
    return *read;
  }

  test::TemporaryFolder folder;
  std::filesystem::path file;
};

}  // namespace runner_test
}  // namespace rill::view
