// Commands, which are recorded.
#include "support/null_functions.hpp"

namespace rill::test {
namespace {

template <class T>
uint64_t id(T handle) {
  return reinterpret_cast<uint64_t>(handle);
}
void add(NullCommand::Kind kind, uint64_t handle = 0, uint64_t a = 0, uint64_t b = 0, uint64_t c = 0) {
  current->commands.push_back({kind, {}, handle, a, b, c});
}
void cmdBarrier(VkCommandBuffer, const VkDependencyInfo* info) {
  current->imageBarriers.insert(current->imageBarriers.end(), info->pImageMemoryBarriers,
                                info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
  const VkMemoryBarrier2 memory = info->memoryBarrierCount ? info->pMemoryBarriers[0] : VkMemoryBarrier2{};
  current->commands.push_back({NullCommand::Barrier, memory, info->memoryBarrierCount, info->imageMemoryBarrierCount, 0, 0});
}
void cmdBindPipeline(VkCommandBuffer, VkPipelineBindPoint, VkPipeline pipeline) { add(NullCommand::BindPipeline, id(pipeline)); }
void cmdBindSets(VkCommandBuffer, VkPipelineBindPoint, VkPipelineLayout, uint32_t, uint32_t, const VkDescriptorSet* sets, uint32_t,
                 const uint32_t*) {
  add(NullCommand::BindSet, id(sets[0]));
}
void cmdPush(VkCommandBuffer, VkPipelineLayout, VkShaderStageFlags, uint32_t, uint32_t, const void*) {}
void cmdDispatch(VkCommandBuffer, uint32_t x, uint32_t y, uint32_t z) { add(NullCommand::Dispatch, 0, x, y, z); }
void cmdDispatchIndirect(VkCommandBuffer, VkBuffer buffer, VkDeviceSize offset) { add(NullCommand::DispatchIndirect, id(buffer), offset); }
void cmdBeginRendering(VkCommandBuffer, const VkRenderingInfo* info) {
  const VkRenderingAttachmentInfo* first = info->colorAttachmentCount ? info->pColorAttachments : info->pDepthAttachment;
  add(NullCommand::BeginRendering, info->colorAttachmentCount, first->loadOp, first->storeOp, info->pDepthAttachment != nullptr);
}
void cmdEndRendering(VkCommandBuffer) { add(NullCommand::EndRendering); }
void cmdDraw(VkCommandBuffer, uint32_t vertices, uint32_t instances, uint32_t, uint32_t) { add(NullCommand::Draw, 0, vertices, instances); }
void cmdDrawIndirect(VkCommandBuffer, VkBuffer buffer, VkDeviceSize offset, uint32_t, uint32_t) {
  add(NullCommand::DrawIndirect, id(buffer), offset);
}
void cmdScissor(VkCommandBuffer, uint32_t, uint32_t, const VkRect2D*) {}
void cmdViewport(VkCommandBuffer, uint32_t, uint32_t, const VkViewport*) {}
void cmdCopy(VkCommandBuffer, VkBuffer, VkBuffer target, uint32_t, const VkBufferCopy* region) {
  add(NullCommand::Copy, id(target), region->srcOffset, region->dstOffset, region->size);
}
void cmdUpdate(VkCommandBuffer, VkBuffer target, VkDeviceSize offset, VkDeviceSize bytes, const void*) {
  add(NullCommand::Update, id(target), offset, bytes);
}
void cmdCopyToImage(VkCommandBuffer, VkBuffer, VkImage target, VkImageLayout layout, uint32_t, const VkBufferImageCopy* region) {
  add(NullCommand::CopyToImage, id(target), layout, region->imageExtent.width, region->imageExtent.height);
}
void cmdCopyFromImage(VkCommandBuffer, VkImage source, VkImageLayout layout, VkBuffer, uint32_t, const VkBufferImageCopy* region) {
  add(NullCommand::CopyFromImage, id(source), layout, region->imageExtent.width, region->imageExtent.height);
}
void cmdCopyImage(VkCommandBuffer, VkImage, VkImageLayout, VkImage target, VkImageLayout layout, uint32_t, const VkImageCopy* region) {
  add(NullCommand::CopyImage, id(target), layout, region->extent.width, region->extent.height);
}
void cmdClearImage(VkCommandBuffer, VkImage target, VkImageLayout layout, const VkClearColorValue*, uint32_t,
                   const VkImageSubresourceRange*) {
  add(NullCommand::ClearImage, id(target), layout);
}
void cmdFill(VkCommandBuffer, VkBuffer target, VkDeviceSize offset, VkDeviceSize bytes, uint32_t value) {
  add(NullCommand::Fill, id(target), value, offset, bytes);
}
void cmdResetQueries(VkCommandBuffer, VkQueryPool, uint32_t, uint32_t count) { add(NullCommand::ResetQueries, 0, count); }
void cmdTimestamp(VkCommandBuffer, VkPipelineStageFlags2, VkQueryPool, uint32_t query) { add(NullCommand::Timestamp, 0, query); }

}  // namespace

PFN_vkVoidFunction nullCommand(std::string_view name) {
  RILL_NULL_FUNCTION(vkCmdBeginRendering, cmdBeginRendering)
  RILL_NULL_FUNCTION(vkCmdBindDescriptorSets, cmdBindSets)
  RILL_NULL_FUNCTION(vkCmdBindPipeline, cmdBindPipeline)
  RILL_NULL_FUNCTION(vkCmdClearColorImage, cmdClearImage)
  RILL_NULL_FUNCTION(vkCmdCopyBuffer, cmdCopy)
  RILL_NULL_FUNCTION(vkCmdCopyBufferToImage, cmdCopyToImage)
  RILL_NULL_FUNCTION(vkCmdCopyImage, cmdCopyImage)
  RILL_NULL_FUNCTION(vkCmdCopyImageToBuffer, cmdCopyFromImage)
  RILL_NULL_FUNCTION(vkCmdDispatch, cmdDispatch)
  RILL_NULL_FUNCTION(vkCmdDispatchIndirect, cmdDispatchIndirect)
  RILL_NULL_FUNCTION(vkCmdDraw, cmdDraw)
  RILL_NULL_FUNCTION(vkCmdDrawIndirect, cmdDrawIndirect)
  RILL_NULL_FUNCTION(vkCmdEndRendering, cmdEndRendering)
  RILL_NULL_FUNCTION(vkCmdFillBuffer, cmdFill)
  RILL_NULL_FUNCTION(vkCmdPipelineBarrier2, cmdBarrier)
  RILL_NULL_FUNCTION(vkCmdPushConstants, cmdPush)
  RILL_NULL_FUNCTION(vkCmdResetQueryPool, cmdResetQueries)
  RILL_NULL_FUNCTION(vkCmdSetScissor, cmdScissor)
  RILL_NULL_FUNCTION(vkCmdSetViewport, cmdViewport)
  RILL_NULL_FUNCTION(vkCmdUpdateBuffer, cmdUpdate)
  RILL_NULL_FUNCTION(vkCmdWriteTimestamp2, cmdTimestamp)
  return nullptr;
}

}  // namespace rill::test
