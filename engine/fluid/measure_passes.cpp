// The passes of the figures: density on a grid of its own, sums, the median and the worst hundredth.
#include <algorithm>

#include "fluid/pass_parts.hpp"

namespace rill {

// `groups` workgroups. The shader binds, after the two uniform blocks, what is read, what is written anew and what is changed.
static void plainPass(Graph& graph, FluidRefs& r, Use read, std::string_view name, const ComputePipeline* pipeline, uint64_t groups,
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
    return [=](Commands& commands) { commands.dispatch(kernel, groups); };
  });
}

void FluidImpl::declareMeasure(Graph& graph, Pending& pending) {
  const Use read = readUse(texel_);
  if (setup.near) { wallPass(graph, r_, read, "measure walls", pipes_.walls, r_.position, kCommandMeasurePlane, kCommandMeasureCorner); }
  BufferRef partials = graph.create("partial sums", {kMeasurePartials * sizeof(MeasurePartial)});
  BufferRef histogram = graph.create("error histogram", {3 * kMeasureBins * 4});
  graph.pass("clear histogram", [&](Pass& pass) {
    histogram = pass.write(histogram, Use::CopyTarget, true);
    return [histogram](Commands& commands) { commands.fill(histogram, 0); };
  });
  BufferRef keys = graph.create("position keys", {uint64_t{count} * 4}),
            ordered = graph.create("ordered positions", {uint64_t{count} * 16});
  const uint64_t all = divideUp(count, kFluidGroup);
  ++recording_.sorts;
  KeyCounters counters = sort_->begin(graph);
  graph.pass("measure keys", [&](Pass& pass) {
    pass.read(r_.params, Use::ComputeUniform);
    pass.read(r_.control, Use::ComputeUniform);
    pass.read(r_.sums, Use::ComputeRead);
    const Kernel kernel = keysKernel(pass, pipes_.measureKeys, r_.position, keys, counters);
    return [=](Commands& commands) { commands.dispatch(kernel, all); };
  });
  const SortedKeys sorted = sort_->finish(graph, keys, counters);
  plainPass(graph, r_, read, "measure order", pipes_.measureOrder, all, {keys, sorted.start, sorted.arrived, sorted.order, r_.position},
            {&ordered});
  plainPass(graph, r_, read, "measure", pipes_.measure, all, {ordered, sorted.start, r_.nearSample}, {},
            {&r_.sums, &histogram, &r_.velocity});
  plainPass(graph, r_, read, "measure sums", pipes_.measureSums,
            std::min<uint64_t>(divideUp(count, kMeasureShare * kFluidGroup), kMeasurePartials), {r_.position, r_.velocity}, {&partials});
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
