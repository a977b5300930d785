// The passes of the figures: density on a grid of its own, sums, the median and the worst hundredth.
#include "fluid/fluid_impl.hpp"

namespace rill {

void FluidImpl::declareMeasure(Graph& graph, Pending& pending) {
  using enum FluidArray;
  ++recording_.sorts;
  beginSection();
  alias(Place, Position);
  declare(graph, FluidPass::MeasureDisplaced, Start::Figures, DisplacePush{0, 1});
  declare(graph, FluidPass::MeasureMouths, Start::Figures, MouthDensityPush{0});
  BufferRef& histogram = ref(Histogram) = graph.create(rowOf(Histogram).label, {arrayBytes(Histogram, arrayShape(setup))});
  addFill(graph, "clear histogram", {{&histogram, 0}});
  if (setup.fluids > 1) {
    BufferRef& figures = ref(FluidFigures) = graph.create(rowOf(FluidFigures).label, {arrayBytes(FluidFigures, arrayShape(setup))});
    addFill(graph, "clear figures of fluids", {{&figures, 0}});
  }
  const Gate gate{ref(FluidArray::Commands), sortCommand_ + static_cast<uint32_t>(sort_->dispatches().size())};
  sortKeys(graph, FluidPass::MeasureKeys, Start::Figures, Position, {}, &gate);
  declare(graph, FluidPass::MeasureOrder, Start::Figures);
  alias(CellStart, SortStart);
  declare(graph, FluidPass::Measure, Start::Figures);
  resetAliases();
  declare(graph, FluidPass::MeasureFluids, Start::Figures);
  declare(graph, FluidPass::MeasureSums);
  declare(graph, FluidPass::Reduce);
  pending.measure = graph.readback(ref(Figures));
  if (setup.fluids > 1) pending.fluidFigures = graph.readback(ref(FluidFigures));
  pending.measured = true;
}

}  // namespace rill
