// Records the plan into the host's command buffer. Nothing here fails or allocates.
#include <algorithm>
#include <cassert>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

// The limit per dimension that Vulkan guarantees; used on every device so that folding is the same everywhere.
constexpr uint64_t kMaxGroups = 65535;

void recordBarrier(const DeviceTable& vk, VkCommandBuffer commandBuffer, const PlannedBarrier& planned,
                   std::span<const VkImageMemoryBarrier2> images) {
  if (planned.empty()) return;
  const Scope& scope = planned.scope;
  const VkMemoryBarrier2 barrier{
      VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, scope.sourceStage, scope.sourceAccess, scope.targetStage, scope.targetAccess};
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.memoryBarrierCount = scope.empty() ? 0 : 1;
  dependency.pMemoryBarriers = &barrier;
  dependency.imageMemoryBarrierCount = planned.transitions.count;
  dependency.pImageMemoryBarriers = images.data() + planned.transitions.first;
  vk.CmdPipelineBarrier2(commandBuffer, &dependency);
}

}  // namespace

void GraphImpl::record(VkCommandBuffer commandBuffer) {
  assert(prepared && "call prepare() successfully before each record()");
  if (!prepared) return;
  prepared = false;  // descriptor sets and queries serve one recording only
  const DeviceTable& vk = device->vk;
  const bool stamp = !slot->timedNames.empty();
  if (stamp) vk.CmdResetQueryPool(commandBuffer, slot->queries, 0, uint32_t(slot->timedNames.size()) + 1);
  slot->timingsPending = stamp;
  uint32_t query = 0;
  const auto writeStamp = [&] {
    if (stamp) vk.CmdWriteTimestamp2(commandBuffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot->queries, query++);
  };
  writeStamp();
  Commands commands(*this, commandBuffer);
  for (uint32_t i = 0; i < passes.size(); ++i) {
    const PassData& pass = passes[i];
    if (!pass.alive) continue;
    recordBarrier(vk, commandBuffer, pass.barrier, imageBarriers);
    if (pass.readback) {
      for (const Readback& readback : readbacks) {
        if (readback.pass != i) continue;
        const VkBufferCopy region{resources[readback.resource].offset, readback.offset, readback.size};
        vk.CmdCopyBuffer(commandBuffer, resources[readback.resource].buffer, slot->readbacks[readback.buffer].handle(), 1, &region);
      }
    } else if (pass.record) {
      commands.pass_ = i;
      if (pass.targets.count != 0) beginTargets(pass, commandBuffer);
      pass.invoke(pass.record, commands);
      if (pass.targets.count != 0) vk.CmdEndRendering(commandBuffer);
    }
    writeStamp();
  }
  recordBarrier(vk, commandBuffer, finalBarrier, imageBarriers);
}

void GraphImpl::beginTargets(const PassData& pass, VkCommandBuffer commandBuffer) const {
  constexpr VkAttachmentLoadOp loads[] = {VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_DONT_CARE};
  static_assert(size_t(Load::Keep) == 0 && size_t(Load::Clear) == 1 && size_t(Load::Discard) == 2);
  std::array<VkRenderingAttachmentInfo, kMaxTargets> infos;
  uint32_t colors = 0;
  const VkRenderingAttachmentInfo* depth = nullptr;
  VkRect2D area{};
  for (uint32_t t = 0; t < pass.targets.count; ++t) {
    const Target& target = targets[pass.targets.first + t];
    const ResourceData& image = resources[target.resource];
    area.extent = {image.width(), image.height()};
    const bool isDepth = hasDepth(image.desc.format);
    // Colors from the front, depth in the last element.
    VkRenderingAttachmentInfo& info = infos[isDepth ? infos.size() - 1 : colors++];
    info = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view;
    info.imageLayout = useRow(isDepth ? Use::DepthTarget : Use::ColorTarget).layout;
    info.loadOp = loads[size_t(target.load)];
    info.storeOp = target.store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    info.clearValue = target.clear;
    if (isDepth) depth = &info;
  }
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = area;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = colors;
  rendering.pColorAttachments = infos.data();
  rendering.pDepthAttachment = depth;
  device->vk.CmdBeginRendering(commandBuffer, &rendering);
  const VkViewport viewport{0, 0, float(area.extent.width), float(area.extent.height), 0, 1};
  device->vk.CmdSetViewport(commandBuffer, 0, 1, &viewport);
  device->vk.CmdSetScissor(commandBuffer, 0, 1, &area);
}

const Access& GraphImpl::declaredAccess(uint32_t pass, ResourceRef ref) const {
  assert(ref.epoch == epoch && "ref of another graph or an earlier frame");
  const Access* access = accessOf(pass, ref.index);
  assert(access && "the pass did not declare this resource");
  // For a write, both the consumed and the returned version are valid.
  assert((ref.version == access->version || (access->write && ref.version + 1 == access->version)) &&
         "the pass declared another version of this resource");
  return *access;
}

void Commands::bind(Kernel kernel, std::span<const std::byte> push) {
  [[maybe_unused]] const Range own = graph_.passes[pass_].kernels;
  assert(kernel.index >= own.first && kernel.index < own.first + own.count && "the kernel belongs to another pass");
  const KernelData& data = graph_.kernels[kernel.index];
  const Pipeline& pipeline = *data.pipeline;
  assert(push.size() == pipeline.pushBytes && "size of the push constants differs from the pipeline's");
  const DeviceTable& vk = graph_.device->vk;
  vk.CmdBindPipeline(commandBuffer_, pipeline.bindPoint, pipeline.handle);
  if (data.bindings.count != 0) vk.CmdBindDescriptorSets(commandBuffer_, pipeline.bindPoint, pipeline.layout, 0, 1, &data.set, 0, nullptr);
  if (!push.empty()) vk.CmdPushConstants(commandBuffer_, pipeline.layout, pipeline.stages, 0, uint32_t(push.size()), push.data());
}

void Commands::dispatch(Kernel kernel, uint64_t groups, std::span<const std::byte> push) {
  if (groups == 0) return;
  bind(kernel, push);
  const uint64_t rows = (groups + kMaxGroups - 1) / kMaxGroups;
  assert(rows <= kMaxGroups);
  graph_.device->vk.CmdDispatch(commandBuffer_, uint32_t((groups + rows - 1) / rows), uint32_t(rows), 1);
}

Commands::Arguments Commands::argumentsAt(BufferRef arguments, uint64_t offset, [[maybe_unused]] uint64_t bytes) const {
  const ResourceData& resource = graph_.resources[arguments.index];
  assert(arguments.epoch == graph_.epoch && graph_.accessOf(pass_, arguments.index) && "declare indirect arguments with Use::Indirect");
  assert(offset % 4 == 0 && offset + bytes <= resource.size);
  return {resource.buffer, resource.offset + offset};
}

void Commands::dispatch(Kernel kernel, Groups groups, std::span<const std::byte> push) {
  if (groups.x == 0 || groups.y == 0 || groups.z == 0) return;
  assert(std::max({groups.x, groups.y, groups.z}) <= kMaxGroups);
  bind(kernel, push);
  graph_.device->vk.CmdDispatch(commandBuffer_, groups.x, groups.y, groups.z);
}

void Commands::dispatchIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, std::span<const std::byte> push) {
  const Arguments from = argumentsAt(arguments, offset, sizeof(VkDispatchIndirectCommand));
  bind(kernel, push);
  graph_.device->vk.CmdDispatchIndirect(commandBuffer_, from.buffer, from.offset);
}

void Commands::draw(Kernel kernel, uint32_t vertices, uint32_t instances, std::span<const std::byte> push) {
  if (vertices == 0 || instances == 0) return;
  bind(kernel, push);
  graph_.device->vk.CmdDraw(commandBuffer_, vertices, instances, 0, 0);
}

void Commands::drawIndirect(Kernel kernel, BufferRef arguments, uint64_t offset, std::span<const std::byte> push) {
  const Arguments from = argumentsAt(arguments, offset, sizeof(VkDrawIndirectCommand));
  bind(kernel, push);
  graph_.device->vk.CmdDrawIndirect(commandBuffer_, from.buffer, from.offset, 1, sizeof(VkDrawIndirectCommand));
}

void Commands::viewport(uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const VkViewport viewport{float(x), float(y), float(width), float(height), 0, 1};
  const VkRect2D scissor{{int32_t(x), int32_t(y)}, {width, height}};
  graph_.device->vk.CmdSetViewport(commandBuffer_, 0, 1, &viewport);
  graph_.device->vk.CmdSetScissor(commandBuffer_, 0, 1, &scissor);
}

void Commands::copy(BufferRef source, BufferRef target, uint64_t bytes, uint64_t sourceOffset, uint64_t targetOffset) {
  assert(source.epoch == graph_.epoch && target.epoch == graph_.epoch);
  assert(graph_.accessOf(pass_, source.index) && graph_.accessOf(pass_, target.index) && "the pass did not declare the copied buffers");
  const ResourceData& from = graph_.resources[source.index];
  const ResourceData& to = graph_.resources[target.index];
  assert(sourceOffset + bytes <= from.size && targetOffset + bytes <= to.size);
  if (bytes == 0) return;
  const VkBufferCopy region{from.offset + sourceOffset, to.offset + targetOffset, bytes};
  graph_.device->vk.CmdCopyBuffer(commandBuffer_, from.buffer, to.buffer, 1, &region);
}

void Commands::update(BufferRef target, std::span<const std::byte> bytes, uint64_t offset) {
  assert(target.epoch == graph_.epoch && graph_.accessOf(pass_, target.index) && "the pass did not declare the updated buffer");
  const ResourceData& to = graph_.resources[target.index];
  assert(offset % 4 == 0 && bytes.size() % 4 == 0 && bytes.size() <= 65536 && offset + bytes.size() <= to.size);
  graph_.device->vk.CmdUpdateBuffer(commandBuffer_, to.buffer, to.offset + offset, bytes.size(), bytes.data());
}

void Commands::fill(BufferRef target, uint32_t value, uint64_t offset, uint64_t bytes) {
  assert(target.epoch == graph_.epoch && graph_.accessOf(pass_, target.index) && "the pass did not declare the filled buffer");
  const ResourceData& to = graph_.resources[target.index];
  assert(offset % 4 == 0 && offset <= to.size);
  // Rounded down to whole words: up to 3 trailing bytes are not filled.
  const uint64_t size = std::min(bytes, to.size - offset) & ~3ull;
  if (size != 0) graph_.device->vk.CmdFillBuffer(commandBuffer_, to.buffer, to.offset + offset, size, value);
}

void Commands::copy(BufferRef source, ImageRef target, uint64_t offset) { copyWhole(source, target, offset, true); }
void Commands::copy(ImageRef source, BufferRef target, uint64_t offset) { copyWhole(target, source, offset, false); }

void Commands::copyWhole(BufferRef buffer, ImageRef image, uint64_t offset, bool toImage) {
  assert(buffer.epoch == graph_.epoch && image.epoch == graph_.epoch);
  assert(graph_.accessOf(pass_, buffer.index) && graph_.accessOf(pass_, image.index) &&
         "the pass did not declare the copied buffer and image");
  const ResourceData &bytes = graph_.resources[buffer.index], &texels = graph_.resources[image.index];
  const VkImageAspectFlags aspect = hasDepth(texels.desc.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  const VkBufferImageCopy region{bytes.offset + offset,        0,         0,
                                 {aspect, texels.level, 0, 1}, {0, 0, 0}, {texels.width(), texels.height(), 1}};
  const DeviceTable& vk = graph_.device->vk;
  if (toImage)
    vk.CmdCopyBufferToImage(commandBuffer_, bytes.buffer, texels.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  else
    vk.CmdCopyImageToBuffer(commandBuffer_, texels.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, bytes.buffer, 1, &region);
}

void Commands::copy(ImageRef source, ImageRef target) {
  (void)graph_.declaredAccess(pass_, source);
  (void)graph_.declaredAccess(pass_, target);
  const ResourceData &from = graph_.resources[source.index], &to = graph_.resources[target.index];
  assert(from.width() == to.width() && from.height() == to.height() && "the copied images differ in size");
  const auto whole = [](const ResourceData& image) {
    const VkImageAspectFlags aspect = hasDepth(image.desc.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    return VkImageSubresourceLayers{aspect, image.level, 0, 1};
  };
  const VkImageCopy region{whole(from), {}, whole(to), {}, {from.width(), from.height(), 1}};
  graph_.device->vk.CmdCopyImage(commandBuffer_, from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.image,
                                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::clear(ImageRef target, const VkClearColorValue& value) {
  assert(target.epoch == graph_.epoch && graph_.accessOf(pass_, target.index) && "the pass did not declare the cleared image");
  const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, graph_.resources[target.index].level, 1, 0, 1};
  graph_.device->vk.CmdClearColorImage(commandBuffer_, graph_.resources[target.index].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value,
                                       1, &whole);
}

VkCommandBuffer Commands::handle() const { return commandBuffer_; }

VkDescriptorBufferInfo Commands::buffer(BufferRef ref) const {
  (void)graph_.declaredAccess(pass_, ref);
  const ResourceData& buffer = graph_.resources[ref.index];
  return {buffer.buffer, buffer.offset, buffer.size};
}

ImageHandle Commands::image(ImageRef ref) const {
  const Access& access = graph_.declaredAccess(pass_, ref);
  const ResourceData& image = graph_.resources[ref.index];
  return {image.image, image.view, useRow(access.use).layout, image.level};
}

}  // namespace rill
