// How a pass of the table is declared: its arrays become the versions that it reads and writes.
#include <algorithm>

#include "fluid/fluid_impl.hpp"
#include "graph/graph_impl.hpp"

namespace rill {

uint64_t FluidImpl::fixedGroups(Extent extent) const {
  switch (extent) {
    case Extent::One:
      return 1;
    case Extent::Partials:
      return std::min<uint64_t>(divideUp(capacity, kMeasureShare * kFluidGroup), kMeasurePartials);
    case Extent::Bodies:
      return divideUp(setup.bodies.size(), kFluidGroup);
    case Extent::PressureProbes:
      return setup.pressureProbes.size();
    case Extent::Regions:
      return divideUp(regionCount(setup.params), kFluidGroup);
    case Extent::Births:
      return std::max<uint64_t>(divideUp(std::min<uint64_t>(kMaxBornLayers * setup.mouthPoints.size(), capacity), kFluidGroup), 1);
    default:
      return divideUp(capacity, kFluidGroup);
  }
}

void FluidImpl::resetAliases() {
  for (size_t k = 0; k < kArrays; ++k) aliases_[k] = static_cast<FluidArray>(k);
}

void FluidImpl::beginSection() {
  for (const ArrayRow& row : arrayTable())
    if (row.lifetime != Lifetime::Fluid) refs_[slotOf(row.id)] = {};
  resetAliases();
}

uint64_t FluidImpl::commandOffset(Graph& graph, const FluidPassRow& row, size_t variant, Start start) const {
  if (start == Start::Always) return 0;
  if (start == Start::Correct && parity_ == 1) start = Start::CorrectOdd;
  const uint32_t command = passes_[static_cast<size_t>(row.id)].commands[variant][static_cast<size_t>(start)];
  if (command != kNoCommand) return DispatchCommands::offset(command);
  implOf(graph).fail("pass '" + std::string(row.name) + "': its row in pass_table.cpp lacks what starts it");
  return 0;
}

Kernel FluidImpl::bind(Graph& graph, Pass& pass, const FluidPassRow& row, const PreparedPass::Variant& variant, uint32_t chunk) {
  std::array<BoundResource, kMaxBindings> bound;
  for (size_t k = 0; k < variant.arrays.size(); ++k) {
    const FluidArray array = aliases_[static_cast<size_t>(variant.arrays[k])];
    BufferRef& version = refs_[slotOf(array, chunk)];
    if (version == BufferRef{} && rowOf(array).lifetime == Lifetime::Section)
      version = graph.create(rowOf(array).label, {arrayBytes(array, arrayShape(setup))});
    bound[k].buffer = &version;
    // Passes over neighbors only count in the sums: nothing has to wait between two of them.
    bound[k].atomic = array == FluidArray::Sums && gathers(row.extent) && !runsControl(row.id, setup);
  }
  return bindShader(pass, variant.pipeline, std::span(bound).first(variant.arrays.size()));
}

}  // namespace rill
