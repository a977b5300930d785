// What a fluid says that it needs, against the buffers that are created: for the fluid, and for the transients of a frame.
#include <gtest/gtest.h>

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
    auto borrowed = Device::borrow(vulkan.host());
    ASSERT_TRUE(borrowed);
    device = std::move(*borrowed);
    device->beginFrame({1, 0});
    scene.fluid.spacing = 0.1;
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
  for (const char* name : {"iteration multipliers", "wall samples", "particles near one wall", "particles near corners"}) expectOff(name);
  for (const char* name : {"warm-start accelerations", "warm-start multipliers", "list heads", "neighbor list"})
    EXPECT_GE(bytesOf(name), 4000u) << name;
  scene.solver.warm_start = 0;
  expectOff("warm-start accelerations");
  expectOff("warm-start multipliers");
  scene.solver.neighbors = NeighborChoice::Grid;
  expectOff("list heads");
  expectOff("neighbor list");
  scene.solver.iterations = 3;
  EXPECT_GE(bytesOf("iteration multipliers"), 4000u);
}

TEST_F(CountedMemory, RejectsTooLargeFluidsWithNeededAndAvailableBytes) {
  const auto refusal = [&](size_t n) {
    particles.positions.assign(n, {});
    particles.velocities.assign(n, {});
    const size_t before = vulkan.buffersCreated;
    auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles});
    EXPECT_FALSE(fluid);
    EXPECT_EQ(vulkan.buffersCreated, before) << "nothing is allocated";
    return fluid ? Error{} : fluid.error();
  };
  const Error many = refusal((4u << 20) + 1);
  EXPECT_EQ(many.kind, ErrorKind::TooLarge);
  EXPECT_NE(many.message.find("4194305 particles need"), std::string::npos) << many.message;
  EXPECT_NE(many.message.find("has 4096.0 MiB"), std::string::npos) << many.message;
  scene.fluid.smoothing_ratio = 4;
  const Error wide = refusal(3000000);
  EXPECT_EQ(wide.kind, ErrorKind::TooLarge);
  EXPECT_NE(wide.message.find("make smoothing_ratio smaller"), std::string::npos) << wide.message;
}

INSTANTIATE_TEST_SUITE_P(Scenes, FluidMemoryTest,
                         ::testing::Values(Case{"Plain", 100000, [](Scene&) {}},
                                           Case{"Grid", 100000, [](Scene& s) { s.solver.neighbors = NeighborChoice::Grid; }},
                                           Case{"Iterations", 100000, [](Scene& s) { s.solver.iterations = 4; }},
                                           Case{"Forces", 100000, [](Scene& s) { s.fluid.viscosity = 1, s.fluid.vorticity = 0.5; }},
                                           Case{"WideSupport", 50000, [](Scene& s) { s.fluid.smoothing_ratio = 3; }},
                                           Case{"SeveralLists", 700000, [](Scene& s) { s.domain.reset(); }}),
                         [](const auto& c) { return c.param.name; });

}  // namespace memory_test
}  // namespace rill::test
