// Which pipelines are compiled, and how often.
#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/shader_library.hpp"
#include "rill/fluid.hpp"
#include "rill/fluid_renderer.hpp"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace compiling_test {

constexpr uint32_t kIntel = 0x8086, kNvidia = 0x10de;

class CompilingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    vulkan.properties.maxTexelBufferElements = 1u << 27;
    vulkan.cache = &cache;
  }
  /// A program's start: a fluid with all forces, and its pictures. The pipelines that were compiled for it.
  size_t start(ArrayReads reads = ArrayReads::Auto) {
    const size_t before = vulkan.pipelinesCompiled;
    HostDevice host = vulkan.host();
    host.reads = reads;
    auto device = Device::borrow(host);
    EXPECT_TRUE(device);
    device->beginFrame({1, 0});
    info = device->info();
    Scene scene;
    scene.fluid.spacing = 0.1;
    scene.fluid.viscosity = 1;
    scene.fluid.yield_stress = 20;
    scene.fluid.vorticity = 0.5;
    scene.fluid.surface_tension = 0.5;
    scene.fluid.drag = 1;
    scene.solver.iterations = 2;
    scene.domain = Domain{};
    scene.solids.push_back(Solid{.shape = SphereShape{{0, 0, 0}, 0.5}});
    ParticleSet particles;
    particles.positions.resize(1000);
    particles.velocities.resize(1000);
    EXPECT_TRUE(Fluid::create(*device, {.scene = &scene, .particles = &particles}));
    EXPECT_TRUE(FluidRenderer::create(*device, {.color = VK_FORMAT_R8G8B8A8_UNORM, .depth = VK_FORMAT_D32_SFLOAT}));
    return vulkan.pipelinesCompiled - before;
  }
  bool compiled(const EmbeddedShader& shader) const {
    return std::ranges::any_of(vulkan.pipelines, [&](const NullPipeline& made) { return std::ranges::equal(made.words, shader.words); });
  }
  /// Shaders of which both reading variants were compiled, or the one that was not chosen.
  std::string unwanted() const {
    std::string names;
    for (const EmbeddedShader& shader : embeddedShaders()) {
      const EmbeddedShader* texel = findShader(embeddedShaders(), std::string(shader.name) + "_texel");
      if (texel && compiled(info.texelReads ? shader : *texel)) names += " " + std::string(shader.name);
    }
    return names;
  }
  NullVulkan vulkan;
  NullCache cache;
  DeviceInfo info;
};

TEST_F(CompilingTest, WarmStartCompilesNothing) {
  const size_t cold = start();
  EXPECT_GT(cold, 40u);
  EXPECT_EQ(cache.size(), cold);
  EXPECT_EQ(start(), 0u);
  vulkan.cache = nullptr;
  EXPECT_EQ(start(), cold) << "without the cache";
}

TEST_F(CompilingTest, CompilesOneReadingVariant) {
  vulkan.properties.vendor = kIntel;
  start();
  EXPECT_TRUE(info.texelReads) << info.readsBecause;
  EXPECT_EQ(unwanted(), "");
  EXPECT_TRUE(compiled(*findShader(embeddedShaders(), "fluid/correct_texel")));
  vulkan.pipelines.clear();
  vulkan.properties.vendor = kNvidia;
  start();
  EXPECT_FALSE(info.texelReads) << info.readsBecause;
  EXPECT_EQ(unwanted(), "");
  EXPECT_TRUE(compiled(*findShader(embeddedShaders(), "fluid/correct")));
}

TEST_F(CompilingTest, ReadsAsAskedFor) {
  vulkan.properties.vendor = kNvidia;
  start(ArrayReads::Texels);
  EXPECT_TRUE(info.texelReads);
  EXPECT_EQ(unwanted(), "");
  vulkan.pipelines.clear();
  vulkan.properties.vendor = kIntel;
  start(ArrayReads::Storage);
  EXPECT_FALSE(info.texelReads);
  EXPECT_EQ(unwanted(), "");
  vulkan.properties.maxTexelBufferElements = 65536;
  start(ArrayReads::Texels);
  EXPECT_FALSE(info.texelReads) << "they do not fit";
  EXPECT_EQ(info.readsBecause, "the device has too few texels in a buffer");
}

}  // namespace compiling_test
}  // namespace rill::test
