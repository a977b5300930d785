// What a fluid says that it needs, against the buffers that are created: for the fluid, and for the transients of a frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "fluid/fluid_impl.hpp"
#include "rill/graph.hpp"
#include "support/null_vulkan.hpp"

namespace rill::test {
namespace memory_test {

struct Case {
  const char* name;
  uint32_t count;
  void (*change)(Scene&);
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A device of which nothing is needed but that memory is counted.
class CountedMemory : public ::testing::Test {
 protected:
  void SetUp() override {
    vulkan.properties.storageBufferRange = 1u << 27;
    auto borrowed = Device::borrow(vulkan.host());
    ASSERT_TRUE(borrowed);
    device = std::move(*borrowed);
    device->beginFrame({1, 0});
    scene.fluid.spacing = 0.1;
  }
  /// With limits as NVIDIA's driver has them; modelled.
  void borrowLargeDevice(uint64_t heapBytes) {
    vulkan.properties.storageBufferRange = 0xFFFFFFFF;
    vulkan.properties.maxAllocation = 0xFFE00000;
    vulkan.properties.maxTexelBufferElements = 1u << 27;
    vulkan.properties.heapBytes = heapBytes;
    device = *Device::borrow(vulkan.host());
    device->beginFrame({1, 0});
  }
  NullVulkan vulkan;
  std::optional<Device> device;
  Scene scene;
  ParticleSet particles;
};

class FluidMemoryTest : public CountedMemory, public ::testing::WithParamInterface<Case> {};

TEST_P(FluidMemoryTest, EqualsTheAllocatedBytes) {
  scene.domain = Domain{};
  scene.domain->max[0] = scene.domain->max[1] = scene.domain->max[2] = 100;
  GetParam().change(scene);
  const uint32_t n = GetParam().count;
  for (uint32_t i = 0; i < n; ++i)
    particles.positions.push_back({float(i % 100) * 0.1f, float(i / 100 % 100) * 0.1f, float(i / 10000) * 0.1f});
  particles.velocities.resize(n);

  auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles});
  ASSERT_TRUE(fluid) << fluid.error().message;
  const FluidMemory said = fluid->memory();
  EXPECT_EQ(said.total(), fluidMemory(scene, n).total());
  Graph graph;
  (void)fluid->addTo(graph, {.advance_s = 0.01});
  ASSERT_TRUE(graph.compile());
  ASSERT_TRUE(graph.prepare(*device));
  // Not counted: the start state on its way to the device, tables, parameters, read-backs; half a MiB at most.
  const double upload = double(n) * (2 * 16 + 4), others = 512 * 1024;
  EXPECT_LE(double(vulkan.bufferBytes), double(said.total()) + upload + others) << "less was announced than was allocated";
  EXPECT_GE(double(vulkan.bufferBytes), 0.75 * double(said.total())) << "far more was announced";
}

TEST_F(CountedMemory, DisabledFeaturesHaveNoBuffer) {
  particles.positions.resize(1000);
  particles.velocities.resize(1000);
  const auto bytesOf = [&](std::string_view name) {
    auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles});
    EXPECT_TRUE(fluid) << fluid.error().message;
    uint64_t bytes = 0;
    for (const FluidBuffer& buffer : fluid->buffers())
      if (buffer.name == name) bytes += buffer.bytes;
    EXPECT_GT(bytes, 0u) << name;
    return bytes;
  };
  const auto expectOff = [&](std::string_view name) { EXPECT_LE(bytesOf(name), 64u) << name; };  // a binding must be something
  for (const char* name : {"multipliers", "pressure probes", "density that solids and mouths displace", "tangential scales at solids",
                           "particles near solids", "particles near mouths", "rigid bodies", "pulls of bodies"})
    expectOff(name);
  for (const char* name : {"warm-start accelerations", "warm-start multipliers", "list heads", "neighbor list"})
    EXPECT_GE(bytesOf(name), 4000u) << name;
  scene.solver.warm_start = 0;
  expectOff("warm-start accelerations");
  expectOff("warm-start multipliers");
  scene.solver.neighbors = NeighborChoice::Grid;
  expectOff("list heads");
  expectOff("neighbor list");
  scene.solver.iterations = 3;
  EXPECT_GE(bytesOf("multipliers"), 4000u);
  scene.solver.iterations = 1;
  expectOff("multipliers");
  scene.probes = {{.name = "p", .pressure = Double3{0, 0, 0}}};
  EXPECT_GE(bytesOf("multipliers"), 4000u) << "for probes of pressure";
}

TEST_F(CountedMemory, RejectsTooLargeFluidsWithTheLimitAndWhatFits) {
  const auto refusal = [&](uint32_t capacity) {
    const size_t before = vulkan.buffersCreated;
    auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = capacity});
    EXPECT_FALSE(fluid);
    EXPECT_EQ(vulkan.buffersCreated, before) << "nothing is allocated";
    return fluid ? Error{} : fluid.error();
  };
  const Error wide = refusal((8u << 20));
  EXPECT_EQ(wide.kind, ErrorKind::TooLarge);
  EXPECT_EQ(wide.message,
            "8388608 particles do not fit on \"null device\": the buffer of positions would have 128.0 MiB, and one has at most 128.0 MiB "
            "(maxStorageBufferRange). At most 8388607 fit: make fluid.spacing larger or fluid.particles smaller");
  scene.domain = Domain{};
  EXPECT_EQ(maxParticles(*device, scene), (8u << 20) - 1) << "walls need no larger buffers";
  const Error any = refusal(kMaxParticles + 1);
  EXPECT_NE(any.message.find("a fluid has at most 67108864 on any device"), std::string::npos) << any.message;
  scene.domain.reset();
  vulkan.properties.heapBytes = uint64_t{1} << 31;
  device = *Device::borrow(vulkan.host());
  scene.fluid.smoothing_ratio = 3;
  const Error lists = refusal(5000000);
  EXPECT_EQ(lists.kind, ErrorKind::TooLarge);
  EXPECT_NE(lists.message.find("of device memory, and 2048.0 MiB are available"), std::string::npos) << lists.message;
}

// Lists are split over 16 buffers at most: of 720 bytes a particle, 3 million fill 17.
TEST_F(CountedMemory, RejectsListsOfTooManyBuffers) {
  vulkan.properties.heapBytes = uint64_t{1} << 40;
  device = *Device::borrow(vulkan.host());
  device->beginFrame({1, 0});
  scene.fluid.smoothing_ratio = 4;
  auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = 3500000});
  ASSERT_FALSE(fluid);
  EXPECT_NE(fluid.error().message.find("more than 16 buffers"), std::string::npos) << fluid.error().message;
  const uint32_t most = maxParticles(*device, scene);
  EXPECT_TRUE(Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = most}));
}

TEST_F(CountedMemory, FollowsTheBudget) {
  const uint32_t byHeap = maxParticles(*device, scene);
  vulkan.properties.availableBytes = uint64_t{1} << 30;
  EXPECT_EQ(maxParticles(*device, scene), byHeap) << "the extension is looked for when the device is borrowed";
  device = *Device::borrow(vulkan.host());
  device->beginFrame({1, 0});
  EXPECT_EQ(device->availableBytes(), uint64_t{1} << 30);
  const uint32_t most = maxParticles(*device, scene);
  EXPECT_LE(fluidMemory(scene, most).total(), uint64_t{1} << 30);
  EXPECT_GT(fluidMemory(scene, most + 1).total(), uint64_t{1} << 30);
  EXPECT_TRUE(Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = most}));
  const auto refused = Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = most + 1});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("and 1024.0 MiB are available. At most " + std::to_string(most) + " fit"), std::string::npos)
      << refused.error().message;
  vulkan.allocationResult = VK_ERROR_OUT_OF_DEVICE_MEMORY;  // other processes have used the budget
  const auto failed = Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = 1000});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, ErrorKind::OutOfMemory);
  EXPECT_NE(failed.error().message.find("null device has 1024.0 MiB left for this process"), std::string::npos) << failed.error().message;
  vulkan.allocationResult = VK_SUCCESS;
  vulkan.properties.availableBytes = 0;
  EXPECT_EQ(maxParticles(*device, scene), 0u) << "other processes have allocated it since";
}

TEST_F(CountedMemory, ListsOfManySolidsFitTexelViews) {
  borrowLargeDevice(400'000'000'000);
  scene.domain = Domain{};
  for (int k = 0; k < 23; ++k) scene.solids.push_back(Solid{.shape = SphereShape{{0, 0, 0}, 0.5}});
  EXPECT_EQ(maxParticles(*device, scene), (1u << 27) / 4) << "four texels a particle";
}

TEST_F(CountedMemory, HoldsTwentyMillionParticlesOn24Gigabytes) {
  borrowLargeDevice(24'000'000'000);
  scene.domain = Domain{};
  scene.solids.push_back(Solid{.shape = SphereShape{{0, 0, 0}, 0.5}});
  constexpr uint32_t kParticles = 20'000'000;
  EXPECT_GE(maxParticles(*device, scene), kParticles);
  particles.positions.resize(1000);
  particles.velocities.resize(1000);
  auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles, .capacity = kParticles});
  ASSERT_TRUE(fluid) << fluid.error().message;
  for (const FluidBuffer& buffer : fluid->buffers()) EXPECT_LE(buffer.bytes, device->info().maxBufferBytes) << buffer.name;
  Graph graph;
  (void)fluid->addTo(graph, {.advance_s = 0.01, .stats = true});
  ASSERT_TRUE(graph.compile());
  const auto prepared = graph.prepare(*device);
  ASSERT_TRUE(prepared) << prepared.error().message;
  EXPECT_LE(vulkan.bufferBytes, vulkan.properties.heapBytes);
  graph.record(NullVulkan::commandBuffer());
  uint64_t most = 0;
  for (const NullCommand& command : vulkan.commands)
    if (command.kind == NullCommand::Dispatch) {
      EXPECT_LE(std::max({command.a, command.b, command.c}), 65535u);
      most = std::max(most, command.a * command.b);
    }
  EXPECT_GE(most, 1u) << "nothing was dispatched";
}

INSTANTIATE_TEST_SUITE_P(Scenes, FluidMemoryTest,
                         ::testing::Values(Case{"Plain", 100000, [](Scene&) {}},
                                           Case{"Grid", 100000, [](Scene& s) { s.solver.neighbors = NeighborChoice::Grid; }},
                                           Case{"Iterations", 100000, [](Scene& s) { s.solver.iterations = 4; }},
                                           Case{"Forces", 100000, [](Scene& s) { s.fluid.viscosity = 1, s.fluid.vorticity = 0.5; }},
                                           Case{"YieldStress", 100000, [](Scene& s) { s.fluid.yield_stress = 20; }},
                                           Case{"SurfaceTension", 100000, [](Scene& s) { s.fluid.surface_tension = 0.07; }},
                                           Case{"WideSupport", 50000, [](Scene& s) { s.fluid.smoothing_ratio = 3; }},
                                           Case{"SeveralLists", 700000, [](Scene& s) { s.domain.reset(); }}),
                         [](const auto& c) { return c.param.name; });

}  // namespace memory_test
}  // namespace rill::test
