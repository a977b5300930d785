#include "offline/context.hpp"

#include <algorithm>
#include <cassert>

#include "gpu/vulkan_error.hpp"
#include "offline/context_impl.hpp"

namespace rill::offline {

Expected<Context> Context::create(const ContextDesc& desc) {
  auto impl = std::make_unique<ContextImpl>();
  if (auto ok = impl->openLoader(); !ok) return ok.error();
  if (auto ok = impl->makeInstance(desc); !ok) return ok.error();
  if (auto ok = impl->chooseDevice(desc); !ok) return ok.error();
  if (auto ok = impl->makeDevice(desc); !ok) return ok.error();
  if (auto ok = impl->makeFrames(std::max(desc.framesInFlight, 1u)); !ok) return ok.error();
  return Context(std::move(impl));
}

Context::Context(std::unique_ptr<ContextImpl> impl) : impl_(std::move(impl)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

ContextImpl::~ContextImpl() {
  if (device) {
    if (vk.DeviceWaitIdle) (void)vk.DeviceWaitIdle(device);  // a lost device is destroyed as well
    rill.reset();
    if (pipelines) pipelines->save();
    pipelines.reset();
    if (timeline) vk.DestroySemaphore(device, timeline, nullptr);
    if (pool) vk.DestroyCommandPool(device, pool, nullptr);
    if (vk.DestroyDevice) vk.DestroyDevice(device, nullptr);
  }
  if (messenger)
    if (auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(get(instance, "vkDestroyDebugUtilsMessengerEXT")))
      destroy(instance, messenger, nullptr);
  if (instance && vki.DestroyInstance) vki.DestroyInstance(instance, nullptr);
}

Expected<void> ContextImpl::makeFrames(uint32_t count) {
  VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  poolInfo.queueFamilyIndex = queueFamily;
  if (VkResult r = vk.CreateCommandPool(device, &poolInfo, nullptr, &pool); r != VK_SUCCESS)
    return vulkanError(r, "creating a command pool");
  commandBuffers.resize(count);
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             count};
  if (VkResult r = vk.AllocateCommandBuffers(device, &allocate, commandBuffers.data()); r != VK_SUCCESS)
    return vulkanError(r, "allocating command buffers");
  VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, nullptr, VK_SEMAPHORE_TYPE_TIMELINE, 0};
  const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type, 0};
  if (VkResult r = vk.CreateSemaphore(device, &semaphore, nullptr, &timeline); r != VK_SUCCESS)
    return vulkanError(r, "creating a timeline semaphore");
  return {};
}

Expected<void> ContextImpl::waitFor(uint64_t frame) {
  if (frame > completed) {
    VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
    info.semaphoreCount = 1;
    info.pSemaphores = &timeline;
    info.pValues = &frame;
    if (VkResult r = vk.WaitSemaphores(device, &info, UINT64_MAX); r != VK_SUCCESS)
      return vulkanError(r, "waiting for frame " + std::to_string(frame) + " on " + deviceName);
  }
  // Not read from the semaphore, which may be further: a caller that waits for frames in order gets the figures of each.
  completed = std::max(completed, frame);
  rill->beginFrame({submitted + 1, completed});
  return {};
}

Expected<void> ContextImpl::updateCompleted() {
  uint64_t value = 0;
  if (VkResult r = vk.GetSemaphoreCounterValue(device, timeline, &value); r != VK_SUCCESS)
    return vulkanError(r, "reading the last completed frame of " + deviceName);
  completed = std::max(completed, value);
  rill->beginFrame({submitted + 1, completed});
  return {};
}

Device& Context::device() { return *impl_->rill; }
const Device& Context::device() const { return *impl_->rill; }

Expected<FrameClock> Context::beginFrame() {
  ContextImpl& c = *impl_;
  const uint64_t count = c.commandBuffers.size();
  const uint64_t frame = c.submitted + 1;
  if (auto ok = c.waitFor(frame > count ? frame - count : 0); !ok) return ok.error();
  if (auto ok = c.updateCompleted(); !ok) return ok.error();
  c.begun = true;
  return FrameClock{frame, c.completed};
}

Expected<VkCommandBuffer> Context::beginCommands() {
  ContextImpl& c = *impl_;
  if (!c.begun)
    if (auto begun = beginFrame(); !begun) return begun.error();
  const VkCommandBuffer commands = c.commandBuffers[(c.submitted + 1) % c.commandBuffers.size()];
  const VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                      nullptr};
  if (VkResult r = c.vk.BeginCommandBuffer(commands, &info); r != VK_SUCCESS) return vulkanError(r, "beginning a command buffer");
  return commands;
}

Expected<void> Context::endCommands(const SubmitSemaphores& semaphores) {
  ContextImpl& c = *impl_;
  const uint64_t frame = c.submitted + 1;
  const VkCommandBuffer commands = c.commandBuffers[frame % c.commandBuffers.size()];
  c.begun = false;
  const std::string doing = "frame " + std::to_string(frame) + " on " + c.deviceName;
  if (VkResult r = c.vk.EndCommandBuffer(commands); r != VK_SUCCESS) return vulkanError(r, "recording " + doing);
  std::vector<VkSemaphoreSubmitInfo> signal(semaphores.signal.begin(), semaphores.signal.end());
  VkSemaphoreSubmitInfo done{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  done.semaphore = c.timeline;
  done.value = frame;
  done.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  signal.push_back(done);
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = commands;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.waitSemaphoreInfoCount = uint32_t(semaphores.wait.size());
  submit.pWaitSemaphoreInfos = semaphores.wait.data();
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  submit.signalSemaphoreInfoCount = uint32_t(signal.size());
  submit.pSignalSemaphoreInfos = signal.data();
  if (VkResult r = c.vk.QueueSubmit2(c.queue, 1, &submit, VK_NULL_HANDLE); r != VK_SUCCESS) return vulkanError(r, "submitting " + doing);
  c.submitted = frame;
  return {};
}

Expected<void> Context::run(Graph& graph) {
  if (auto ok = graph.compile(); !ok) return ok;
  if (!impl_->begun)
    if (auto begun = beginFrame(); !begun) return begun.error();
  if (auto ok = graph.prepare(*impl_->rill); !ok) return ok;
  return submit([&](VkCommandBuffer commands) { graph.record(commands); });
}

Expected<void> Context::wait() { return impl_->waitFor(impl_->submitted); }

Expected<void> Context::waitFor(uint64_t frame) { return impl_->waitFor(frame); }

std::vector<std::string> Context::takeMessages() {
  const std::lock_guard lock(impl_->messagesMutex);
  return std::exchange(impl_->messages, {});
}

VkInstance Context::instance() const { return impl_->instance; }
VkPhysicalDevice Context::physicalDevice() const { return impl_->physicalDevice; }
VkDevice Context::vkDevice() const { return impl_->device; }
VkQueue Context::queue() const { return impl_->queue; }
uint32_t Context::queueFamily() const { return impl_->queueFamily; }
PFN_vkGetInstanceProcAddr Context::getInstanceProcAddr() const { return impl_->get; }

}  // namespace rill::offline
