// Handles, layouts and dispatch sizes in passes that record with the host's own pipelines.
#include <optional>

#include "graph_fixture.hpp"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace {

constexpr ImageDesc kDesc{VK_FORMAT_R32_SFLOAT, 64, 32};
constexpr uint32_t kSpirv[] = {0x07230203, 0x10000, 0, 1, 0};

class Handles : public GraphTest {
 protected:
  Handles() {
    auto borrowed = Device::borrow(vulkan.host());
    EXPECT_TRUE(borrowed);
    device = std::move(*borrowed);
    device->beginFrame({1, 0});
  }
  ~Handles() override { owned.reset(); }
  void go() {
    auto ok = graph.compile();
    if (ok) ok = graph.prepare(*device);
    ASSERT_TRUE(ok) << ok.error().message;
    graph.record(NullVulkan::commandBuffer());
  }
  NullVulkan vulkan;
  std::optional<Device> device;
};

TEST_F(Handles, BufferReturnsHandleOffsetAndRange) {
  const BufferRef given = graph.import("given", {fakeBuffer(7), 128, 64, Use::Nothing});
  BufferRef first = graph.create("first", {256}), second = graph.create("second", {512});
  VkDescriptorBufferInfo in{}, a{}, b{};
  graph.pass("look", [&](Pass& pass) {
    pass.read(given, Use::ComputeRead);
    first = pass.write(first, Use::ComputeWrite);
    second = pass.write(second, Use::ComputeWrite);
    pass.sideEffect();
    return [&](Commands& commands) {
      in = commands.buffer(given);
      a = commands.buffer(first);
      b = commands.buffer(second);
    };
  });
  go();
  EXPECT_EQ(in.buffer, fakeBuffer(7));
  EXPECT_EQ(in.offset, 128u);
  EXPECT_EQ(in.range, 64u);
  EXPECT_NE(a.buffer, VkBuffer(VK_NULL_HANDLE));
  EXPECT_EQ(a.buffer, b.buffer) << "same heap";
  EXPECT_TRUE(a.offset + a.range <= b.offset || b.offset + b.range <= a.offset);
}

// Without kernels, usage flags and views follow from the declared uses alone.
TEST_F(Handles, ImageUsageAndViewsFollowFromUses) {
  ImageRef image = graph.create("image", {VK_FORMAT_R32_SFLOAT, 64, 32, 2}), copied = graph.create("copied", kDesc);
  ImageRef second = graph.level(image, 1);
  ImageHandle written{}, read{}, other{}, bare{};
  graph.pass("write", [&](Pass& pass) {
    image = pass.write(image, Use::ComputeWrite);
    second = pass.write(second, Use::ComputeWrite);
    copied = pass.write(copied, Use::CopyTarget);
    return [&, image, second, copied](Commands& commands) {
      written = commands.image(image);
      other = commands.image(second);
      bare = commands.image(copied);
    };
  });
  graph.pass("read", [&](Pass& pass) {
    pass.read(image, Use::ComputeSampled);
    pass.read(second, Use::ComputeSampled);
    pass.read(copied, Use::CopySource);
    pass.sideEffect();
    return [&, image](Commands& commands) { read = commands.image(image); };
  });
  go();
  EXPECT_NE(written.image, VkImage(VK_NULL_HANDLE));
  EXPECT_NE(written.view, VkImageView(VK_NULL_HANDLE));
  EXPECT_EQ(written.layout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(read.image, written.image);
  EXPECT_EQ(read.view, written.view);
  EXPECT_EQ(read.layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_EQ(other.image, written.image);
  EXPECT_NE(other.view, written.view);
  EXPECT_EQ(other.level, 1u);
  EXPECT_EQ(bare.view, VkImageView(VK_NULL_HANDLE)) << "copies need no view";
  EXPECT_EQ(bare.layout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  EXPECT_EQ(implOf(graph).resources[image.index].usage, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
}

TEST_F(Handles, ThreeDimensionalDispatchIsNotFolded) {
  constexpr BindingKind kinds[] = {BindingKind::Storage};
  auto made = computePipeline(*device, {.shader = "host", .spirv = kSpirv, .bindings = kinds, .pushConstantBytes = 4});
  ASSERT_TRUE(made);
  BufferRef out = import("out");
  graph.pass("pass", [&](Pass& pass) {
    out = pass.write(out, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(*made, {out});
    return [=](Commands& commands) {
      commands.dispatch(kernel, {13, 8}, 1.0f);
      commands.dispatch(kernel, {2, 3, 4}, 1.0f);
      commands.dispatch(kernel, {2, 0, 4}, 1.0f);
    };
  });
  go();
  std::vector<std::array<uint64_t, 3>> sizes;
  for (const NullCommand& c : vulkan.commands)
    if (c.kind == NullCommand::Dispatch) sizes.push_back({c.a, c.b, c.c});
  EXPECT_EQ(sizes, (std::vector<std::array<uint64_t, 3>>{{13, 8, 1}, {2, 3, 4}}));
}

TEST_F(Handles, RejectsInvalidSpirvByName) {
  constexpr BindingKind kinds[] = {BindingKind::Storage};
  const auto refusal = [&](std::span<const uint32_t> spirv) {
    const auto made = computePipeline(*device, {.shader = "the host's", .spirv = spirv, .bindings = kinds});
    if (made) return std::string("made");
    EXPECT_EQ(made.error().kind, ErrorKind::Shader);
    return made.error().message;
  };
  constexpr uint32_t text[] = {0x65762322, 0x6f697372, 0x3634206e, 0x0a300000, 0}, other[] = {0x03022307, 0x100, 0, 0x1000000, 0};
  constexpr uint32_t cut[] = {0x07230203, 0x10000};
  const std::string none = "shader 'the host's': invalid SPIR-V; expected the magic number 0x07230203 and a header of five words";
  EXPECT_EQ(refusal(text), none);
  EXPECT_EQ(refusal(cut), none);
  EXPECT_EQ(refusal(other), "shader 'the host's': the SPIR-V has the wrong byte order; expected that of this machine");
  EXPECT_EQ(refusal({}), "shader 'the host's': no SPIR-V given, and no embedded shader has this name");
  EXPECT_EQ(refusal(kSpirv), "made");
  const VkFormat color = VK_FORMAT_R8G8B8A8_UNORM;
  const auto drawn = graphicsPipeline(
      *device,
      {.vertex = "quad", .fragment = "fill", .vertexSpirv = kSpirv, .fragmentSpirv = text, .bindings = kinds, .colors = {&color, 1}});
  ASSERT_FALSE(drawn);
  EXPECT_NE(drawn.error().message.find("shader 'fill': invalid SPIR-V"), std::string::npos) << drawn.error().message;
}

}  // namespace
}  // namespace rill::test
