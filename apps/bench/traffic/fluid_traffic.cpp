#include "bench/traffic/fluid_traffic.hpp"

#include <algorithm>

#include "bench/traffic/trace.hpp"
#include "core/impl_of.hpp"
#include "fluid/fluid_impl.hpp"
#include "shared/neighbor_list.h"

namespace rill::bench {
namespace {

/// The last count and list of a fluid.
struct FluidCounts {
  double particles = 0, entries = 0;  // of a list
  double nearSolids = 0, nearMouths = 0;
};

const FluidPassRow* rowNamed(std::string_view name) {
  const auto row = std::ranges::find(fluidPassTable(), name, &FluidPassRow::name);
  return row == fluidPassTable().end() ? nullptr : &*row;
}

/// Passes without a row, which are those of the sort, belong to the rebuild that they are in.
Section sectionOf(const FluidPassRow* row, Section last) {
  if (row) return rill::sectionOf(row->id);
  return last == Section::Start ? Section::Rebuild : last;
}

const ArrayRow* arrayLabeled(std::string_view label) {
  const auto row = std::ranges::find_if(arrayTable(), [&](const ArrayRow& r) { return r.label == label; });
  return row == arrayTable().end() ? nullptr : &*row;
}

/// Elements that a particle has of an array; 0 of one that is not per particle.
uint64_t elementsPerParticle(const ArrayRow& row, ArrayShape shape) {
  const uint64_t before = row.length(shape), particles = shape.particles;
  shape.particles *= 2;
  return (row.length(shape) - before) / particles;
}

/// Particles whose elements of an array a dispatch over `covered` ones touches, each counted once. Arrays that are not per particle, and
/// those of the sort, whose invocations take several keys, count as a whole.
double touched(const FluidPassRow& pass, const ArrayRow& row, double covered, const FluidCounts& counts) {
  if (pass.id == FluidPass::Reorder) return covered;  // clears what is of solids
  switch (row.id) {
    case FluidArray::NearDisplaced:
      return std::min(covered, counts.nearSolids + counts.nearMouths);
    case FluidArray::NearTangential:  // the list head says which particles are near: only those read the samples (solid_samples.glsl)
    case FluidArray::NearCorrection:
    case FluidArray::NearStiffness:
    case FluidArray::NearMultipliers:
    case FluidArray::NearSolids:
    case FluidArray::Hold:
    case FluidArray::SolidPlane:
      return std::min(covered, counts.nearSolids);
    case FluidArray::NearMouths:
      return std::min(covered, counts.nearMouths);
    default:
      return covered;
  }
}

/// Those of `covered` particles whose neighbors a pass visits: near solids `correct` and `iterate` have the sums of pairs.comp.
double visiting(const FluidPassRow& pass, double covered, const FluidCounts& counts) {
  const bool skips = pass.id == FluidPass::Correct || pass.id == FluidPass::Iterate;
  return skips ? covered * (1 - counts.nearSolids / counts.particles) : covered;
}

void addBytes(PassTraffic& to, const FluidPassRow* pass, const TracedDispatch& dispatch, const ArrayShape& shape,
              const FluidCounts& counts) {
  const double covered = std::min(double(dispatch.groups) * dispatch.groupSize, counts.particles);
  for (const TracedBinding& binding : dispatch.bindings) {
    const ArrayRow* array = arrayLabeled(binding.resource);
    double bytes = double(binding.bytes);
    if (pass && array && array->id == FluidArray::List) {
      // Neighbors are not in the shader: as many as the lists had, rounded up to a whole load or store.
      const double group = std::max({binding.access.readBytes, binding.access.writeBytes, array->stride});
      bytes = visiting(*pass, covered, counts) * (counts.entries * array->stride + (group - array->stride) / 2);
    } else if (const uint64_t elements = pass && array ? elementsPerParticle(*array, shape) : 0; elements > 0) {
      bytes = touched(*pass, *array, covered, counts) * double(elements) * array->stride;
      if (gathers(pass->extent) && binding.access.readsInLoop)
        to.gatheredBytes += visiting(*pass, covered, counts) * counts.entries * array->stride;
    }
    if (binding.access.reads) to.readBytes += bytes;
    if (binding.access.writes) to.writtenBytes += bytes;
  }
}

/// Commands that one invocation writes: a loop over them is shared by the invocations of a workgroup.
uint32_t serialCommands(const TracedDispatch& dispatch, uint32_t commands) {
  for (const TracedBinding& binding : dispatch.bindings)
    if (binding.array == rowOf(FluidArray::Commands).name && binding.access.writes)
      return binding.access.writesInLoop ? uint32_t(divideUp(commands, dispatch.groupSize)) : 1;
  return 0;
}

Expected<FluidCounts> countsOf(Workbench& workbench, const FluidImpl& fluid) {
  const auto sums = workbench.download<FluidSums>(fluid.buffer(FluidArray::Sums));
  if (!sums) return sums.error();
  const auto heads = workbench.download<uint32_t>(fluid.buffer(FluidArray::ListHead));
  if (!heads) return heads.error();
  FluidCounts counts;
  counts.particles = fluid.count;
  counts.nearSolids = sums->front().nearSolids;
  counts.nearMouths = sums->front().nearMouths;
  double listed = 0;
  for (uint32_t i = 0; i < fluid.count && fluid.setup.params.listCapacity > 0; ++i) {
    const uint32_t entries = (*heads)[i] & kUnlisted;
    if (entries == kUnlisted) continue;
    counts.entries += entries;
    ++listed;
  }
  if (listed > 0) counts.entries /= listed;
  return counts;
}

/// Where it decides about the next substep, the density pass has workgroups in every recorded substep; they end at once if it is not
/// needed.
void leaveOutIdle(std::vector<PassTraffic>& passes, uint32_t iterations) {
  const auto density = std::ranges::find(passes, rowOf(FluidPass::Density).name, &PassTraffic::name);
  if (density == passes.end() || density->executed <= iterations) return;
  const double share = double(iterations) / double(density->executed);
  density->executed = iterations;
  density->readBytes *= share;
  density->writtenBytes *= share;
  density->gatheredBytes *= share;
}

}  // namespace

std::string_view sectionName(Section section) {
  constexpr std::string_view kNames[] = {"start", "rebuild", "substep", "figures"};
  return kNames[size_t(section)];
}

PassTraffic FluidTraffic::total(Section section) const {
  PassTraffic sum;
  sum.name = sectionName(section);
  sum.section = section;
  for (const PassTraffic& pass : passes) {
    if (pass.section != section) continue;
    sum.recorded += pass.recorded;
    sum.executed += pass.executed;
    sum.barriers += pass.barriers;
    sum.readBytes += pass.readBytes;
    sum.writtenBytes += pass.writtenBytes;
    sum.gatheredBytes += pass.gatheredBytes;
    sum.serialCommands = std::max(sum.serialCommands, pass.serialCommands);
  }
  return sum;
}

double FluidTraffic::bytesPerParticleSubstep(Section section) const { return total(section).bytes() / (double(particles) * substeps); }

DeviceWork FluidTraffic::advance() const {
  DeviceWork work;
  for (const PassTraffic& pass : passes) work = work + DeviceWork{pass.bytes(), double(pass.recorded), double(pass.barriers)};
  return work;
}

std::vector<Override> allPasses() {
  return {
      {"rill", "\"0.2\""},
      {"fluids", R"([{"name": "mud", "diffusion": 1e-2}, {"name": "oil", "density": 800, "viscosity": 0, "yield_stress": 0}])"},
      {"interfaces", R"([{"between": ["mud", "oil"], "tension": 0.02}])"},
      {"fluid.viscosity", "0.5"},
      {"fluid.yield_stress", "1"},
      {"fluid.surface_tension", "0.07"},
      {"fluid.vorticity", "0.1"},
      {"fluid.drag", "0.1"},
      {"solver.iterations", "2"},
      {"solver.artificial_viscosity", "1"},
      {"solids[0].slip", "false"},
      {"solids[0].motion", R"([{"at": 0}, {"at": 3, "translate": [0.1, 0, 0]}])"},
      {"solids[2]", R"({"name": "float", "sphere": {"center": [0.3, 0.5, 0.3], "radius": 0.08}, "slip": false, "body": {"density": 500}})"},
      {"emitters", R"([{"disc": {"center": [1.4, 0.7, 0.32], "radius": 0.1, "normal": [0, -1, 0]}, "speed": 1, "fluid": "oil"}])"},
      {"drains", R"([{"box": {"min": [0, 0, 0], "max": [0.05, 0.05, 0.05]}}])"},
      {"probes[2]", R"({"name": "pressure", "pressure": [0.2, 0.1, 0.3]})"}};
}

DeviceWork frameWork(const FluidTraffic& traffic, double particles, double substeps) {
  DeviceWork work = traffic.advance() * (substeps / traffic.substeps);
  work.bytes *= particles / double(traffic.particles);
  return work;
}

Expected<void> advanceFluid(Workbench& workbench, Fluid& fluid, double advance_s) {
  FluidStep step{.advance_s = advance_s, .substeps = 4 * fluid.substepsPerBlock()};
  for (uint32_t recorded = 0; recorded < fluid.substepsToComplete(); recorded += step.substeps) {
    if (auto ran = workbench.run([&](Graph& graph) { (void)fluid.addTo(graph, step); }); !ran) return ran.error();
    if (!(fluid.progress().timeLeft_s > 0)) break;
    step.resume = true;
  }
  return {};
}

Expected<FluidTraffic> measureTraffic(Workbench& workbench, Fluid& fluid, double advance_s, uint32_t substeps) {
  const FluidImpl& impl = implOf(fluid);
  const ArrayShape shape = arrayShape(impl.setup);
  FluidTraffic traffic;
  FluidStep step{.advance_s = advance_s, .substeps = substeps};
  const double recordedAtOnce = double(divideUp(std::max(substeps, 1u), fluid.substepsPerBlock())) * fluid.substepsPerBlock();
  while (traffic.recordedSubsteps < fluid.substepsToComplete()) {
    step.resume = traffic.recordedSubsteps > 0;
    const auto passes = traceGraph(workbench, [&](Graph& graph) { (void)fluid.addTo(graph, step); });
    if (!passes) return passes.error();
    const bool done = !(fluid.progress().timeLeft_s > 0);
    const auto counts = countsOf(workbench, impl);
    if (!counts) return counts.error();
    traffic.recordedSubsteps += recordedAtOnce;
    traffic.listEntries = counts->entries;
    Section section = Section::Start;
    for (const TracedPass& pass : *passes) {
      const FluidPassRow* row = rowNamed(pass.name);
      section = sectionOf(row, section);
      auto sum = std::ranges::find(traffic.passes, pass.name, &PassTraffic::name);
      if (sum == traffic.passes.end()) {
        traffic.passes.push_back({.name = pass.name, .section = section});
        sum = traffic.passes.end() - 1;
      }
      sum->barriers += pass.barrier;
      sum->recorded += pass.dispatches.size() + pass.transfers;
      sum->executed += pass.transfers;
      sum->writtenBytes += double(pass.transferBytes);
      for (const TracedDispatch& dispatch : pass.dispatches) {
        if (dispatch.groups == 0) continue;
        ++sum->executed;
        addBytes(*sum, row, dispatch, shape, *counts);
        sum->serialCommands = std::max(sum->serialCommands, serialCommands(dispatch, impl.setup.params.commandCount));
      }
    }
    if (done) break;
  }
  leaveOutIdle(traffic.passes, fluid.progress().iterations);
  traffic.particles = fluid.count();
  traffic.substeps = fluid.progress().substeps;
  traffic.builds = fluid.progress().listBuilds;
  return traffic;
}

}  // namespace rill::bench
