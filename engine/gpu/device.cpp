#include <algorithm>
#include <tuple>

#include "gpu/device_impl.hpp"
#include "gpu/device_memory.hpp"
#include "gpu/requirements.hpp"
#include "gpu/shader_reload.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

std::string versionText(uint32_t v) {
  return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." +
         std::to_string(VK_API_VERSION_PATCH(v));
}

Error invalidHost(const std::string& what) { return {ErrorKind::BadInput, "Device::borrow: HostDevice::" + what}; }

void describe(DeviceImpl& impl, const HostDevice& host) {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, nullptr};
  VkPhysicalDeviceMaintenance3Properties allocations{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, &driver};
  VkPhysicalDeviceMaintenance4Properties buffers{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES, &allocations};
  VkPhysicalDeviceSubgroupSizeControlProperties sizes{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES, &buffers};
  VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES, &sizes};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup};
  impl.instance.GetPhysicalDeviceProperties2(host.physicalDevice, &properties);
  impl.instance.GetPhysicalDeviceMemoryProperties(host.physicalDevice, &impl.memory);
  impl.physical = host.physicalDevice;
  impl.limits = properties.properties.limits;
  impl.vendor = properties.properties.vendorID;
  impl.isCpu = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  impl.maxWorkgroupSubgroups = sizes.maxComputeWorkgroupSubgroups;
  impl.canSetSubgroupSize = (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;

  DeviceInfo& info = impl.info;
  info.name = properties.properties.deviceName;
  info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  info.api = versionText(properties.properties.apiVersion);
  for (uint32_t i = 0; i < impl.memory.memoryHeapCount; ++i)
    if (impl.memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      info.deviceLocalBytes = std::max<uint64_t>(info.deviceLocalBytes, impl.memory.memoryHeaps[i].size);
  const std::pair<uint64_t, std::string_view> limits[] = {{impl.limits.maxStorageBufferRange, "maxStorageBufferRange"},
                                                          {buffers.maxBufferSize, "maxBufferSize"},
                                                          {allocations.maxMemoryAllocationSize, "maxMemoryAllocationSize"}};
  std::tie(info.maxBufferBytes, info.maxBufferName) = *std::ranges::min_element(limits);
  info.maxBufferBytes &= ~uint64_t{15};  // createBuffer() rounds sizes up to that
  info.maxTexelBufferElements = impl.limits.maxTexelBufferElements;
  info.subgroupSize = subgroup.subgroupSize;
  info.minSubgroupSize = sizes.minSubgroupSize;
  info.maxSubgroupSize = sizes.maxSubgroupSize;
}

// Vendors: see docs/notes/reading-variant.md. Devices with only the guaranteed minimum of 65,536 texels use storage buffers: SwiftShader
// miscompiles the texel variant (shaders/shared/loops.glsl).
void chooseReads(DeviceImpl& impl, ArrayReads wanted) {
  constexpr uint32_t kNvidia = 0x10de, kFewTexels = 65536;
  DeviceInfo& info = impl.info;
  const auto choose = [&](bool texels, std::string_view because) {
    info.texelReads = texels;
    info.readsBecause = because;
  };
  if (wanted == ArrayReads::Storage) return choose(false, "requested");
  if (info.maxTexelBufferElements <= kFewTexels) return choose(false, "the device has too few texels in a buffer");
  if (wanted == ArrayReads::Texels) return choose(true, "requested");
  if (impl.vendor == kNvidia) return choose(false, "faster on NVIDIA's devices");
  choose(true, "as fast or faster on devices other than NVIDIA's");
}

/// The number of valid timestamp bits of the host's queue family, or -1 if the device has no such family.
int64_t timestampBits(const DeviceImpl& impl, const HostDevice& host, VkQueueFlags& queueFlags) {
  uint32_t count = 0;
  impl.instance.GetPhysicalDeviceQueueFamilyProperties(host.physicalDevice, &count, nullptr);
  if (host.queueFamily >= count) return -1;
  std::vector<VkQueueFamilyProperties> families(count);
  impl.instance.GetPhysicalDeviceQueueFamilyProperties(host.physicalDevice, &count, families.data());
  queueFlags = families[host.queueFamily].queueFlags;
  return families[host.queueFamily].timestampValidBits;
}

}  // namespace

Expected<Device> Device::borrow(const HostDevice& host) {
  if (!host.instance) return invalidHost("instance is null");
  if (!host.physicalDevice) return invalidHost("physicalDevice is null");
  if (!host.device) return invalidHost("device is null");
  if (!host.getInstanceProcAddr) return invalidHost("getInstanceProcAddr is null");
  if (!host.enabled) return invalidHost("enabled is null; expected the VkPhysicalDeviceFeatures2 chain passed to vkCreateDevice");
  if (host.apiVersion < VK_API_VERSION_1_3) return invalidHost("apiVersion is " + versionText(host.apiVersion) + "; expected 1.3 or newer");
  if (host.memory && !(host.memory->allocate && host.memory->free)) return invalidHost("memory: allocate or free is null");

  auto impl = std::make_unique<DeviceImpl>();
  impl->handle = host.device;
  impl->cache = host.cache;
  impl->callbacks = host.callbacks;
  if (host.memory) impl->hooks = *host.memory;
  if (const char* missing = impl->instance.load(host.getInstanceProcAddr, host.instance))
    return Error{ErrorKind::NoDevice, std::string("Vulkan instance function not found: ") + missing};
  if (auto ok = checkDevice(impl->instance, host.physicalDevice); !ok) return ok.error();
  if (auto ok = checkEnabled(*host.enabled); !ok) return ok.error();
  if (const char* missing = impl->vk.load(impl->instance.GetDeviceProcAddr, host.device))
    return Error{ErrorKind::NoDevice, std::string("Vulkan device function not found: ") + missing};
  VkQueueFlags queueFlags = 0;
  const int64_t bits = timestampBits(*impl, host, queueFlags);
  if (bits < 0) return invalidHost("queueFamily is " + std::to_string(host.queueFamily) + "; the device has no such family");
  if (!(queueFlags & VK_QUEUE_COMPUTE_BIT))
    return invalidHost("queueFamily is " + std::to_string(host.queueFamily) + "; expected a family with compute");
  impl->hasGraphics = (queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0;
  impl->timestampMask = bits == 0 ? 0 : bits >= 64 ? ~0ull : (1ull << bits) - 1;
  describe(*impl, host);
  impl->reconvergence = reconvergenceOf(*host.enabled);
  chooseReads(*impl, host.reads);
  impl->hasMemoryBudget =
      hasExtension(impl->instance.EnumerateDeviceExtensionProperties, host.physicalDevice, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
  impl->reload = ShaderReload::fromEnvironment();
  return Device(std::move(impl));
}

Device::Device(std::unique_ptr<DeviceImpl> impl) : impl_(std::move(impl)) { impl_->device = this; }
Device::~Device() = default;
Device::Device(Device&& other) noexcept : impl_(std::move(other.impl_)) {
  if (impl_) impl_->device = this;
}
Device& Device::operator=(Device&& other) noexcept {
  impl_ = std::move(other.impl_);
  if (impl_) impl_->device = this;
  return *this;
}

void Device::beginFrame(FrameClock clock) {
  assert(clock.recording > clock.completed);
  assert(clock.recording >= impl_->clock.recording && clock.completed >= impl_->clock.completed);
  impl_->clock = clock;
  impl_->retired.collect(*impl_, clock.completed);
  if (impl_->reload) impl_->reload->poll(*impl_);
}

void Device::abandon(uint64_t frame) { impl_->abandon(frame); }
const DeviceInfo& Device::info() const { return impl_->info; }

uint64_t Device::availableBytes() const {
  if (!impl_->hasMemoryBudget || impl_->hooks) return impl_->info.deviceLocalBytes;
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT, nullptr};
  VkPhysicalDeviceMemoryProperties2 memory{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2, &budget};
  impl_->instance.GetPhysicalDeviceMemoryProperties2(impl_->physical, &memory);
  uint64_t most = 0;
  for (uint32_t i = 0; i < memory.memoryProperties.memoryHeapCount; ++i)
    if ((memory.memoryProperties.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) && budget.heapBudget[i] > budget.heapUsage[i])
      most = std::max<uint64_t>(most, budget.heapBudget[i] - budget.heapUsage[i]);
  return most;
}

void Device::setMessageCallback(MessageCallback callback) { impl_->message = std::move(callback); }

DeviceImpl::DeviceImpl() = default;

DeviceImpl::~DeviceImpl() {
  if (!vk.DestroyBuffer) return;  // borrow() failed before loading the function table
  retired.collect(*this, UINT64_MAX);
  pipelines.destroy(*this);
}

void DeviceImpl::abandon(uint64_t frame) { abandoned_[abandonedCount_++ % abandoned_.size()] = frame; }
bool DeviceImpl::abandoned(uint64_t frame) const {
  return frame != 0 && std::find(abandoned_.begin(), abandoned_.end(), frame) != abandoned_.end();
}

void RetireQueue::collect(DeviceImpl& device, uint64_t completed) {
  const auto done = [&](const Entry& entry) {
    if (entry.frame > completed) return false;
    switch (entry.type) {
#define RILL_DESTROY(type, Type, Destroy)                                                     \
  case type:                                                                                  \
    device.vk.Destroy(device.handle, reinterpret_cast<Type>(entry.handle), device.callbacks); \
    break;
      RILL_DESTROY(VK_OBJECT_TYPE_BUFFER, VkBuffer, DestroyBuffer)
      RILL_DESTROY(VK_OBJECT_TYPE_BUFFER_VIEW, VkBufferView, DestroyBufferView)
      RILL_DESTROY(VK_OBJECT_TYPE_IMAGE, VkImage, DestroyImage)
      RILL_DESTROY(VK_OBJECT_TYPE_IMAGE_VIEW, VkImageView, DestroyImageView)
      RILL_DESTROY(VK_OBJECT_TYPE_DESCRIPTOR_POOL, VkDescriptorPool, DestroyDescriptorPool)
      RILL_DESTROY(VK_OBJECT_TYPE_QUERY_POOL, VkQueryPool, DestroyQueryPool)
      RILL_DESTROY(VK_OBJECT_TYPE_PIPELINE, VkPipeline, DestroyPipeline)
#undef RILL_DESTROY
      default:
        assert(false && "unsupported object type");
    }
    return true;
  };
  std::erase_if(entries_, done);
  std::erase_if(blocks_, [&](const Block& block) {  // after the objects bound to them
    if (block.frame > completed) return false;
    freeMemory(device, block.block);
    return true;
  });
}

}  // namespace rill
