#pragma once
// What passes of the fluid have in common: bindings in the order of the shader, the device's switches, passes over neighbors and walls.
#include <array>
#include <initializer_list>
#include <span>
#include <string_view>

#include "fluid/fluid_impl.hpp"

namespace rill {

/// Bytes into the commands at which one lies.
constexpr uint64_t commandAt(uint32_t command) { return uint64_t{command} * 12; }

/// Bindings in the order of the shader.
struct BindingList {
  std::array<ResourceRef, 24> refs;
  size_t size = 0;
  void add(std::initializer_list<ResourceRef> more) {
    for (ResourceRef ref : more) refs[size++] = ref;
  }
  std::span<const ResourceRef> span() const { return {refs.data(), size}; }
};

/// What every pass reads that the device switches on and off.
inline void readSwitched(Pass& pass, const FluidRefs& r) {
  pass.read(r.params, Use::ComputeUniform);
  pass.read(r.control, Use::ComputeUniform);
  pass.read(r.commands, Use::Indirect);
}

/// Of a pass over neighbors, the command of the variant that walks.
constexpr uint32_t walkingCommand(uint32_t command) { return kCommandWalks + (command - kCommandDensity); }

/// A pass over all chunks that gathers from `particles`: the device switches on one of its two variants. `own(pass, bindings)` declares and
/// appends its own bindings.
template <class Push, class Own>
void gatherPass(Graph& graph, FluidRefs& r, Use read, std::span<const Chunk> chunks, std::string_view name,
                const GatherPipelines& pipelines, BufferRef particles, uint32_t command, Push push, Own&& own) {
  graph.pass(name, [&](Pass& pass) {
    pass.read(r.params, Use::ComputeUniform);
    pass.read(r.control, Use::ComputeUniform);
    for (BufferRef ref : {particles, r.neighborCount, r.cell, r.start}) pass.read(ref, read);
    pass.read(r.commands, Use::Indirect);
    r.sums = pass.write(r.sums, Use::ComputeAtomic);
    BindingList bindings;
    bindings.add({r.params, r.control, particles, {}, r.neighborCount, r.cell, r.start, r.sums});
    own(pass, bindings);
    const bool lists = pipelines.list != nullptr;
    std::array<Kernel, kMaxListChunks> list, walk;
    for (size_t c = 0; c < chunks.size(); ++c) {
      pass.read(r.lists[c], read);
      bindings.refs[3] = r.lists[c];
      if (lists) list[c] = pass.kernel(pipelines.list, bindings.span());
      walk[c] = pass.kernel(pipelines.walk, bindings.span());
    }
    return [=, arguments = r.commands](Commands& commands) mutable {
      for (size_t c = 0; c < chunks.size(); ++c) {
        push.first = chunks[c].first;
        push.last = chunks[c].last;
        if (lists) commands.dispatchIndirect(list[c], arguments, commandAt(command), push);
        commands.dispatchIndirect(walk[c], arguments, commandAt(walkingCommand(command)), push);
      }
    };
  });
}

/// Wall and solid densities at `at` for the particles near them. Those near one wall and those near more are never the same: two
/// dispatches, one pass.
inline void wallPass(Graph& graph, FluidRefs& r, Use read, std::string_view name, const WallPipelines& pipelines, BufferRef at,
                     uint32_t planeCommand, uint32_t cornerCommand) {
  graph.pass(name, [&](Pass& pass) {
    readSwitched(pass, r);
    for (BufferRef ref : {at, r.nearList, r.tables}) pass.read(ref, read);
    for (BufferRef ref : {r.sums, r.solids}) pass.read(ref, Use::ComputeRead);
    r.nearSample = pass.write(r.nearSample, Use::ComputeWrite);
    const std::initializer_list<ResourceRef> bindings = {r.params, r.control, at, r.nearList, r.sums, r.tables, r.solids, r.nearSample};
    const Kernel plane = pass.kernel(pipelines.plane, bindings), corner = pass.kernel(pipelines.corner, bindings);
    return [=, arguments = r.commands](Commands& commands) {
      commands.dispatchIndirect(corner, arguments, commandAt(cornerCommand));
      commands.dispatchIndirect(plane, arguments, commandAt(planeCommand));
    };
  });
}

}  // namespace rill
