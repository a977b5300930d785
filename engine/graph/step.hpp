#pragma once
// Passes declared in one call: one dispatch, or fills of buffers.
#include <array>
#include <cassert>
#include <initializer_list>
#include <span>
#include <string_view>
#include <type_traits>

#include "graph/shader_pass.hpp"
#include "rill/graph.hpp"
#include "rill/pipeline.hpp"

namespace rill {

/// One resource of a step: how it is used and, by its place in the list, the binding that it is bound to.
struct StepBinding {
  ResourceRef ref;
  Use use = Use::ComputeRead;
  BufferRef* written = nullptr;  ///< receives the version that the step produces
  bool discard = false;
};
inline StepBinding reads(BufferRef buffer) { return {buffer, Use::ComputeRead}; }
inline StepBinding uniform(BufferRef buffer) { return {buffer, Use::ComputeUniform}; }
inline StepBinding texels(BufferRef buffer) { return {buffer, Use::ComputeTexel}; }
inline StepBinding sampled(ImageRef image) { return {image, Use::ComputeSampled}; }
inline StepBinding writes(BufferRef& buffer) { return {buffer, Use::ComputeWrite, &buffer}; }       ///< what is not written is kept
inline StepBinding fresh(BufferRef& buffer) { return {buffer, Use::ComputeWrite, &buffer, true}; }  ///< the old content is discarded

/// The workgroups of a step: their number, folded into x and y; an exact grid; or three words of a buffer.
struct StepGroups {
  uint64_t count = 0;
  Groups grid{0, 0, 0};
  BufferRef arguments;
  uint64_t offset = 0;  ///< bytes
  StepGroups(uint64_t groups) : count(groups) {}
  StepGroups(Groups groups) : grid(groups) {}
  StepGroups(BufferRef buffer, uint32_t word) : arguments(buffer), offset(uint64_t{word} * 4) {}
};

/// Declares a pass of one dispatch. The shader's bindings are `bindings` in their order; `push` is its push constants.
template <class Push = NoPush>
void addStep(Graph& graph, std::string_view name, const ComputePipeline* pipeline, std::initializer_list<StepBinding> bindings,
             const StepGroups& groups, const Push& push = {}) {
  graph.pass(name, [&](Pass& pass) {
    constexpr size_t kMaxStepBindings = 16;
    assert(bindings.size() <= kMaxStepBindings);
    ResourceRef bound[kMaxStepBindings];
    size_t count = 0;
    for (const StepBinding& binding : bindings) {
      bound[count] = binding.ref;
      if (binding.written)
        bound[count] = *binding.written = pass.write(BufferRef{binding.ref}, binding.use, binding.discard);
      else if (binding.use == Use::ComputeSampled)
        pass.read(ImageRef{binding.ref}, binding.use);
      else
        pass.read(BufferRef{binding.ref}, binding.use);
      ++count;
    }
    if (groups.arguments != BufferRef{}) pass.read(groups.arguments, Use::Indirect);
    const Kernel kernel = pass.kernel(pipeline, std::span<const ResourceRef>(bound, count));
    return [kernel, groups, push](Commands& commands) {
      std::span<const std::byte> bytes;
      if constexpr (!std::is_same_v<Push, NoPush>) bytes = std::as_bytes(std::span(&push, 1));
      if (groups.arguments != BufferRef{})
        commands.dispatchIndirect(kernel, groups.arguments, groups.offset, bytes);
      else if (groups.grid.x > 0)
        commands.dispatch(kernel, groups.grid, bytes);
      else
        commands.dispatch(kernel, groups.count, bytes);
    };
  });
}

}  // namespace rill
