// The passes of the figures: density on a grid of its own, sums, the median and the worst hundredth.
#include "fluid/pass_parts.hpp"

namespace rill {

// A pass over all particles. Its shader binds, after the two uniform blocks, what is read, what is written anew and what is changed.
static void plainPass(Graph& graph, FluidRefs& r, Use read, std::string_view name, const ComputePipeline* pipeline, uint32_t count,
                      std::initializer_list<BufferRef> reads, std::initializer_list<BufferRef*> writes,
                      std::initializer_list<BufferRef*> changes = {}) {
  graph.pass(name, [&](Pass& pass) {
    pass.read(r.params, Use::ComputeUniform);
    pass.read(r.control, Use::ComputeUniform);
    BindingList bindings;
    bindings.add({r.params, r.control});
    for (BufferRef ref : reads) {
      pass.read(ref, read);
      bindings.add({ref});
    }
    for (BufferRef* ref : writes) {
      *ref = pass.write(*ref, Use::ComputeWrite, true);
      bindings.add({*ref});
    }
    for (BufferRef* ref : changes) {
      *ref = pass.write(*ref, Use::ComputeWrite);
      bindings.add({*ref});
    }
    const Kernel kernel = pass.kernel(pipeline, bindings.span());
    return [=, groups = divideUp(count, kFluidGroup)](Commands& commands) { commands.dispatch(kernel, groups); };
  });
}

void FluidImpl::declareMeasure(Graph& graph, Pending& pending) {
  const Use read = readUse(texel_);
  if (setup.near) { wallPass(graph, r_, read, "measure walls", pipes_.walls, r_.position, kCommandMeasurePlane, kCommandMeasureCorner); }
  BufferRef partials = graph.create("partial sums", {divideUp(count, kMeasureGroup) * sizeof(MeasurePartial)});
  BufferRef histogram = graph.create("error histogram", {3 * kMeasureBins * 4});
  graph.pass("clear histogram", [&](Pass& pass) {
    histogram = pass.write(histogram, Use::CopyTarget, true);
    return [histogram](Commands& commands) { commands.fill(histogram, 0); };
  });
  BufferRef keys = graph.create("position keys", {uint64_t{count} * 4}),
            ordered = graph.create("ordered positions", {uint64_t{count} * 16});
  plainPass(graph, r_, Use::ComputeRead, "measure keys", pipes_.measureKeys, count, {r_.position}, {&keys});
  const SortedKeys sorted = sort_->addTo(graph, keys);
  plainPass(graph, r_, read, "measure order", pipes_.measureOrder, count, {sorted.order, r_.position}, {&ordered});
  plainPass(graph, r_, read, "measure", pipes_.measure, count, {ordered, sorted.start, r_.nearSample}, {&partials},
            {&r_.sums, &histogram, &r_.velocity});
  BufferRef result = graph.create("figures", {sizeof(MeasureResult)});
  graph.pass("reduce", [&](Pass& pass) {
    pass.read(r_.params, Use::ComputeUniform);
    pass.read(r_.control, Use::ComputeUniform);
    pass.read(partials, Use::ComputeRead);
    pass.read(histogram, Use::ComputeRead);
    result = pass.write(result, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(pipes_.reduce, {r_.params, r_.control, partials, histogram, result});
    return [=](Commands& commands) { commands.dispatch(kernel, 1); };
  });
  pending.measure = graph.readback(result);
  pending.measured = true;
}

}  // namespace rill
