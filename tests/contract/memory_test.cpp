// Device memory from the host's own allocator.
#include <cstring>
#include <list>
#include <optional>

#include "contract/fixture.hpp"
#include "gpu/resources.hpp"

namespace rill::test {
namespace {

/// Suballocates at unusual offsets and tracks the outstanding blocks.
class TestAllocator {
 public:
  explicit TestAllocator(Host& host) : host_(host) { host.vki.GetPhysicalDeviceMemoryProperties(host.physical, &properties_); }

  MemoryHooks hooks() {
    return {this,
            [](void* user, const MemoryRequest* request, MemoryBlock* block) {
              return static_cast<TestAllocator*>(user)->lend(*request, *block);
            },
            [](void* user, const MemoryBlock* block) { static_cast<TestAllocator*>(user)->release(*block); }};
  }

  struct Piece {
    std::string name;
    bool images = false, mapped = false;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t bytes = 0;
    int freed = 0;
  };
  std::list<Piece> pieces;
  size_t outstanding() const {
    size_t count = 0;
    for (const Piece& piece : pieces) count += piece.freed == 0;
    return count;
  }
  void (*corrupt)(const MemoryRequest&, MemoryBlock&) = nullptr;  ///< makes the returned block invalid
  VkResult result = VK_SUCCESS;

 private:
  VkResult lend(const MemoryRequest& request, MemoryBlock& block) {
    if (result != VK_SUCCESS) return result;
    const VkMemoryRequirements& needs = request.requirements;
    Piece piece{request.name, request.images, request.mapped, VK_NULL_HANDLE, needs.size, 0};
    const auto type = typeFor(needs.memoryTypeBits, request.required | request.preferred, request.required);
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size + 3 * needs.alignment, type};
    const VkResult made = host_.vk.AllocateMemory(host_.device, &info, nullptr, &piece.memory);
    if (made != VK_SUCCESS) return made;
    block.memory = piece.memory;
    block.offset = 3 * needs.alignment;
    block.memoryType = type;
    if (request.mapped) {
      void* base = nullptr;
      if (VkResult r = host_.vk.MapMemory(host_.device, piece.memory, 0, VK_WHOLE_SIZE, 0, &base); r != VK_SUCCESS) return r;
      block.mapped = static_cast<std::byte*>(base) + block.offset;
    }
    pieces.push_back(piece);
    block.handle = &pieces.back();
    if (corrupt) corrupt(request, block);
    return VK_SUCCESS;
  }
  void release(const MemoryBlock& block) {
    auto& piece = *static_cast<Piece*>(block.handle);
    if (piece.freed++ == 0) host_.vk.FreeMemory(host_.device, piece.memory, nullptr);
  }
  uint32_t typeFor(uint32_t allowed, VkMemoryPropertyFlags best, VkMemoryPropertyFlags least) const {
    for (const VkMemoryPropertyFlags wanted : {best, least})
      for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (properties_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return 0;
  }
  Host& host_;
  VkPhysicalDeviceMemoryProperties properties_{};
};

class ContractMemory : public Contract {
 protected:
  void SetUp() override {
    Contract::SetUp();
    if (HasFatalFailure()) return;
    allocator_.emplace(host());
    hooks_ = allocator_->hooks();
  }
  HostDevice borrowDevice() {
    HostDevice hostDevice = host().hostDevice();
    hostDevice.memory = &hooks_;
    return hostDevice;
  }
  TestAllocator& allocator() { return *allocator_; }
  void expectEachFreedOnce() {
    for (const TestAllocator::Piece& piece : allocator().pieces) EXPECT_EQ(piece.freed, 1) << piece.name;
  }

  MemoryHooks hooks_;

 private:
  std::optional<TestAllocator> allocator_;
};

TEST_F(ContractMemory, AllocatesAllMemoryThroughHooks) {
  std::vector<std::byte> plain, hooked;
  {
    auto made = client();
    ASSERT_TRUE(made);
    frames(*made, 2);
    plain = made->readback();
  }
  interceptor().clearCalls();
  {
    auto made = client(borrowDevice());
    ASSERT_TRUE(made);
    frames(*made, 2);
    hooked = made->readback();
    bool images = false, buffers = false, mapped = false;
    for (const TestAllocator::Piece& piece : allocator().pieces) {
      EXPECT_FALSE(piece.name.empty());
      EXPECT_GT(piece.bytes, 0u);
      (piece.images ? images : buffers) = true;
      mapped |= piece.mapped;
    }
    EXPECT_TRUE(images && buffers && mapped);
  }
  for (const Interceptor::Call& call : interceptor().calls())
    EXPECT_TRUE(call.name != "vkAllocateMemory" && call.name != "vkFreeMemory") << call.name;
  expectEachFreedOnce();
  EXPECT_FALSE(hooked.empty());
  EXPECT_TRUE(hooked == plain) << "where memory comes from makes no difference";
}

TEST_F(ContractMemory, FreesBlocksOnlyAfterTheirFrame) {
  auto device = Device::borrow(borrowDevice());
  ASSERT_TRUE(device);
  device->beginFrame({5, 3});
  {
    auto buffer = createBuffer(*device, "short-lived", 4096);
    ASSERT_TRUE(buffer);
    EXPECT_EQ(allocator().outstanding(), 1u);
  }
  EXPECT_EQ(allocator().outstanding(), 1u) << "frame 5 may use it";
  device->beginFrame({6, 4});
  EXPECT_EQ(allocator().outstanding(), 1u) << "frame 5 has not completed";
  device->beginFrame({7, 5});
  EXPECT_EQ(allocator().outstanding(), 0u);
  expectEachFreedOnce();
}

TEST_F(ContractMemory, DeviceDestructorFreesRemainingBlocks) {
  auto device = Device::borrow(borrowDevice());
  ASSERT_TRUE(device);
  hooks_ = {};  // what it points to was read by borrow() alone
  { auto buffer = createBuffer(*device, "short-lived", 4096); }
  EXPECT_EQ(allocator().outstanding(), 1u);
  { const Device destroyed = *std::move(device); }
  expectEachFreedOnce();
}

TEST_F(ContractMemory, RepeatedFrameAllocatesNoMemory) {
  auto made = client(borrowDevice());
  ASSERT_TRUE(made);
  frames(*made, 4);
  const size_t before = allocator().pieces.size();
  frames(*made, 6);
  EXPECT_EQ(allocator().pieces.size(), before);
}

TEST_F(ContractMemory, RejectsAndFreesInvalidBlocks) {
  auto device = Device::borrow(borrowDevice());
  ASSERT_TRUE(device);
  const struct {
    void (*corrupt)(const MemoryRequest&, MemoryBlock&);
    const char* message;
  } table[] = {{[](const MemoryRequest&, MemoryBlock& block) { ++block.offset; }, "not a multiple of"},
               {[](const MemoryRequest&, MemoryBlock& block) { block.mapped = nullptr; }, "no mapped address"},
               {[](const MemoryRequest&, MemoryBlock& block) { block.memory = VK_NULL_HANDLE; }, "no VkDeviceMemory"},
               {[](const MemoryRequest&, MemoryBlock& block) { block.memoryType = 31; }, "not an allowed type"}};
  for (const auto& row : table) {
    allocator().corrupt = row.corrupt;
    const auto refused = createBuffer(*device, "positions", 4096, MemoryKind::Upload);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
    EXPECT_NE(refused.error().message.find("buffer 'positions'"), std::string::npos) << refused.error().message;
    EXPECT_NE(refused.error().message.find(row.message), std::string::npos) << refused.error().message;
    expectEachFreedOnce();
  }
}

TEST_F(ContractMemory, ReturnsAllocatorError) {
  auto device = Device::borrow(borrowDevice());
  ASSERT_TRUE(device);
  allocator().result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const auto refused = createBuffer(*device, "positions", 4096);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::OutOfMemory);
  EXPECT_NE(refused.error().message.find("'positions'"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace rill::test
