#include "shared/pipeline_cache_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace rill::test {
namespace {

/// The variables that matter, as they were before after the test.
class PipelineCacheFolderTest : public ::testing::Test {
 protected:
  PipelineCacheFolderTest() {
    for (Variable& variable : variables_)
      if (const char* value = std::getenv(variable.name)) variable.before = value;
  }
  ~PipelineCacheFolderTest() override {
    for (const Variable& variable : variables_)
      if (variable.before)
        ::setenv(variable.name, variable.before->c_str(), 1);
      else
        ::unsetenv(variable.name);
  }
  static std::string folder(const char* named, const char* cache, const char* home) {
    ::setenv("RILL_PIPELINE_CACHE", named, 1);
    ::setenv("XDG_CACHE_HOME", cache, 1);
    ::setenv("HOME", home, 1);
    return apps::pipelineCacheFolder().string();
  }

 private:
  struct Variable {
    const char* name;
    std::optional<std::string> before = {};
  };
  Variable variables_[3] = {{"RILL_PIPELINE_CACHE"}, {"XDG_CACHE_HOME"}, {"HOME"}};
};

TEST_F(PipelineCacheFolderTest, IsTheOneNamed) {
  EXPECT_EQ(folder("/named", "/cache", "/home/me"), "/named");
  EXPECT_EQ(folder("here", "/cache", "/home/me"), "here");
}

TEST_F(PipelineCacheFolderTest, OffIsNone) { EXPECT_EQ(folder("off", "/cache", "/home/me"), ""); }

TEST_F(PipelineCacheFolderTest, IsInTheCacheFolderOfTheUser) {
  EXPECT_EQ(folder("", "/cache", "/home/me"), "/cache/rill");
  EXPECT_EQ(folder("", "", "/home/me"), "/home/me/.cache/rill");
  EXPECT_EQ(folder("", "relative", "/home/me"), "/home/me/.cache/rill");
  EXPECT_EQ(folder("", "", "relative"), "");
}

}  // namespace
}  // namespace rill::test
