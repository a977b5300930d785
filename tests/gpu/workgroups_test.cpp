// The sizes of workgroups against what a device allows.
#include <gtest/gtest.h>

#include <optional>

#include "gpu/shader_library.hpp"
#include "gpu/workgroup_size.hpp"
#include "rill/pipeline.hpp"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace workgroups_test {

std::span<const uint32_t> builtIn(std::string_view name) {
  if (const EmbeddedShader* shader = findShader(embeddedShaders(), name)) return shader->words;
  ADD_FAILURE() << "no shader '" << name << "'";
  return {};
}

TEST(WorkgroupSizeTest, ReadsSizesFromSpirv) {
  EXPECT_EQ(workgroupSize(builtIn("fluid/density")).x, 64u);
  EXPECT_EQ(workgroupSize(builtIn("fluid/measure_reduce")).x, 256u);
  const WorkgroupSize tile = workgroupSize(builtIn("render/surface_compose"));
  EXPECT_EQ(tile.x, tile.y);
  EXPECT_EQ(tile.invocations(), uint64_t{tile.x} * tile.x);
}

TEST(WorkgroupSizeTest, FollowsSpecializationConstants) {
  const uint32_t constants[] = {0, 4};  // constant_id 1 is both sides of a block
  const WorkgroupSize block = workgroupSize(builtIn("render/surface_flow"), constants);
  EXPECT_EQ(block.x, 4u);
  EXPECT_EQ(block.y, 4u);
  EXPECT_NE(workgroupSize(builtIn("render/surface_flow")).x, 4u) << "its default";
}

TEST(WorkgroupSizeTest, IgnoresTruncatedModules) {
  const auto words = builtIn("fluid/density");
  for (size_t length = 0; length < std::min<size_t>(words.size(), 400); ++length) (void)workgroupSize(words.first(length));
  EXPECT_EQ(workgroupSize({}).invocations(), 1u);
  EXPECT_FALSE(isCompute({}));
}

class WorkgroupsTest : public ::testing::Test {
 protected:
  /// The message of the pipeline, else nothing. A shader of one workgroup of 64 x 1 x 1.
  std::string make(uint32_t requiredSize, bool full) {
    auto borrowed = Device::borrow(vulkan.host());
    if (!borrowed) return borrowed.error().message;
    device_ = std::move(*borrowed);
    const auto made =
        computePipeline(*device_, {.shader = "fluid/viscosity_start", .requiredSubgroupSize = requiredSize, .fullSubgroups = full});
    EXPECT_EQ(vulkan.pipelines.size(), made ? 1u : 0u);
    return made ? "" : made.error().message;
  }
  NullVulkan vulkan;
  std::optional<Device> device_;
};

TEST_F(WorkgroupsTest, AcceptsFullSubgroupsThatDivideTheWorkgroup) {
  vulkan.properties = {.subgroupSize = 32, .minSubgroupSize = 8, .maxSubgroupSize = 64};
  EXPECT_EQ(make(0, true), "");
}

TEST_F(WorkgroupsTest, RejectsFullSubgroupsThatMayBeLargerThanTheWorkgroup) {
  vulkan.properties = {.name = "wide", .subgroupSize = 64, .minSubgroupSize = 64, .maxSubgroupSize = 128};
  EXPECT_EQ(
      make(0, true),
      "shader 'fluid/viscosity_start': needs full subgroups, but 64, the first of the sizes of its workgroups, is not a multiple of 128, "
      "the largest subgroup size of wide");
}

TEST_F(WorkgroupsTest, RejectsRequiredSizeThatDoesNotDivideTheWorkgroup) {
  vulkan.properties = {.name = "wide", .subgroupSize = 64, .minSubgroupSize = 64, .maxSubgroupSize = 128};
  EXPECT_EQ(
      make(128, true),
      "shader 'fluid/viscosity_start': needs full subgroups, but 64, the first of the sizes of its workgroups, is not a multiple of 128, "
      "the subgroup size that it requires");
}

TEST_F(WorkgroupsTest, RejectsWorkgroupsAboveTheLimit) {
  auto borrowed = Device::borrow(vulkan.host());
  ASSERT_TRUE(borrowed);
  const uint32_t constants[] = {0, 32};
  const auto words = builtIn("render/surface_flow");
  const auto made = computePipeline(*borrowed, {.shader = "large", .spirv = words, .constants = constants});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::Shader);
  EXPECT_EQ(made.error().message,
            "shader 'large': needs workgroups of 32 x 32 x 1; null device supports at most 256 invocations and 256 x 256 x 256");
}

}  // namespace workgroups_test
}  // namespace rill::test
