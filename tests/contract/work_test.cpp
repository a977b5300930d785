// Rill's use of the borrowed handles.
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "contract/fixture.hpp"

namespace rill::test {
namespace {

/// The host's VkAllocationCallbacks, counting allocations.
struct CountingCallbacks {
  static inline std::atomic<int64_t> alive = 0, total = 0;
  static constexpr size_t kHeader = 64;

  static void* VKAPI_PTR allocate(void*, size_t size, size_t alignment, VkSystemAllocationScope) {
    const size_t room = std::max(kHeader, alignment);
    auto* block = static_cast<std::byte*>(std::aligned_alloc(room, (size + room + room - 1) / room * room));
    auto* header = reinterpret_cast<size_t*>(block + room) - 2;
    header[0] = size;
    header[1] = room;
    ++alive, ++total;
    return block + room;
  }
  static void VKAPI_PTR release(void*, void* memory) {
    if (!memory) return;
    --alive;
    std::free(static_cast<std::byte*>(memory) - static_cast<size_t*>(memory)[-1]);
  }
  static void* VKAPI_PTR reallocate(void* user, void* old, size_t size, size_t alignment, VkSystemAllocationScope scope) {
    void* block = size ? allocate(user, size, alignment, scope) : nullptr;
    if (old && block) std::memcpy(block, old, std::min(size, static_cast<size_t*>(old)[-2]));
    release(user, old);
    return block;
  }
};

TEST_F(Contract, NeverSubmitsWaitsOrCreatesDevices) {
  {
    auto made = client();
    ASSERT_TRUE(made);
    frames(*made, 2);
  }
  const auto lookedUp = interceptor().lookedUp();
  EXPECT_TRUE(lookedUp.contains("vkCmdDispatch"));
  for (const std::string& name : lookedUp)
    for (const char* never : {"Submit", "Wait", "vkQueue", "vkCreateInstance", "vkCreateDevice", "Fence", "Semaphore", "vkGetDeviceQueue",
                              "vkEnumeratePhysicalDevice", "vkEnumerateInstance", "Swapchain", "CommandPool", "CommandBuffer",
                              "vkDestroyDevice", "vkDestroyInstance"})
      EXPECT_EQ(name.find(never), std::string::npos) << name;
}

TEST_F(Contract, CreatesPipelinesThroughHostCache) {
  const VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  VkPipelineCache cache = VK_NULL_HANDLE;
  ASSERT_EQ(host().vk.CreatePipelineCache(host().device, &info, nullptr, &cache), VK_SUCCESS);
  size_t empty = 0, full = 0;
  ASSERT_EQ(host().vk.GetPipelineCacheData(host().device, cache, &empty, nullptr), VK_SUCCESS);
  {
    HostDevice hostDevice = host().hostDevice();
    hostDevice.cache = cache;
    ASSERT_TRUE(client(hostDevice));
  }
  size_t pipelines = 0;
  for (const Interceptor::Call& call : interceptor().calls()) {
    if (call.name != "vkCreateComputePipelines" && call.name != "vkCreateGraphicsPipelines") continue;
    EXPECT_EQ(call.cache, cache);
    ++pipelines;
  }
  EXPECT_GT(pipelines, 10u);
  ASSERT_EQ(host().vk.GetPipelineCacheData(host().device, cache, &full, nullptr), VK_SUCCESS) << "still the host's after ~Device";
  EXPECT_GE(full, empty);
  host().vk.DestroyPipelineCache(host().device, cache, nullptr);
}

TEST_F(Contract, UsesHostCallbacksForEveryObject) {
  CountingCallbacks::alive = CountingCallbacks::total = 0;
  const VkAllocationCallbacks callbacks{
      nullptr, &CountingCallbacks::allocate, &CountingCallbacks::reallocate, &CountingCallbacks::release, nullptr, nullptr};
  {
    HostDevice hostDevice = host().hostDevice();
    hostDevice.callbacks = &callbacks;
    auto made = client(hostDevice);
    ASSERT_TRUE(made);
    frames(*made, 2);
  }
  ASSERT_FALSE(interceptor().calls().empty());
  for (const Interceptor::Call& call : interceptor().calls()) EXPECT_EQ(call.callbacks, &callbacks) << call.name;
  EXPECT_GT(CountingCallbacks::total, 0);
  EXPECT_EQ(CountingCallbacks::alive, 0);
}

TEST_F(Contract, DestroysEverythingByDeviceDestruction) {
  {
    auto made = client();
    ASSERT_TRUE(made);
    frames(*made, 3);
    EXPECT_FALSE(interceptor().liveObjects().empty());
  }
  for (const auto& [kind, count] : interceptor().liveObjects()) ADD_FAILURE() << count << " leaked objects of type " << kind;
}

TEST_F(Contract, RepeatedFrameCreatesOnlyViews) {
  auto made = client();
  ASSERT_TRUE(made);
  frames(*made, 4);
  interceptor().clearCalls();
  const auto before = interceptor().liveObjects();
  frames(*made, 8);
  EXPECT_EQ(interceptor().createCount("View"), 0u);
  for (const Interceptor::Call& call : interceptor().calls()) EXPECT_NE(call.name.find("View"), std::string::npos) << call.name;
  EXPECT_EQ(interceptor().liveObjects(), before) << "views are destroyed as they are made";
}

TEST_F(Contract, AllocatesAndFreesOnlyInDocumentedCalls) {
  {
    auto made = client();
    ASSERT_TRUE(made);
    frames(*made, 4);
  }
  std::set<std::string> allocates, frees;
  for (const Interceptor::Call& call : interceptor().calls()) {
    if (call.name == "vkAllocateMemory") allocates.insert(call.during);
    if (call.name == "vkFreeMemory") frees.insert(call.during);
  }
  EXPECT_EQ(allocates, (std::set<std::string>{"create", "prepare"}));
  EXPECT_EQ(frees, (std::set<std::string>{"beginFrame", "~Device"}));
}

TEST_F(Contract, OnlyFrameClockTriggersFrees) {
  auto made = client();
  ASSERT_TRUE(made);
  frames(*made, 4);
  const auto memory = [&] { return interceptor().liveObjects()["DeviceMemory"]; };
  const int64_t before = memory();
  made->draws = false;  // the rendered images are no longer needed
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(made->frame(Client::Submission::Submitted, false));
    EXPECT_GE(memory(), before) << "the clock has not reported these completed frames";
  }
  const int64_t images = interceptor().liveObjects()["Image"];
  EXPECT_GT(images, 0);
  made->clock.completed = made->clock.recording;
  (void)made->readback();
  EXPECT_LT(interceptor().liveObjects()["Image"], images);
}

TEST_F(Contract, MovedHandlesContinue) {
  std::vector<std::byte> bits[2];
  for (const bool moves : {false, true}) {
    auto made = client();
    ASSERT_TRUE(made);
    if (moves) made->moveHandles();  // before the start state and the environment have been copied
    frames(*made, 1);
    ASSERT_TRUE(made->frame(Client::Submission::Submitted, false));
    if (moves) made->moveHandles();  // with a frame in flight
    frames(*made, 2);
    bits[moves] = made->readback();
  }
  EXPECT_FALSE(bits[0].empty());
  EXPECT_TRUE(bits[0] == bits[1]);
}

TEST_F(Contract, AbandonedFrameHasNoEffect) {
  std::vector<std::byte> plain;
  {
    auto made = client();
    ASSERT_TRUE(made);
    frames(*made, 3);
    plain = made->readback();
  }
  ASSERT_FALSE(plain.empty());
  auto made = client();
  ASSERT_TRUE(made);
  ASSERT_TRUE(made->frame(Client::Submission::Abandoned)) << "this frame contains the particle upload";
  EXPECT_TRUE(made->readback().empty());
  frames(*made, 1);
  ASSERT_TRUE(made->frame(Client::Submission::Abandoned));
  ASSERT_TRUE(made->frame(Client::Submission::Abandoned));
  frames(*made, 2);
  EXPECT_TRUE(made->readback() == plain);
}

TEST_F(Contract, AbandonsSeveralRecordedFrames) {
  std::vector<std::byte> plain;
  {
    auto made = client();
    ASSERT_TRUE(made);
    frames(*made, 3);
    plain = made->readback();
  }
  auto made = client();
  ASSERT_TRUE(made);
  frames(*made, 1);
  std::vector<uint64_t> thrown;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(made->frame(Client::Submission::Discarded, false));
    thrown.push_back(made->clock.recording);
  }
  for (const uint64_t frame : thrown) made->device().abandon(frame);
  frames(*made, 2);
  EXPECT_TRUE(made->readback() == plain);
}

TEST_F(Contract, PrintsNothing) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  {
    auto made = Client::open(host(), host().hostDevice());
    if (made) (void)(*made)->frame();
    HostDevice lacking = host().hostDevice();
    lacking.device = VK_NULL_HANDLE;
    (void)Device::borrow(lacking);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST_F(Contract, AnyThreadMayCallOneAtATime) {
  std::vector<std::byte> here, there;
  const auto lived = [&](bool elsewhere) {
    std::unique_ptr<Client> made;
    std::vector<std::byte> bits;
    const auto onThread = [&](auto&& work) { elsewhere ? std::thread(work).join() : work(); };
    onThread([&] { made = client(host().hostDevice(), false); });
    if (!made) return bits;
    for (int k = 0; k < 2; ++k) onThread([&] { frames(*made, 1); });
    onThread([&] { bits = made->readback(); });
    onThread([&] { made.reset(); });
    return bits;
  };
  here = lived(false);
  there = lived(true);
  EXPECT_FALSE(here.empty());
  EXPECT_TRUE(here == there);
}

TEST_F(Contract, TwoThreadsUseTwoDevicesOfOneVkDevice) {
  const VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  VkPipelineCache cache = VK_NULL_HANDLE;
  ASSERT_EQ(host().vk.CreatePipelineCache(host().device, &info, nullptr, &cache), VK_SUCCESS);
  HostDevice hostDevice = host().hostDevice();
  hostDevice.cache = cache;
  std::vector<std::byte> bits[2];
  const auto live = [&](int k) {
    auto made = client(hostDevice, false);
    if (!made) return;
    frames(*made, 4);
    bits[k] = made->readback();
  };
  std::thread other(live, 1);
  live(0);
  other.join();
  EXPECT_FALSE(bits[0].empty());
  EXPECT_TRUE(bits[0] == bits[1]);
  host().vk.DestroyPipelineCache(host().device, cache, nullptr);
}

TEST_F(Contract, CompileReportsDeclarationErrors) {
  Graph graph;
  const BufferRef nothing = graph.create("nothing", {0});
  (void)graph.readback(nothing);
  const auto refused = graph.compile();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  EXPECT_NE(refused.error().message.find("nothing"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace rill::test
