#include "graph/use_table.hpp"

#include <array>

namespace rill {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;  // covers both copies and fills (clears)
constexpr VkPipelineStageFlags2 kDraw = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepth = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 kSampledRead = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kUniformRead = VK_ACCESS_2_UNIFORM_READ_BIT;
constexpr VkAccessFlags2 kVertexRead = VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT;
constexpr VkAccessFlags2 kColorRead = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, kColorWrite = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags2 kDepthRead = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                         kDepthWrite = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

constexpr VkImageLayout kNoImage = VK_IMAGE_LAYOUT_UNDEFINED, kGeneral = VK_IMAGE_LAYOUT_GENERAL,
                        kReadOnly = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kColor = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                        kDepthStencil = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

constexpr VkBufferUsageFlags kStorageBuffer = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kUniformBuffer = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                             kTexelBuffer = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                             kVertexBuffer = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;

// Present: the submission's semaphore orders presentation after all commands and makes memory visible, so
// the transition needs no target access.
constexpr std::array<UseRow, kUseCount> kTable{{
    {Use::Nothing, "Nothing", 0, 0, 0, kNoImage, 0, 0},
    {Use::ComputeRead, "ComputeRead", kCompute, kStorageRead, 0, kGeneral, VK_IMAGE_USAGE_STORAGE_BIT, kStorageBuffer},
    {Use::ComputeTexel, "ComputeTexel", kCompute, kSampledRead, 0, kNoImage, 0, kTexelBuffer},
    {Use::ComputeUniform, "ComputeUniform", kCompute, kUniformRead, 0, kNoImage, 0, kUniformBuffer},
    {Use::ComputeSampled, "ComputeSampled", kCompute, kSampledRead, 0, kReadOnly, VK_IMAGE_USAGE_SAMPLED_BIT, 0},
    {Use::ComputeWrite, "ComputeWrite", kCompute, kStorageRead, kStorageWrite, kGeneral, VK_IMAGE_USAGE_STORAGE_BIT, kStorageBuffer},
    {Use::ComputeAtomic, "ComputeAtomic", kCompute, kStorageRead, kStorageWrite, kNoImage, 0, kStorageBuffer},
    {Use::DrawRead, "DrawRead", kDraw, kStorageRead, 0, kNoImage, 0, kStorageBuffer},
    {Use::DrawTexel, "DrawTexel", kDraw, kSampledRead, 0, kNoImage, 0, kTexelBuffer},
    {Use::DrawUniform, "DrawUniform", kDraw, kUniformRead, 0, kNoImage, 0, kUniformBuffer},
    {Use::DrawSampled, "DrawSampled", kDraw, kSampledRead, 0, kReadOnly, VK_IMAGE_USAGE_SAMPLED_BIT, 0},
    {Use::VertexInput, "VertexInput", VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT, kVertexRead, 0, kNoImage, 0, kVertexBuffer},
    {Use::ColorTarget, "ColorTarget", VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, kColorRead, kColorWrite, kColor,
     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0},
    {Use::DepthTarget, "DepthTarget", kDepth, kDepthRead, kDepthWrite, kDepthStencil, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0},
    {Use::Indirect, "Indirect", VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0, kNoImage, 0,
     VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT},
    {Use::CopySource, "CopySource", kTransfer, VK_ACCESS_2_TRANSFER_READ_BIT, 0, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_BUFFER_USAGE_TRANSFER_SRC_BIT},
    {Use::CopyTarget, "CopyTarget", kTransfer, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_BUFFER_USAGE_TRANSFER_DST_BIT},
    {Use::HostRead, "HostRead", VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, 0, kNoImage, 0, 0},
    {Use::Present, "Present", kAll, 0, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 0, 0},
    {Use::Unknown, "Unknown", kAll, VK_ACCESS_2_MEMORY_READ_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, kNoImage, 0, 0},
}};

constexpr bool inOrder() {
  for (size_t i = 0; i < kTable.size(); ++i)
    if (size_t(kTable[i].use) != i) return false;
  return true;
}
static_assert(inOrder());

/// All write accesses of Vulkan 1.3 and known extensions: a custom state may contain any of them.
constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_SHADER_WRITE_BIT | kColorWrite | kDepthWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                                   VK_ACCESS_2_HOST_WRITE_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | kStorageWrite |
                                   VK_ACCESS_2_TRANSFORM_FEEDBACK_WRITE_BIT_EXT | VK_ACCESS_2_TRANSFORM_FEEDBACK_COUNTER_WRITE_BIT_EXT |
                                   VK_ACCESS_2_COMMAND_PREPROCESS_WRITE_BIT_NV | VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;

}  // namespace

const UseRow& useRow(Use use) { return kTable[size_t(use)]; }

UseRow useRow(const ImportState& state) {
  if (!state.isCustom) return useRow(state.use);
  const UseState& custom = state.custom;
  return {Use::Nothing, "custom state", custom.stages, custom.access & ~kWrites, custom.access & kWrites, custom.layout, 0, 0};
}

UseState useState(Use use) {
  if (!isUse(use)) return {};
  const UseRow& row = useRow(use);
  return {row.stage, row.read | row.write, row.layout, row.usage, row.bufferUsage};
}

}  // namespace rill
