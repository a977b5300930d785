// Images in the plan: layouts, memory, errors; and prepare() on a device that only records calls.
#include <algorithm>
#include <optional>

#include "bench/count_allocations.hpp"
#include "graph_fixture.hpp"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace {

constexpr ImageDesc kDesc{VK_FORMAT_R32_SFLOAT, 64, 32};
constexpr VkImageLayout kUndefined = VK_IMAGE_LAYOUT_UNDEFINED, kGeneral = VK_IMAGE_LAYOUT_GENERAL,
                        kSampledLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kSource = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                        kTarget = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;

class Images : public GraphTest {
 protected:
  static VkImage fakeImage(uint64_t n) { return reinterpret_cast<VkImage>(n); }
  ImageRef write(std::string_view pass, ImageRef image, Use use = Use::ComputeWrite, Load load = Load::Keep) {
    graph.pass(pass, [&](Pass& p) {
      image = p.write(image, use, load);
      return [](Commands&) {};
    });
    return image;
  }
  void read(std::string_view pass, ImageRef image, Use use = Use::ComputeSampled, bool root = true) {
    graph.pass(pass, [&](Pass& p) {
      p.read(image, use);
      if (root) p.sideEffect();
      return [](Commands&) {};
    });
  }
  std::vector<std::pair<VkImageLayout, VkImageLayout>> changes(const PlannedBarrier& barrier) {
    std::vector<std::pair<VkImageLayout, VkImageLayout>> list;
    for (uint32_t k = barrier.transitions.first; k < barrier.transitions.first + barrier.transitions.count; ++k)
      list.emplace_back(implOf(graph).transitions[k].from, implOf(graph).transitions[k].to);
    return list;
  }
  const PlannedBarrier& planned(size_t pass) { return implOf(graph).passes[pass].barrier; }
  Scope change(size_t pass) { return implOf(graph).transitions[planned(pass).transitions.first].scope; }
  using Changes = std::vector<std::pair<VkImageLayout, VkImageLayout>>;
};

TEST_F(Images, LayoutsFollowUses) {
  ImageRef image = write("clear", graph.create("image", kDesc), Use::CopyTarget);
  image = write("draw", image);
  read("look", image);
  read("look again", image);
  image = write("redraw", image, Use::ComputeWrite, Load::Discard);
  read("copy", image, Use::CopySource);
  compile();
  EXPECT_EQ(changes(planned(0)), (Changes{{kUndefined, kTarget}}));
  EXPECT_EQ(changes(planned(1)), (Changes{{kTarget, kGeneral}}));
  EXPECT_EQ(changes(planned(2)), (Changes{{kGeneral, kSampledLayout}}));
  EXPECT_TRUE(planned(3).empty()) << "a second read in the same layout needs no barrier";
  EXPECT_EQ(changes(planned(4)), (Changes{{kUndefined, kGeneral}})) << "discarded content need not be preserved";
  EXPECT_EQ(changes(planned(5)), (Changes{{kGeneral, kSource}}));
  EXPECT_EQ(change(1), (Scope{kTransfer, kTransferWrite, kCompute, kStorageRead | kStorageWrite}));
  EXPECT_EQ(change(2), (Scope{kCompute, kStorageWrite, kCompute, kSampled}));
  for (size_t pass = 0; pass < 6; ++pass) EXPECT_TRUE(planned(pass).scope.empty()) << "the layout transition is the only dependency";
}

TEST_F(Images, EqualLayoutsUseMemoryBarriers) {
  ImageRef image = write("draw", graph.create("image", kDesc));
  image = write("draw more", image);
  read("load", image, Use::ComputeRead);
  compile();
  EXPECT_EQ(changes(planned(0)).size(), 1u);
  EXPECT_TRUE(changes(planned(1)).empty());
  EXPECT_EQ(barrier(1), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead | kStorageWrite}));
  EXPECT_EQ(barrier(2), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead}));
}

TEST_F(Images, ImportsStartAndEndInDeclaredStates) {
  ImageRef kept = graph.import("kept", {fakeImage(1), kDesc, Use::ComputeSampled, Use::ComputeSampled});
  ImageRef drawn = graph.import("drawn", {fakeImage(2), kDesc, Use::Unknown, Use::CopySource});
  (void)graph.import("idle", {fakeImage(3), kDesc, Use::CopyTarget, Use::ComputeSampled});
  read("look", kept);
  drawn = write("draw", drawn);
  compile();
  EXPECT_TRUE(planned(0).empty());
  EXPECT_EQ(changes(planned(1)), (Changes{{kUndefined, kGeneral}}));
  EXPECT_EQ(changes(implOf(graph).finalBarrier), (Changes{{kGeneral, kSource}, {kTarget, kSampledLayout}}));
}

TEST_F(Images, UnreadImageIsCulled) {
  const ImageRef image = write("draw", graph.create("image", kDesc));
  read("look", image, Use::ComputeSampled, false);
  compile();
  EXPECT_FALSE(alive(0));
  EXPECT_FALSE(alive(1));
  EXPECT_TRUE(implOf(graph).plans[1].placements.empty());
}

TEST_F(Images, AliasImagesButNotBuffers) {
  for (int i = 0; i < 3; ++i) {
    const ImageRef image = write("draw", graph.create("image", kDesc));
    read("look", image);
    (void)GraphTest::write("store", graph.create("buffer", {256}));
  }
  compile();
  const auto& plan = implOf(graph).plans[1];
  ASSERT_EQ(plan.placements.size(), 3u);
  ASSERT_EQ(plan.heapSizes.size(), 1u);
  EXPECT_EQ(plan.heapSizes[0], 16ull * 64 * 32) << "an estimate, before the device is queried";
  // The first waits for the previous frame, the second for the first one's readers.
  EXPECT_EQ(change(3).sourceStage & kCompute, kCompute);
}

TEST_F(Images, ErrorsNameTheResource) {
  const auto after = [&](auto&& declare) {
    graph.reset();
    declare();
    return compileError();
  };
  EXPECT_EQ(after([&] { read("look", graph.create("image", kDesc)); }),
            "pass 'look' reads 'image', whose content is undefined; write it in an earlier pass");
  EXPECT_EQ(after([&] {
              read("look", graph.import("image", {fakeImage(1), kDesc, Use::Unknown, Use::Nothing}));
            }),
            "pass 'look' reads 'image', whose content is undefined; write it in an earlier pass");
  EXPECT_EQ(after([&] { read("look", write("draw", graph.create("image", kDesc)), Use::ComputeUniform); }),
            "pass 'look' reads 'image' with Use::ComputeUniform, which is not a read use an image");
  EXPECT_EQ(after([&] { GraphTest::read("look", import("buffer"), Use::ComputeSampled); }),
            "pass 'look' reads 'buffer' with Use::ComputeSampled, which is not a read use");
  EXPECT_EQ(after([&] { (void)graph.create("image", ImageDesc{VK_FORMAT_UNDEFINED, 1, 1}); }), "image 'image' has no format");
  EXPECT_EQ(after([&] {
              (void)graph.create("image", ImageDesc{VK_FORMAT_R32_SFLOAT, 1u << 30, 1u << 30});
            }),
            "image 'image' of 1073741824 x 1073741824 texels; expected at most 32768 per side");
  EXPECT_EQ(after([&] {
              (void)graph.import("one", {fakeImage(1), kDesc, Use::ComputeSampled, Use::Nothing});
              (void)graph.import("two", {fakeImage(1), kDesc, Use::ComputeSampled, Use::Nothing});
            }),
            "imports 'one' and 'two' overlap in the same VkImage; import the memory once");
  EXPECT_EQ(after([&] {
              (void)write("add", graph.import("image", {fakeImage(1), kDesc, Use::ComputeRead, Use::Nothing}), Use::ComputeAtomic);
            }),
            "pass 'add' writes 'image' with Use::ComputeAtomic, which is not a write use an image");
  EXPECT_EQ(after([&] { (void)graph.create("image", ImageDesc{VK_FORMAT_R32_SFLOAT, 0, 1}); }), "image 'image': size is 0");
  EXPECT_EQ(after([&] {
              (void)graph.import("image", ImageImport{VK_NULL_HANDLE, kDesc, Use::Nothing, Use::Nothing});
            }),
            "import 'image': null handle, expected a VkImage");
  EXPECT_EQ(after([&] {
              (void)graph.import("image", {fakeImage(1), kDesc, Use::HostRead, Use::Nothing});
            }),
            "import 'image': Use::HostRead is not a use of an image");
  EXPECT_EQ(after([&] {
              const ImageRef image = write("draw", graph.create("image", kDesc));
              graph.pass("look", [&](Pass& p) {
                p.read(image, Use::ComputeSampled);
                p.read(image, Use::ComputeRead);
                return [](Commands&) {};
              });
            }),
            "pass 'look' reads 'image' with Use::ComputeSampled and Use::ComputeRead, which need different layouts; use two passes");
  FakePipeline storage({BindingKind::Storage}), sampled({BindingKind::SampledImage});
  for (auto* fake : {&storage, &sampled})
    EXPECT_EQ(after([&] {
                graph.pass("draw", [&](Pass& p) {
                  const ImageRef image = p.write(graph.create("image", kDesc), Use::ComputeWrite);
                  (void)p.kernel(&fake->pipeline, {image});
                  return [](Commands&) {};
                });
              }),
              std::string("pass 'draw', shader 'fake': binding 0 is ") + (fake == &storage ? "a storage buffer" : "a sampled image") +
                  ", which matches no declared use of 'image'");
}

class ImagesOnNullDevice : public Images {
 protected:
  ImagesOnNullDevice() {
    auto borrowed = Device::borrow(vulkan.host());
    EXPECT_TRUE(borrowed);
    device = std::move(*borrowed);
    vulkan.commands.reserve(1 << 14);
    vulkan.imageBarriers.reserve(1 << 14);
  }
  ~ImagesOnNullDevice() override { owned.reset(); }
  Expected<void> frame(uint32_t count, uint32_t width) {
    ++clock.recording;
    clock.completed = clock.recording - 2;
    device->beginFrame(clock);
    graph.reset();
    vulkan.commands.clear();
    vulkan.imageBarriers.clear();
    for (uint32_t i = 0; i < count; ++i) {
      ImageRef image = graph.create("image", ImageDesc{VK_FORMAT_R32_SFLOAT, width, 64});
      graph.pass("clear", [&](Pass& p) {
        image = p.write(image, Use::CopyTarget);
        return [image](Commands& commands) { commands.clear(image, {}); };
      });
      BufferRef copy = graph.create("copy", {uint64_t{width} * 64 * 4});
      graph.pass("copy", [&](Pass& p) {
        p.read(image, Use::CopySource);
        copy = p.write(copy, Use::CopyTarget);
        p.sideEffect();
        return [=](Commands& commands) { commands.copy(image, copy); };
      });
    }
    auto ok = graph.compile();
    if (ok) ok = graph.prepare(*device);
    if (ok) graph.record(NullVulkan::commandBuffer());
    return ok;
  }
  NullVulkan vulkan;
  std::optional<Device> device;
  FrameClock clock;
};

TEST_F(ImagesOnNullDevice, AreCreatedOnceWithQueriedSizes) {
  ASSERT_TRUE(frame(4, 64));
  EXPECT_EQ(vulkan.imagesCreated, 1u) << "four with disjoint lifetimes share one image";
  EXPECT_EQ(implOf(graph).plans[1].heapSizes[0], 64u * 64 * 4) << "not the estimate";
  EXPECT_EQ(vulkan.count(NullCommand::ClearImage), 4u);
  EXPECT_EQ(vulkan.count(NullCommand::CopyFromImage), 4u);
  for (const NullCommand& c : vulkan.commands)
    if (c.kind == NullCommand::Barrier) { EXPECT_LE(c.handle, 1u); }
  ASSERT_EQ(vulkan.imageBarriers.size(), 8u) << "for the clear and for the copy of each";
  const VkImage image = vulkan.imageBarriers[0].image;
  for (size_t k = 0; k < 8; ++k) {
    const VkImageMemoryBarrier2& b = vulkan.imageBarriers[k];
    EXPECT_EQ(b.image, image);
    EXPECT_EQ(b.oldLayout, k % 2 ? kTarget : kUndefined);
    EXPECT_EQ(b.newLayout, k % 2 ? kSource : kTarget);
    EXPECT_EQ(b.srcAccessMask & kTransferWrite, kTransferWrite) << "the first waits for the previous frame";
  }
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(frame(4, 64));
  EXPECT_EQ(vulkan.imagesCreated, 1u);
  ASSERT_TRUE(frame(4, 128));  // grows the heap and creates another image in it
  EXPECT_EQ(vulkan.imagesCreated, 2u);
}

TEST_F(ImagesOnNullDevice, SteadyStateAllocatesNothing) {
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(frame(4, 64));
  const int64_t live = vulkan.liveObjects;
  bool fine = true;
  bench::startCounting();
  for (int i = 0; i < 20; ++i) fine = bool(frame(4, 64)) && fine;
  EXPECT_EQ(bench::stopCounting(), 0u);
  EXPECT_TRUE(fine);
  EXPECT_EQ(vulkan.liveObjects, live);
}

TEST_F(ImagesOnNullDevice, DeviceErrorsNameTheImage) {
  auto ok = frame(1, 5000);
  ASSERT_FALSE(ok);
  EXPECT_NE(ok.error().message.find("image 'image' of 5000 x 64 texels"), std::string::npos) << ok.error().message;
  vulkan.allocationResult = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  ok = frame(1, 64);
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().kind, ErrorKind::OutOfMemory);
}

TEST_F(ImagesOnNullDevice, AreDestroyedWithTheGraph) {
  const int64_t before = vulkan.liveObjects;
  ASSERT_TRUE(frame(3, 64));
  ASSERT_TRUE(frame(3, 128));
  owned.reset();
  clock.completed = clock.recording;
  device->beginFrame(clock);
  EXPECT_EQ(vulkan.liveObjects, before);
}

}  // namespace
}  // namespace rill::test
