// What is counted of a substep, and upper bounds of it: a change that makes a GPU read, dispatch or wait more fails here, without a GPU.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/bench.hpp"
#include "bench/traffic/cost_model.hpp"
#include "bench/traffic/fluid_traffic.hpp"
#include "bench/traffic/shader_accesses.hpp"
#include "gpu/shader_library.hpp"
#include "shared/fluid_records.h"

namespace rill::bench {
namespace {

/// Of a recorded substep.
struct Bounds {
  double bytes, rebuildBytes, dispatches, barriers;
  uint32_t serialCommands;
};

struct Counted {
  FluidTraffic traffic;
  std::vector<FluidPassRuns> runs;
};

Expected<Counted> count(const std::string& name, bool mergePasses, std::vector<Override> changes = {}) {
  changes.push_back({"fluid.particles", "3000"});
  auto scene = namedScene(name, changes);
  if (!scene) return scene.error();
  Options options;
  options.quiet = true;
  const Bench bench(options);
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  const auto start = makeParticles(*scene);
  if (!start) return start.error();
  auto fluid = Fluid::create(workbench->device(), {.scene = &*scene, .particles = &*start, .mergePasses = mergePasses});
  if (!fluid) return fluid.error();
  for (int frame = 0; frame < 6; ++frame)
    if (auto advanced = advanceFluid(*workbench, *fluid, 1.0 / 60); !advanced) return advanced.error();
  auto traffic = measureTraffic(*workbench, *fluid, 2.0 / 60, 4 * fluid->progress().substeps);
  if (!traffic) return traffic.error();
  return Counted{std::move(*traffic), fluid->passRuns()};
}

double recordedPerSubstep(const FluidTraffic& t, uint64_t total) { return double(total) / t.recordedSubsteps; }

void expectWithin(const FluidTraffic& t, const Bounds& bounds) {
  const PassTraffic substep = t.total(Section::Substep);
  ASSERT_GT(t.substeps, 0);
  EXPECT_LE(t.bytesPerParticleSubstep(Section::Substep), bounds.bytes);
  EXPECT_GT(t.bytesPerParticleSubstep(Section::Substep), 100) << "two passes read positions and a list";
  EXPECT_LE(t.bytesPerParticleSubstep(Section::Rebuild), bounds.rebuildBytes);
  EXPECT_LE(recordedPerSubstep(t, substep.recorded), bounds.dispatches);
  EXPECT_LE(recordedPerSubstep(t, substep.barriers), bounds.barriers);
  EXPECT_LE(substep.serialCommands, bounds.serialCommands);
}

void expectAsReported(const Counted& counted, bool merged) {
  for (const char* name : {"correct", "build list", "density"}) {
    const auto pass = std::ranges::find(counted.traffic.passes, name, &PassTraffic::name);
    const auto runs = std::ranges::find(counted.runs, name, &FluidPassRuns::name);
    ASSERT_NE(pass, counted.traffic.passes.end()) << name;
    ASSERT_NE(runs, counted.runs.end()) << name;
    EXPECT_EQ(pass->executed, runs->executed) << name << ", merged: " << merged;
    EXPECT_GE(pass->recorded, runs->recorded) << name;
  }
}

// As on a GPU. Lower a bound with the change that makes it possible. A substep of a dam break has 4 dispatches and 2 barriers; the rest is
// noise damping, three dispatches a block. Solids add predictions, densities, pairs and contacts.
TEST(Traffic, StaysWithinItsBounds) {
  const auto dam = count("dam-break", true), separate = count("dam-break", false), solids = count("box-and-sphere", true);
  ASSERT_TRUE(dam) << dam.error().message;
  ASSERT_TRUE(separate) << separate.error().message;
  ASSERT_TRUE(solids) << solids.error().message;
  expectWithin(dam->traffic, {.bytes = 459, .rebuildBytes = 30, .dispatches = 4.9, .barriers = 2.5, .serialCommands = 1});
  expectWithin(solids->traffic, {.bytes = 500, .rebuildBytes = 34, .dispatches = 8.1, .barriers = 5.7, .serialCommands = 1});
  expectAsReported(*dam, true);
  expectAsReported(*separate, false);

  const PassTraffic merged = dam->traffic.total(Section::Substep), apart = separate->traffic.total(Section::Substep);
  EXPECT_EQ(dam->traffic.substeps, separate->traffic.substeps);
  EXPECT_LT(merged.recorded, apart.recorded);
  EXPECT_LT(merged.barriers, apart.barriers);
  EXPECT_LT(merged.serialCommands, apart.serialCommands);
}

// Of the sort, there is no row. Steps of solves and of contacts have one name for several passes.
TEST(Traffic, CountsEachPassThatRunsInItsSection) {
  const auto counted = count("box-and-sphere", true, allPasses());
  ASSERT_TRUE(counted) << counted.error().message;
  const std::vector<PassTraffic>& passes = counted->traffic.passes;
  const auto found = [&](std::string_view name) { return std::ranges::find(passes, name, &PassTraffic::name); };
  for (const FluidPassRuns& runs : counted->runs) {
    if (runs.name.ends_with('/')) continue;
    const auto pass = found(runs.name);
    ASSERT_NE(pass, passes.end()) << runs.name;
    EXPECT_GE(pass->recorded, runs.recorded) << runs.name;
  }
  std::string missing;
  for (const FluidPassRow& row : fluidPassTable()) {
    const bool sleeps = row.condition.why == &FluidSetup::whyNoSleep || row.extent == Extent::Regions;
    const bool merged = row.id == FluidPass::Control, regions = row.id == FluidPass::RestMotion || row.id == FluidPass::RestSolids;
    if (sleeps || merged || regions || row.id == FluidPass::LoadsAsleep || sectionOf(row.id) == Section::Figures) continue;
    const auto pass = found(row.name);
    if (pass == passes.end()) {
      missing += std::string(row.name) + ", ";
      continue;
    }
    EXPECT_EQ(pass->section, sectionOf(row.id)) << row.name;
    if (std::ranges::find(row.starts, Start::Rebuild) != row.starts.end()) { EXPECT_EQ(pass->section, Section::Rebuild) << row.name; }
  }
  EXPECT_EQ(missing, "") << "allPasses() lacks what needs them";
  for (const char* name : {"pairs at solids", "density", "correct"}) ASSERT_NE(found(name), passes.end()) << name;
  for (const char* name : {"pairs at solids", "density"}) EXPECT_GT(found(name)->gatheredBytes, 0) << name;
  const auto correct = found("correct");
  const double all = double(counted->traffic.particles) * counted->traffic.substeps;
  EXPECT_GT(correct->readBytes / all, 100);
  // Of particles near solids `pairs at solids` gathers what `correct` leaves out.
  const auto gathered = [&](std::string_view name) { return found(name)->gatheredBytes / double(found(name)->executed); };
  EXPECT_LT(gathered("correct"), 0.995 * gathered("density"));
}

ShaderAccesses accessesOf(std::string_view shader, std::string_view constant, uint32_t value) {
  const EmbeddedShader* found = findShader(embeddedShaders(), shader);
  if (!found) {
    ADD_FAILURE() << "no shader " << shader;
    return {};
  }
  std::vector<uint32_t> constants;
  for (const ShaderConstant& c : found->constants) {
    if (c.id >= constants.size()) constants.resize(c.id + 1);
    constants[c.id] = c.name == constant ? value : c.name == "CLUSTER" ? 8 : c.name == "LIST_CAPACITY" ? 64 : 0;
  }
  auto accesses = shaderAccesses(found->words, constants);
  EXPECT_TRUE(accesses) << accesses.error().message;
  if (!accesses) return {};
  accesses->bindings.resize(found->bindings.size());
  return std::move(*accesses);
}

size_t bindingNamed(std::string_view shader, std::string_view name) {
  const auto& bindings = findShader(embeddedShaders(), shader)->bindings;
  return size_t(std::ranges::find(bindings, name, &ShaderBinding::name) - bindings.begin());
}

TEST(ShaderAccesses, FollowSpecializationConstants) {
  const size_t multiplier = bindingNamed("fluid/density", "multiplier");
  EXPECT_FALSE(accessesOf("fluid/density", "MULTIPLIERS", 0).bindings[multiplier].writes);
  const BindingAccess access = accessesOf("fluid/density", "MULTIPLIERS", 1).bindings[multiplier];
  EXPECT_TRUE(access.reads && access.writes);
  EXPECT_EQ(access.writeBytes, 4u);
  EXPECT_FALSE(access.readsInLoop);
}

TEST(ShaderAccesses, TellGathersFromReadsOfOwnElement) {
  const ShaderAccesses accesses = accessesOf("fluid/density", "WARM", 1);
  EXPECT_EQ(accesses.groupSize, kFluidGroup);
  const BindingAccess& particle = accesses.bindings[bindingNamed("fluid/density", "particle")];
  EXPECT_TRUE(particle.readsInLoop);
  EXPECT_EQ(particle.readBytes, 16u);
  const BindingAccess& work = accesses.bindings[bindingNamed("fluid/density", "work")];
  EXPECT_TRUE(work.writes);
  EXPECT_TRUE(work.reads);
  EXPECT_FALSE(work.readsInLoop);
}

TEST(ShaderAccesses, RejectsWordsThatAreNoShader) {
  const uint32_t words[] = {1, 2, 3, 4, 5, 6};
  const auto accesses = shaderAccesses(words, {});
  ASSERT_FALSE(accesses);
  EXPECT_EQ(accesses.error().kind, ErrorKind::Shader);
}

TEST(CostModel, AddsBandwidthAndLatency) {
  const Card card{"test", 100, 2, 5, ""};
  EXPECT_DOUBLE_EQ(predictedSeconds(card, {kReachedBandwidth * 100e9, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(predictedSeconds(card, {0, 10, 4}), 40e-6);
  const DeviceWork twice = DeviceWork{1, 2, 3} * 2 + DeviceWork{1, 1, 1};
  EXPECT_DOUBLE_EQ(twice.bytes + 10 * twice.dispatches + 100 * twice.barriers, 3 + 50 + 700);
}

TEST(CostModel, FindsCardsByTheNamesOfDrivers) {
  ASSERT_NE(cardOf("NVIDIA H100 80GB HBM3"), nullptr);
  EXPECT_EQ(cardOf("NVIDIA H100 80GB HBM3")->bandwidth_GBps, 3350);
  EXPECT_NE(cardOf("Intel(R) Arc(tm) A770 Graphics (DG2)"), nullptr);
  EXPECT_NE(cardOf("AMD Radeon RX 7800 XT (RADV NAVI32)"), nullptr);
  EXPECT_NE(cardOf("V3D 7.1.7.0"), nullptr);
  EXPECT_EQ(cardOf("llvmpipe (LLVM 15.0.6, 256 bits)"), nullptr);
  EXPECT_EQ(cardOf("NVIDIA GeForce RTX 4070 Ti"), nullptr) << "another card";
  for (const Card& card : cards()) EXPECT_FALSE(card.source.empty()) << card.name;
}

}  // namespace
}  // namespace rill::bench
