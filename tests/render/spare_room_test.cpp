// A fluid with room for more particles than it has: its pictures are those of one without, and nothing is dispatched for the room.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "gpu/module_pipelines.hpp"
#include "offline/painter.hpp"
#include "render/particle_count.hpp"
#include "render/surface_records.h"
#include "rill/fluid.hpp"
#include "rill/particles.hpp"
#include "sort/dispatches.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace {

constexpr uint32_t kWidth = 160, kHeight = 120;

class SpareRoom : public GpuTest {
 protected:
  SpareRoom() {
    scene_.domain = Domain{};
    scene_.fluid.spacing = 0.05;
    BoxShape box;
    for (int a = 0; a < 3; ++a) box.min[a] = 0.2, box.max[a] = 0.6;
    scene_.fill.emplace_back().shape = box;
    // Past the fluid, towards the place of the entries without a particle.
    const Double3 eye = {-0.6, 0.2, -0.6}, target = {0.4, 0.9, 0.4};
    scene_.camera = Camera{};
    scene_.camera->eye = eye;
    scene_.camera->target = target;
  }

  /// `change`: of the state that is drawn. Leaves the frame in `graph`.
  template <class Change>
  std::vector<uint8_t> picture(Graph& graph, std::string_view view, uint32_t capacity, const Change& change) {
    const auto start = makeParticles(scene_);
    EXPECT_TRUE(start);
    auto fluid = Fluid::create(device(), {.scene = &scene_, .particles = &*start, .capacity = capacity});
    offline::Painter painter(scene_, *start);
    EXPECT_TRUE(fluid && painter.prepare(device(), view, kWidth, kHeight));
    FluidState state = fluid->addTo(graph, {});
    change(state);
    const auto tickets = painter.declare(graph, state, view, kWidth, kHeight, 0);
    run(graph);
    return read<uint8_t>(graph, tickets.picture);
  }
  std::vector<uint8_t> picture(std::string_view view, uint32_t capacity) {
    Graph graph;
    return picture(graph, view, capacity, [](FluidState&) {});
  }
  std::vector<uint8_t> pictureOfCount(std::string_view view, uint32_t capacity, uint32_t count) {
    Graph graph;
    const Buffer counted = upload("count", std::vector{count});
    return picture(graph, view, capacity, [&](FluidState& state) { state.countBuffer = graph.import("count", importOf(counted)); });
  }

  GroupCount groupsOf(uint32_t count, uint32_t capacity) {
    ModulePipelines pipelines(device());
    const ComputePipeline* pipeline = pipelines.make("render/particle_groups");
    EXPECT_TRUE(pipelines.result());
    const Buffer counted = upload("count", std::vector{count});
    Graph graph;
    FluidState state;
    state.capacity = capacity;
    state.countBuffer = graph.import("count", importOf(counted));
    const Ticket ticket = graph.readback(countParticles(graph, state, pipeline, surface::kSurfaceGroup).groups.arguments);
    run(graph);
    const auto groups = read<uint32_t>(graph, ticket);
    EXPECT_EQ(groups.size(), 3u);
    return {groups[0], groups[1], groups[2]};
  }

  Scene scene_;
};

TEST_F(SpareRoom, IsNotSeen) {
  for (const std::string_view view : offline::Painter::views()) {
    SCOPED_TRACE(view);
    const auto exact = picture(view, 0), roomy = picture(view, 5000);
    ASSERT_EQ(exact.size(), size_t{kWidth} * kHeight * 4);
    EXPECT_TRUE(exact == roomy);
  }
}

TEST_F(SpareRoom, GetsNoWorkgroups) {
  EXPECT_EQ(groupsOf(0, 5000), (GroupCount{0, 0, 0}));
  EXPECT_EQ(groupsOf(1, 5000), (GroupCount{1, 1, 1}));
  EXPECT_EQ(groupsOf(64, 5000), (GroupCount{1, 1, 1}));
  EXPECT_EQ(groupsOf(65, 5000), (GroupCount{2, 1, 1}));
  EXPECT_EQ(groupsOf(5000, 5000), (GroupCount{79, 1, 1}));
}

TEST_F(SpareRoom, LimitsDispatchesToTheCapacity) {
  EXPECT_EQ(groupsOf(5001, 100), (GroupCount{2, 1, 1}));
  EXPECT_EQ(groupsOf(0xFFFFFFFFu, 5000), (GroupCount{79, 1, 1}));
}

TEST_F(SpareRoom, FoldsDispatchesAsTheHostDoes) {
  for (const uint32_t groups : {65535u, 65536u, 131070u, 131071u})
    EXPECT_EQ(groupsOf(groups * 64, kMaxParticles * 4), foldGroups(groups)) << groups;
}

// Whatever reads the number of particles is dispatched by it.
TEST_F(SpareRoom, IsDispatchedByNoPass) {
  for (const std::string_view view : offline::Painter::views()) {
    SCOPED_TRACE(view);
    Graph graph;
    const Buffer counted = upload("count", std::vector{512u});
    picture(graph, view, 5000, [&](FluidState& state) { state.countBuffer = graph.import("count", importOf(counted)); });
    const auto frame = nlohmann::json::parse(graph.json());
    int passes = 0;
    for (const auto& pass : frame["passes"]) {
      const auto reads = [&](const char* resource, const char* use) {
        return std::ranges::any_of(pass["uses"], [&](const auto& u) { return u["resource"] == resource && u["use"] == use; });
      };
      if (pass["culled"] || pass["name"] == "particle groups" || !reads("count", "ComputeRead")) continue;
      ++passes;
      EXPECT_TRUE(reads("particle groups", "Indirect")) << pass["name"];
    }
    EXPECT_EQ(passes, view == "final" ? 4 : view == "thickness" ? 3 : 2);
  }
}

TEST_F(SpareRoom, IsNotSeenWithCountAboveCapacity) {
  for (const std::string_view view : offline::Painter::views()) {
    SCOPED_TRACE(view);
    EXPECT_TRUE(pictureOfCount(view, 0, 0xFFFFFFFFu) == picture(view, 0));
  }
}

TEST_F(SpareRoom, ShowsNothingWithoutParticles) {
  for (const std::string_view view : offline::Painter::views()) {
    SCOPED_TRACE(view);
    Graph graph;
    const auto none = picture(graph, view, 0, [](FluidState& state) { state.capacity = 0; });
    EXPECT_TRUE(pictureOfCount(view, 0, 0) == none);
  }
}

TEST_F(SpareRoom, IsTheCapacityWithoutCountBuffer) {
  for (const std::string_view view : offline::Painter::views()) {
    SCOPED_TRACE(view);
    Graph graph;
    EXPECT_TRUE(picture(graph, view, 0, [](FluidState& state) { state.countBuffer = {}; }) == picture(view, 0));
    EXPECT_EQ(graph.json().find("particle groups"), std::string::npos);
  }
}

}  // namespace
}  // namespace rill::test
