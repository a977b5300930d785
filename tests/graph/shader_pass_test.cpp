// Passes of embedded shaders: what they use follows from the names and kinds that reflection gives.
#include "graph/shader_pass.hpp"

#include <optional>
#include <set>

#include "gpu/device_impl.hpp"
#include "gpu/shader_constants.hpp"
#include "graph_fixture.hpp"
#include "support/null_vulkan.hpp"

namespace rill {
std::span<const EmbeddedShader> viewsShaders();
}

namespace rill::test {
namespace {

/// A pipeline without Vulkan objects, as reflection would describe it.
template <class AnyPipeline = ComputePipeline>
struct ReflectedPipeline {
  explicit ReflectedPipeline(std::initializer_list<ShaderBinding> bindings) {
    for (const ShaderBinding& binding : bindings) set.kinds.push_back(binding.kind);
    pipeline.shader = "count";
    pipeline.set = &set;
    pipeline.bindings = bindings;
    if constexpr (std::is_same_v<AnyPipeline, GraphicsPipeline>) pipeline.bindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  }
  SetLayout set;
  AnyPipeline pipeline;
};

constexpr ShaderBinding kKeys{"keys", BindingKind::Storage, false}, kCounts{"counts", BindingKind::Storage, true};

class ShaderPass : public GraphTest {
 protected:
  /// Of the first pass.
  Access access(ResourceRef ref) {
    const Access* found = implOf(graph).accessOf(0, ref.index);
    return found ? *found : Access{};
  }
  const ReflectedPipeline<> count{kKeys, kCounts};
};

TEST_F(ShaderPass, UsesFollowFromTheShader) {
  const ReflectedPipeline<> all{kKeys,
                                {"position", BindingKind::TexelFloat4},
                                {"params", BindingKind::Uniform},
                                {"picture", BindingKind::SampledImage},
                                {"target", BindingKind::StorageImage, true},
                                kCounts};
  const BufferRef keys = import("keys"), position = import("position"), params = import("params"), unused = import("unused");
  const ImageRef picture = graph.import("picture", {.handle = reinterpret_cast<VkImage>(uintptr_t{1}),
                                                    .desc = {VK_FORMAT_R32_SFLOAT, 4, 4},
                                                    .before = Use::ComputeSampled,
                                                    .after = Use::ComputeSampled});
  BufferRef counts = import("counts");
  ImageRef target = graph.create("target", {VK_FORMAT_R32_SFLOAT, 4, 4});
  const BufferRef before = counts;
  addDispatch(graph, "count", &all.pipeline, 1, NoPush{},
              {{"counts", counts},
               {"unused", unused},
               {"target", target},
               {"params", params},
               {"picture", picture},
               {"position", position},
               {"keys", keys}});
  read("result", counts);
  compile();
  EXPECT_EQ(access(keys).use, Use::ComputeRead);
  EXPECT_EQ(access(position).use, Use::ComputeTexel);
  EXPECT_EQ(access(params).use, Use::ComputeUniform);
  EXPECT_EQ(access(picture).use, Use::ComputeSampled);
  EXPECT_EQ(access(target).use, Use::ComputeWrite);
  EXPECT_EQ(access(counts).use, Use::ComputeWrite);
  EXPECT_TRUE(access(counts).keep) << "a shader may add to what is there";
  EXPECT_NE(counts.version, before.version) << "the ref becomes the version that the pass writes";
  EXPECT_EQ(access(unused).use, Use::Nothing) << "left alone";
}

TEST_F(ShaderPass, DispatchFromBufferReadsIt) {
  const BufferRef keys = import("keys"), arguments = import("arguments");
  BufferRef counts = import("counts");
  addDispatch(graph, "count", &count.pipeline, {arguments, 8}, NoPush{}, {{"keys", keys}, {"counts", counts}});
  compile();
  EXPECT_EQ(access(arguments).use, Use::Indirect);
}

TEST_F(ShaderPass, OldContentIsNeededUnderAGateOnly) {
  for (const bool gated : {false, true}) {
    graph.reset();
    const BufferRef keys = import("keys");
    BufferRef counts = import("counts");
    const int gate = 0;
    addDispatch(graph, "count", &count.pipeline, 1, NoPush{}, {{"keys", keys}, discardUnless(gated ? &gate : nullptr, {"counts", counts})});
    EXPECT_EQ(access(counts).keep, gated);
  }
}

TEST_F(ShaderPass, KernelsOfOnePassShareAWrite) {
  const BufferRef keys = import("keys");
  BufferRef counts = import("counts");
  graph.pass("count twice", [&](Pass& pass) {
    bindNamed(pass, &count.pipeline, {{"keys", keys}, {"counts", counts}});
    const BufferRef first = counts;
    bindNamed(pass, &count.pipeline, {{"keys", keys}, {"counts", counts}});
    EXPECT_EQ(counts.version, first.version);
    return [](Commands&) {};
  });
  compile();
}

TEST_F(ShaderPass, DrawsReadInTheGraphicsStages) {
  ReflectedPipeline<GraphicsPipeline> draw{
      kKeys, {"scene", BindingKind::Uniform}, {"shadow", BindingKind::SampledImage}, {"texels", BindingKind::TexelUint}};
  draw.pipeline.colors = {VK_FORMAT_R8G8B8A8_UNORM};
  const BufferRef keys = import("keys"), scene = import("scene"), texels = import("texels");
  const ImageRef shadow = graph.import("shadow", {.handle = reinterpret_cast<VkImage>(uintptr_t{1}),
                                                  .desc = {VK_FORMAT_R32_SFLOAT, 4, 4},
                                                  .before = Use::DrawSampled,
                                                  .after = Use::DrawSampled});
  ImageRef color = graph.create("color", {VK_FORMAT_R8G8B8A8_UNORM, 4, 4});
  graph.pass("draw", [&](Pass& pass) {
    color = pass.write(color, Use::ColorTarget, Load::Discard);
    bindNamed(pass, &draw.pipeline, {{"keys", keys}, {"scene", scene}, {"shadow", shadow}, {"texels", texels}});
    pass.sideEffect();
    return [](Commands&) {};
  });
  compile();
  EXPECT_EQ(access(keys).use, Use::DrawRead);
  EXPECT_EQ(access(scene).use, Use::DrawUniform);
  EXPECT_EQ(access(texels).use, Use::DrawTexel);
  EXPECT_EQ(access(shadow).use, Use::DrawSampled);
}

TEST_F(ShaderPass, RejectsMissingName) {
  const BufferRef keys = import("keys");
  addDispatch(graph, "count", &count.pipeline, 1, NoPush{}, {{"keys", keys}});
  EXPECT_EQ(compileError(), "pass 'count': shader 'count': nothing is given for 'counts'");
}

TEST_F(ShaderPass, RejectsWriteToReadOnlyResource) {
  const BufferRef keys = import("keys"), counts = import("counts");
  addDispatch(graph, "count", &count.pipeline, 1, NoPush{}, {{"keys", keys}, {"counts", counts}});
  EXPECT_EQ(compileError(), "pass 'count': shader 'count' writes 'counts', which is given to be read");
}

TEST_F(ShaderPass, RejectsWriteByADraw) {
  const ReflectedPipeline<GraphicsPipeline> draw{kCounts};
  BufferRef counts = import("counts");
  ImageRef color = graph.create("color", {VK_FORMAT_R8G8B8A8_UNORM, 4, 4});
  graph.pass("draw", [&](Pass& pass) {
    color = pass.write(color, Use::ColorTarget, Load::Discard);
    bindNamed(pass, &draw.pipeline, {{"counts", counts}});
    return [](Commands&) {};
  });
  EXPECT_EQ(compileError(), "pass 'draw': shader 'count' writes 'counts', which a draw cannot");
}

TEST_F(ShaderPass, RejectsWrongNumberOfResources) {
  const BufferRef keys = import("keys");
  graph.pass("count", [&](Pass& pass) {
    const BoundResource one[] = {{.ref = keys}};
    bindShader(pass, &count.pipeline, one);
    return [](Commands&) {};
  });
  EXPECT_EQ(compileError(), "pass 'count': shader 'count': 1 resources; expected 2");
}

TEST_F(ShaderPass, RejectsNullPipeline) {
  const std::string expected = "pass 'count' declares a kernel with a null pipeline";
  BufferRef counts = import("counts");
  addDispatch(graph, "count", nullptr, 1, NoPush{}, {{"counts", counts}});
  EXPECT_EQ(compileError(), expected);
  graph.reset();
  graph.pass("count", [&](Pass& pass) {
    const GraphicsPipeline* none = nullptr;
    bindNamed(pass, none, {{"counts", counts}});
    return [](Commands&) {};
  });
  EXPECT_EQ(compileError(), expected);
}

// Of SPIR-V that the caller gives only the kinds of its resources are known.
TEST_F(ShaderPass, RejectsPipelineWithoutNames) {
  const std::string expected = "pass 'count': shader 'fake': its resources have no names; expected an embedded shader";
  const FakePipeline unnamed{BindingKind::Storage};
  BufferRef counts = import("counts");
  addDispatch(graph, "count", &unnamed.pipeline, 1, NoPush{}, {{"counts", counts}});
  EXPECT_EQ(compileError(), expected);
  graph.reset();
  graph.pass("count", [&](Pass& pass) {
    const BoundResource one[] = {{.buffer = &counts}};
    bindShader(pass, &unnamed.pipeline, one);
    return [](Commands&) {};
  });
  EXPECT_EQ(compileError(), expected);
}

class EmbeddedPipelines : public ::testing::Test {
 protected:
  EmbeddedPipelines() {
    auto borrowed = Device::borrow(vulkan.host());
    EXPECT_TRUE(borrowed);
    device = std::move(*borrowed);
  }
  NullVulkan vulkan;
  std::optional<Device> device;
};

// A pipeline of an embedded shader has names, also if it was first requested with explicit bindings.
TEST_F(EmbeddedPipelines, HaveNamesHoweverTheyAreDescribed) {
  const EmbeddedShader* shader = embeddedShader(implOf(*device), "sort/clear");
  ASSERT_NE(shader, nullptr);
  std::vector<BindingKind> kinds;
  for (const ShaderBinding& binding : shader->bindings) kinds.push_back(binding.kind);
  const auto described = computePipeline(*device, {.shader = "sort/clear", .bindings = kinds});
  const auto named = computePipeline(*device, {.shader = "sort/clear"});
  ASSERT_TRUE(described && named);
  EXPECT_EQ(*described, *named);
  EXPECT_EQ((*named)->bindings.size(), kinds.size());
  EXPECT_EQ((*named)->pushBytes, shader->pushConstantBytes);
  kinds.back() = BindingKind::Uniform;
  const auto wrong = computePipeline(*device, {.shader = "sort/clear", .bindings = kinds});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, ErrorKind::Shader);
  EXPECT_EQ(wrong.error().message, "shader 'sort/clear': the bindings given are not those of the embedded shader; expected none, or its " +
                                       std::to_string(kinds.size()) + " in their order");
}

TEST_F(EmbeddedPipelines, RejectConstantWithoutValue) {
  const auto made = shaderPipeline(*device, "sort/scan_apply", {{"ANOTHER", 1}});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "shader 'sort/scan_apply': its constant SUMS_SCANNED is given no value");
}

// Of shaders for graphics the numbers of both stages are without a gap together, which graphicsPipeline() checks.
TEST(EmbeddedShaders, EachBindingHasItsOwnName) {
  size_t checked = 0;
  for (const auto table : {embeddedShaders(), viewsShaders()})
    for (const EmbeddedShader& shader : table) {
      std::set<std::string_view> names;
      size_t numbers = 0;
      for (const ShaderBinding& binding : shader.bindings) {
        const bool named = !binding.name.empty();
        EXPECT_TRUE(named || !shader.source.ends_with(".comp")) << shader.name << ": no resource has number " << numbers;
        EXPECT_TRUE(!named || names.insert(binding.name).second) << shader.name << ": two are named " << binding.name;
        ++numbers;
      }
      EXPECT_LE(numbers, kMaxBindings) << shader.name;
      EXPECT_LE(shader.pushConstantBytes, 128u) << shader.name;
      checked += numbers;
    }
  EXPECT_GT(checked, 300u);
}

}  // namespace
}  // namespace rill::test
