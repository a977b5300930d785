// Shader reloading in development builds (RILL_SHADER_RELOAD).
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "gpu/pipeline.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace {

namespace fs = std::filesystem;

class ShaderReloading : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rill-shaders-" + std::to_string(getpid()));
    fs::copy(RILL_SOURCE_DIR "/shaders", folder_, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    setenv("RILL_SHADER_DIR", folder_.c_str(), 1);
    auto made = offline::Context::create();
    ASSERT_TRUE(made) << made.error().message;
    context_ = std::move(*made);
    context_->device().setMessageCallback([this](std::string_view text) { messages_ += text; });
    ASSERT_TRUE(context_->submit([](VkCommandBuffer) {}));  // the first poll records the initial file times
  }
  void TearDown() override {
    unsetenv("RILL_SHADER_DIR");
    context_.reset();
    fs::remove_all(folder_);
  }
  /// Appends to a shader file, with a time in the future so that coarse file times still differ.
  void append(const std::string& file, const std::string& text) {
    std::ofstream(folder_ / file, std::ios::app) << text;
    fs::last_write_time(folder_ / file, fs::file_time_type::clock::now() + std::chrono::seconds(++changes_));
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(context_->submit([](VkCommandBuffer) {}));
    }
  }
  const ComputePipeline* make() {
    auto made = computePipeline(context_->device(), {.shader = "sort/clear"});
    EXPECT_TRUE(made) << made.error().message;
    return made ? *made : nullptr;
  }

  fs::path folder_;
  std::optional<offline::Context> context_;
  std::string messages_;
  int changes_ = 0;
};

TEST_F(ShaderReloading, ReplacesChangedShaderKeepsOldOnError) {
  const ComputePipeline* pipeline = make();
  ASSERT_NE(pipeline, nullptr);
  const VkPipeline first = pipeline->handle;
  append("sort/clear.comp", "\n// a comment\n");
  EXPECT_EQ(messages_, "shader 'sort/clear' was reloaded");
  const VkPipeline second = pipeline->handle;
  EXPECT_NE(second, first);
  EXPECT_EQ(make(), pipeline);
  ASSERT_FALSE(pipeline->bindings.empty());
  EXPECT_EQ(pipeline->bindings.front().name, "start") << "passes still bind by names";

  messages_.clear();
  append("sort/clear.comp", "nonsense\n");
  EXPECT_NE(messages_.find("shader 'sort/clear' does not compile, keeping the old version:"), std::string::npos) << messages_;
  EXPECT_NE(messages_.find("sort/clear.comp:"), std::string::npos) << messages_;
  EXPECT_EQ(pipeline->handle, second);
}

TEST_F(ShaderReloading, ChangedHeaderReloadsAllShaders) {
  append("sort/sort_types.h", "\n");
  size_t reloaded = 0;
  for (size_t at = messages_.find("was reloaded"); at != std::string::npos; at = messages_.find("was reloaded", at + 1)) ++reloaded;
  EXPECT_GT(reloaded, 10u);
  EXPECT_EQ(messages_.find("does not compile"), std::string::npos) << messages_;
}

}  // namespace
}  // namespace rill::test
