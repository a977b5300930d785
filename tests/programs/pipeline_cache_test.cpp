// RILL_PIPELINE_CACHE: a program keeps what its driver has compiled there, and nowhere else.
#include <gtest/gtest.h>

#include <regex>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace pipeline_cache_program_test {

namespace fs = std::filesystem;

constexpr const char* kDrop = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 1]}, "fluid": {"spacing": 0.1},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.5]}}]
})";

class PipelineCacheProgram : public ::testing::Test {
 protected:
  /// A run with this RILL_PIPELINE_CACHE, on a driver that keeps pipelines (tests/layers/failing.cpp): lavapipe and SwiftShader do not.
  Outcome run(const std::string& cache) const {
    const std::string scene = folder.write("drop.json", kDrop).string();
    return capture({scene, "--frames", "1", "--no-images", "--quiet"}, folder.string(),
                   {{"RILL_PIPELINE_CACHE", cache},
                    {"XDG_CACHE_HOME", folder / "user"},
                    {"HOME", folder / "home"},
                    {"VK_LAYER_PATH", RILL_LAYERS_FOLDER},
                    {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"},
                    {"RILL_TEST_PIPELINE_CACHE", "1"}});
  }
  void TearDown() override {
    EXPECT_FALSE(fs::exists(folder / "user" / "rill"));
    EXPECT_FALSE(fs::exists(folder / "home" / ".cache" / "rill"));
  }
  TemporaryFolder folder;
};

TEST_F(PipelineCacheProgram, SecondRunReadsTheFileOfTheFirst) {
  const fs::path cache = folder / "cache";
  const Outcome first = run(cache.string());
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "initialDataSize=0\n");
  const std::vector<std::string> files = TemporaryFolder::namesIn(cache);
  ASSERT_EQ(files.size(), 1u);
  const std::string content = contentOf(cache / files[0]);
  const Outcome second = run(cache.string());
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_TRUE(std::regex_match(second.err, std::regex("initialDataSize=[1-9][0-9]*\n"))) << second.err;
  EXPECT_EQ(TemporaryFolder::namesIn(cache), files);
  EXPECT_EQ(contentOf(cache / files[0]), content) << "nothing new was compiled";
}

TEST_F(PipelineCacheProgram, OffKeepsNothing) {
  const Outcome outcome = run("off");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no cache is created";
  EXPECT_FALSE(fs::exists(folder / "off"));
}

TEST_F(PipelineCacheProgram, RunsWhereItIsNoFolder) {
  const std::string file = folder.write("file", "not a folder").string();
  const Outcome outcome = run(file);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "initialDataSize=0\n");
  EXPECT_EQ(contentOf(file), "not a folder");
}

}  // namespace pipeline_cache_program_test
}  // namespace rill::test
