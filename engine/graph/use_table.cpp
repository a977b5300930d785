#include "graph/use_table.hpp"

#include <array>

namespace rill {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;  // a fill is a clear, a copy a copy: both
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

constexpr VkPipelineStageFlags2 kDraw = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepth = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

constexpr VkImageLayout kNoImage = VK_IMAGE_LAYOUT_UNDEFINED;

constexpr std::array<UseRow, kUseCount> kTable{{
    {Use::None, "None", 0, 0, 0, kNoImage, 0},
    {Use::ComputeRead, "ComputeRead", kCompute, kStorageRead, 0, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_USAGE_STORAGE_BIT},
    {Use::ComputeTexel, "ComputeTexel", kCompute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, kNoImage, 0},
    {Use::ComputeUniform, "ComputeUniform", kCompute, VK_ACCESS_2_UNIFORM_READ_BIT, 0, kNoImage, 0},
    {Use::ComputeSampled, "ComputeSampled", kCompute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
     VK_IMAGE_USAGE_SAMPLED_BIT},
    {Use::ComputeWrite, "ComputeWrite", kCompute, kStorageRead, kStorageWrite, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_USAGE_STORAGE_BIT},
    {Use::ComputeAtomic, "ComputeAtomic", kCompute, kStorageRead, kStorageWrite, kNoImage, 0},
    {Use::DrawRead, "DrawRead", kDraw, kStorageRead, 0, kNoImage, 0},
    {Use::DrawUniform, "DrawUniform", kDraw, VK_ACCESS_2_UNIFORM_READ_BIT, 0, kNoImage, 0},
    {Use::DrawSampled, "DrawSampled", kDraw, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
     VK_IMAGE_USAGE_SAMPLED_BIT},
    {Use::ColourTarget, "ColourTarget", VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
    {Use::DepthTarget, "DepthTarget", kDepth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
    {Use::Indirect, "Indirect", VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0, kNoImage, 0},
    {Use::CopySource, "CopySource", kTransfer, VK_ACCESS_2_TRANSFER_READ_BIT, 0, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
    {Use::CopyTarget, "CopyTarget", kTransfer, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_DST_BIT},
    {Use::HostRead, "HostRead", VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, 0, kNoImage, 0},
    {Use::Unknown, "Unknown", VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, kNoImage, 0},
}};

constexpr bool inOrder() {
  for (size_t i = 0; i < kTable.size(); ++i)
    if (size_t(kTable[i].use) != i) return false;
  return true;
}
static_assert(inOrder());

}  // namespace

const UseRow& useRow(Use use) { return kTable[size_t(use)]; }

}  // namespace rill
