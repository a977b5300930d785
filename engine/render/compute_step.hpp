#pragma once
// A pass of one dispatch, declared in one call.
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

/// One buffer of a step, in the order of the shader's bindings.
struct StepBuffer {
  enum class How : uint8_t { Read, Uniform, Texel, Write, Fresh };
  BufferRef ref;
  BufferRef* target = nullptr;  ///< of a write: where the new version goes
  How how = How::Read;
};
inline StepBuffer reads(BufferRef buffer) { return {buffer, nullptr, StepBuffer::How::Read}; }
inline StepBuffer uniform(BufferRef buffer) { return {buffer, nullptr, StepBuffer::How::Uniform}; }
inline StepBuffer texels(BufferRef buffer) { return {buffer, nullptr, StepBuffer::How::Texel}; }
inline StepBuffer writes(BufferRef& buffer) { return {buffer, &buffer, StepBuffer::How::Write}; }  ///< keeps what it does not write
inline StepBuffer fresh(BufferRef& buffer) { return {buffer, &buffer, StepBuffer::How::Fresh}; }   ///< writes all that is read later

/// How many workgroups: a number, or three words of a buffer.
struct StepGroups {
  uint64_t count = 0;
  BufferRef arguments;
  uint64_t offset = 0;  ///< bytes
  StepGroups(uint64_t groups) : count(groups) {}
  StepGroups(BufferRef buffer, uint32_t word) : arguments(buffer), offset(uint64_t{word} * 4) {}
};

template <class Push>
void addStep(Graph& graph, std::string_view name, const ComputePipeline* pipeline, std::initializer_list<StepBuffer> buffers,
             const StepGroups& groups, const Push& push) {
  graph.pass(name, [&](Pass& pass) {
    constexpr size_t kMaxEntries = 16;
    ResourceRef bound[kMaxEntries];
    size_t count = 0;
    for (const StepBuffer& buffer : buffers) {
      switch (buffer.how) {
        case StepBuffer::How::Read:
          pass.read(buffer.ref, Use::ComputeRead);
          break;
        case StepBuffer::How::Uniform:
          pass.read(buffer.ref, Use::ComputeUniform);
          break;
        case StepBuffer::How::Texel:
          pass.read(buffer.ref, Use::ComputeTexel);
          break;
        case StepBuffer::How::Write:
        case StepBuffer::How::Fresh:
          *buffer.target = pass.write(buffer.ref, Use::ComputeWrite, buffer.how == StepBuffer::How::Fresh);
          break;
      }
      bound[count++] = buffer.target ? *buffer.target : buffer.ref;
    }
    const bool indirect = groups.arguments != BufferRef{};
    if (indirect) pass.read(groups.arguments, Use::Indirect);
    const Kernel kernel = pass.kernel(pipeline, std::span<const ResourceRef>(bound, count));
    return [kernel, indirect, groups, push](Commands& commands) {
      if (indirect)
        commands.dispatchIndirect(kernel, groups.arguments, groups.offset, push);
      else
        commands.dispatch(kernel, groups.count, push);
    };
  });
}

}  // namespace rill
